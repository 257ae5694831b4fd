//! Query of a lens: the last frames of the input, with the changes that a lesson makes.

use super::error::{LensError, among};
use crate::humanoid::{JOINTS, Pose, Role};
use crate::math::{Quat, Vec3, exp_map};

/// Changes of a query relative to the input.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct QueryChange {
    /// Joints that are turned, each by a rotation vector (axis times angle, radians) in the axes of its parent.
    pub turns: Vec<(Role, Vec3)>,
    /// Turn about the vertical through the hips of the last frame, radians.
    pub heading: f32,
    /// Shift on the ground, metres.
    pub shift: [f32; 2],
    /// Whether the frames run backwards.
    pub reversed: bool,
}

impl QueryChange {
    /// Creates a change from numbers: for each turn the joint's index and three numbers.
    ///
    /// # Errors
    /// If a joint does not exist, or a number is not finite.
    pub fn new(
        turns: impl IntoIterator<Item = (usize, [f32; 3])>,
        heading: f32,
        shift: [f32; 2],
        reversed: bool,
    ) -> Result<Self, LensError> {
        let turns = turns.into_iter().map(|(joint, by)| {
            by.into_iter().try_for_each(|v| finite("the turn of a joint", v))?;
            Ok((Role::ALL[among("joint", joint, JOINTS)?], Vec3::from_array(by)))
        });
        let turns = turns.collect::<Result<_, LensError>>()?;
        finite("the heading", heading)?;
        shift.into_iter().try_for_each(|v| finite("the shift", v))?;
        Ok(Self { turns, heading, shift, reversed })
    }

    /// Pose with the joints turned.
    pub fn turned(&self, pose: &Pose) -> Pose {
        let mut pose = *pose;
        for &(role, by) in &self.turns {
            let rotation = &mut pose.rotations[role.index()];
            *rotation = exp_map::exp(by) * *rotation;
        }
        pose
    }

    /// Pose with the joints turned, then turned about a point and moved on the ground.
    pub fn applied(&self, pose: &Pose, about: Vec3) -> Pose {
        let mut pose = self.turned(pose);
        let turn = Quat::from_rotation_y(self.heading);
        let from = pose.root - about;
        let to = turn * Vec3::new(from.x, 0.0, from.z);
        pose.root = Vec3::new(about.x + to.x + self.shift[0], pose.root.y, about.z + to.z + self.shift[1]);
        pose.rotations[0] = turn * pose.rotations[0];
        pose
    }
}

fn finite(what: &'static str, value: f32) -> Result<(), LensError> {
    if value.is_finite() { Ok(()) } else { Err(LensError::OutOfRange { what, value, expected: "a finite number" }) }
}
