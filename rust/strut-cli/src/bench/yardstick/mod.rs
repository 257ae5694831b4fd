//! The paper's exhaustive search on the GPU, compared with ours; requires the feature `gpu`.

#[cfg(feature = "gpu")]
mod with_gpu;
#[cfg(not(feature = "gpu"))]
mod without_gpu;

#[cfg(feature = "gpu")]
pub(super) use with_gpu::{Comparison, Yardstick};
#[cfg(not(feature = "gpu"))]
pub(super) use without_gpu::{Comparison, Yardstick};
