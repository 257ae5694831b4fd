//! A frame of a recording, for measures.

use crate::humanoid::{JOINTS, Pose, Proportions, Role};
use crate::kinematics::world_from_local;
use crate::math::Vec3;

/// Joint positions and speed of a pose that faces +Z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// Positions of the joints with the hips above the origin, metres: x to the left, y up, z forward.
    pub positions: [Vec3; JOINTS],
    /// Speed of the body on the floor, m/s; NaN if only a pose is known.
    pub speed: f32,
}

impl Frame {
    /// Frame of a pose; its place on the floor is ignored.
    pub fn new(proportions: &Proportions, pose: &Pose, speed: f32) -> Self {
        let above_origin = Pose { root: pose.root * Vec3::Y, ..*pose };
        Self { positions: world_from_local(proportions, &above_origin).positions, speed }
    }

    /// Position of a joint.
    pub(super) fn at(&self, role: Role) -> Vec3 {
        self.positions[role.index()]
    }
}
