//! The rotations of a pose as numbers that can be averaged and fitted: an exponential map per joint, about its mean rotation.
//! Without that centre the map wraps for bones rotated by about half a turn in their parent's frame.

use crate::humanoid::{JOINTS, Pose};
use crate::math::{Quat, Vec3, exp_map};

/// Degrees of freedom of a pose: an exponential map per joint.
pub const ROTATION_DIMS: usize = 3 * JOINTS;

/// One number per degree of freedom; radians for a pose.
pub type RotationRow = [f64; ROTATION_DIMS];

/// The mean rotation of every joint.
pub(crate) fn mean_rotations<'a>(poses: impl Iterator<Item = &'a Pose> + Clone) -> [Quat; JOINTS] {
    std::array::from_fn(|j| exp_map::karcher_mean(&poses.clone().map(|pose| pose.rotations[j]).collect::<Vec<_>>()))
}

/// Converts rotations to exponential maps about a reference.
pub fn row_of(reference: &[Quat; JOINTS], rotations: &[Quat; JOINTS]) -> RotationRow {
    let mut row = [0.0; ROTATION_DIMS];
    for j in 0..JOINTS {
        let v = exp_map::log(reference[j].inv_mul(rotations[j]));
        for (out, v) in row[3 * j..].iter_mut().zip(v.to_array()) {
            *out = f64::from(v);
        }
    }
    row
}

/// Converts a row to rotations.
pub(crate) fn rotations_of(reference: &[Quat; JOINTS], row: &RotationRow) -> [Quat; JOINTS] {
    let vector = |j: usize| Vec3::new(row[3 * j] as f32, row[3 * j + 1] as f32, row[3 * j + 2] as f32);
    std::array::from_fn(|j| reference[j] * exp_map::exp(vector(j)))
}
