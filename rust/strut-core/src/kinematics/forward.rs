//! Forward kinematics of the canonical humanoid.

use crate::humanoid::{JOINTS, PARENTS, Pose, Proportions};
use crate::math::{Quat, Vec3};

/// World positions (metres) and rotations of every canonical joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WorldPose {
    /// Joint positions by role.
    pub positions: [Vec3; JOINTS],
    /// Joint rotations by role; in the T-pose all are the identity.
    pub rotations: [Quat; JOINTS],
}

/// Joint positions and rotations in the world.
pub fn world_from_local(proportions: &Proportions, pose: &Pose) -> WorldPose {
    let mut world = WorldPose { positions: [pose.root; JOINTS], rotations: pose.rotations };
    for (j, &p) in PARENTS.iter().enumerate().skip(1) {
        world.positions[j] = world.positions[p] + world.rotations[p] * proportions.offsets[j];
        world.rotations[j] = world.rotations[p] * pose.rotations[j];
    }
    world
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::humanoid::Role;

    #[test]
    fn raising_the_left_arm_by_a_quarter_turn_points_it_up() {
        let p = Proportions::default();
        let mut pose = Pose::default();
        pose.rotations[Role::LeftUpperArm.index()] = Quat::from_rotation_z(std::f32::consts::FRAC_PI_2);
        let w = world_from_local(&p, &pose);
        let up = w.positions[Role::LeftHand.index()] - w.positions[Role::LeftUpperArm.index()];
        assert!((up - Vec3::new(0.0, 0.514, 0.0)).length() < 1e-5, "{up}");
    }
}
