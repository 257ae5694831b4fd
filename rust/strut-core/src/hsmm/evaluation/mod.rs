//! Held-out likelihood, and robustness of walks to controls (`docs/methods/hsmm.md` §12).

mod context;
mod extrapolation;
mod gait_statistics;
mod horizon;
mod reconstruction;
mod recursion;
mod transition;

pub use context::{ContextTree, Split};
pub use extrapolation::{Bearing, bearing, strengths};
pub use gait_statistics::GaitStatistics;
pub use horizon::horizon_error;
pub use reconstruction::{Reconstruction, recognise};
pub use recursion::recursion_error;
pub use transition::{Peaks, stopping_peaks, transition_peaks};

use super::model::WalkModel;
use super::statistics::SharedVariances;

fn shared_of(model: &WalkModel) -> SharedVariances {
    SharedVariances { variances: model.variances.clone(), duration_variances: model.duration_variances }
}
