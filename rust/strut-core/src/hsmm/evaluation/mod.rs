//! How well a model says what it has not seen, and how its walks bear what is asked of them (specification, §12).

mod extrapolation;
mod horizon;
mod manner;
mod reconstruction;
mod transition;

pub use extrapolation::{Bearing, bearing};
pub use horizon::horizon_error;
pub use manner::Manner;
pub use reconstruction::{Reconstruction, recognise};
pub use transition::{stopping_peak, transition_peak};

use super::model::{Row, WalkModel};
use super::training::Shared;
use crate::humanoid::JOINTS;
use crate::math::{Quat, Vec3, exp_map};

fn shared_of(model: &WalkModel) -> Shared {
    Shared { variances: model.variances.clone(), duration_variances: model.duration_variances }
}

/// The rotations of a row of degrees of freedom.
fn rotations_of(model: &WalkModel, row: &Row) -> [Quat; JOINTS] {
    let vector = |j: usize| Vec3::new(row[3 * j] as f32, row[3 * j + 1] as f32, row[3 * j + 2] as f32);
    std::array::from_fn(|j| model.reference[j] * exp_map::exp(vector(j)))
}
