//! Retargeting between canonical bodies.

use super::scale::BodyScale;
use crate::humanoid::{HumanoidMotion, Pose, Proportions};
use crate::kinematics::world_from_local;

/// Retargets poses from one canonical body to another, one at a time and without allocation.
#[derive(Clone, Copy, Debug)]
pub struct BetweenBodies {
    from: Proportions,
    to: Proportions,
    scale: BodyScale,
}

impl BetweenBodies {
    /// Creates the retargeting between two bodies.
    pub fn new(from: &Proportions, to: &Proportions) -> Self {
        Self { from: *from, to: *to, scale: BodyScale::between(from, to) }
    }

    /// Returns the pose on the other body: the same directions, the travel scaled by the legs, feet and hands in their
    /// places.
    pub fn pose(&self, pose: &Pose) -> Pose {
        let world = world_from_local(&self.from, pose);
        let mut pose = *pose;
        self.scale.place(&self.to, &mut pose, |role| world.positions[role.index()]);
        pose
    }
}

/// Retargets a clip to another canonical body: like [`super::from_humanoid()`] followed by [`super::to_humanoid()`], but without
/// a skeleton in between.
pub fn between_bodies(motion: &HumanoidMotion, body: &Proportions) -> HumanoidMotion {
    let retarget = BetweenBodies::new(&motion.proportions, body);
    let poses = motion.poses.iter().map(|pose| retarget.pose(pose)).collect();
    HumanoidMotion { proportions: *body, rate_hz: motion.rate_hz, poses }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::humanoid::Role;
    use crate::math::{Quat, Vec3};

    #[test]
    fn a_body_of_half_the_size_makes_the_same_moves_at_half_the_size() {
        let mut pose = Pose { root: Vec3::new(0.4, 0.8, -1.0), ..Pose::default() };
        pose.rotations[Role::LeftUpperLeg.index()] = Quat::from_rotation_x(-0.4);
        pose.rotations[Role::LeftLowerLeg.index()] = Quat::from_rotation_x(0.8);
        let motion = HumanoidMotion { proportions: Proportions::default(), rate_hz: 60.0, poses: vec![pose] };
        let mut half = motion.proportions;
        half.offsets.iter_mut().for_each(|o| *o *= 0.5);
        let small = between_bodies(&motion, &half);
        assert!((small.poses[0].root - 0.5 * pose.root).length() < 1e-5, "{}", small.poses[0].root);
        for (a, b) in small.poses[0].rotations.iter().zip(&pose.rotations) {
            assert!(a.dot(*b) > 1.0 - 1e-5);
        }
        let back = between_bodies(&small, &motion.proportions);
        assert!((back.poses[0].root - pose.root).length() < 1e-5);
    }
}
