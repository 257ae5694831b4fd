//! The methods that are trained beforehand, as predictions of one target style; a stub where they are left out.

#[cfg(feature = "baselines")]
mod with_baselines;
#[cfg(not(feature = "baselines"))]
mod without_baselines;

#[cfg(feature = "baselines")]
pub(super) use with_baselines::Trained;
#[cfg(not(feature = "baselines"))]
pub(super) use without_baselines::Trained;
