//! How well a model says what it has not seen, and how its walks bear what is asked of them (specification, §12).

mod context;
mod extrapolation;
mod horizon;
mod manner;
mod reconstruction;
mod transition;

pub use context::{ContextTree, Split};
pub use extrapolation::{Bearing, bearing, strengths};
pub use horizon::horizon_error;
pub use manner::Manner;
pub use reconstruction::{Reconstruction, recognise};
pub use transition::{Peaks, stopping_peaks, transition_peaks};

use super::model::WalkModel;
use super::training::Shared;

fn shared_of(model: &WalkModel) -> Shared {
    Shared { variances: model.variances.clone(), duration_variances: model.duration_variances }
}
