//! Poses as rows of numbers, and back (`docs/methods/somn.md` §2).

use crate::humanoid::{JOINTS, Pose, Proportions};
use crate::kinematics::root_path::Feet;
use crate::kinematics::rotation_row::{ROTATION_DIMS, mean_rotations, rotations_of, row_of};
use crate::kinematics::world_from_local;
use crate::math::{Quat, Vec3};

/// Numbers of a pose: an exponential map per joint, and the height of the hips.
pub const DIMS: usize = ROTATION_DIMS + 1;

/// A pose: radians, and the hips' height scaled to be comparable.
pub type Row = [f64; DIMS];

/// The height of the hips that is 0 in a row, and the increment that is 1, metres.
const HEIGHT: f64 = 0.9;
const HEIGHT_UNIT: f64 = 0.8;

/// Conversion between poses of a body and rows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PoseSpace {
    /// The body.
    pub proportions: Proportions,
    /// The centres of the exponential maps; that of the hips does not contain the heading.
    pub reference: [Quat; JOINTS],
    feet: Feet,
}

impl PoseSpace {
    /// Creates a space about these mean rotations.
    pub fn new(proportions: &Proportions, reference: [Quat; JOINTS]) -> Self {
        Self { proportions: *proportions, reference, feet: Feet::new(proportions) }
    }

    /// Creates a space about the mean rotations of poses.
    pub(super) fn of_poses<'a>(proportions: &Proportions, poses: impl Iterator<Item = &'a Pose> + Clone) -> Self {
        Self::new(proportions, mean_rotations(poses))
    }

    /// Converts a pose that faces +Z to a row.
    pub fn row(&self, pose: &Pose) -> Row {
        let mut row = [0.0; DIMS];
        row[..ROTATION_DIMS].copy_from_slice(&row_of(&self.reference, &pose.rotations));
        row[ROTATION_DIMS] = (f64::from(pose.root.y) - HEIGHT) / HEIGHT_UNIT;
        row
    }

    /// Converts a row to rotations.
    pub fn rotations(&self, row: &Row) -> [Quat; JOINTS] {
        let mut angles = [0.0; ROTATION_DIMS];
        angles.copy_from_slice(&row[..ROTATION_DIMS]);
        rotations_of(&self.reference, &angles)
    }

    /// Mean angle between the joints of two rows, degrees.
    pub(super) fn mean_angle(&self, a: &Row, b: &Row) -> f64 {
        angles(&self.rotations(a), &self.rotations(b)).sum::<f64>() / JOINTS as f64
    }

    /// Height of the hips in a row, metres.
    pub fn height(row: &Row) -> f32 {
        (HEIGHT + HEIGHT_UNIT * row[ROTATION_DIMS]) as f32
    }

    /// Converts a row to a pose above the origin, with its lowest foot on the floor: the row's height is only as accurate as
    /// the model, and feet that float or sink are conspicuous.
    pub fn pose(&self, row: &Row) -> Pose {
        let mut pose = Pose { root: Vec3::ZERO, rotations: self.rotations(row) };
        let world = world_from_local(&self.proportions, &pose);
        pose.root.y = -self.feet.lowest(&world);
        pose
    }
}

/// Angles between the joints of two poses, degrees.
pub fn angles(a: &[Quat; JOINTS], b: &[Quat; JOINTS]) -> impl Iterator<Item = f64> {
    a.iter().zip(b).map(|(a, b)| f64::from(a.inv_mul(*b).angle().to_degrees()))
}
