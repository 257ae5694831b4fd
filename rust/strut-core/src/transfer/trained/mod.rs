//! Predictions of one target style by the methods with training; a stub if they are not compiled.

#[cfg(feature = "baselines")]
mod with_baselines;
#[cfg(not(feature = "baselines"))]
mod without_baselines;

#[cfg(feature = "baselines")]
pub(super) use with_baselines::Trained;
#[cfg(not(feature = "baselines"))]
pub(super) use without_baselines::Trained;
