//! From one canonical body to another.

use super::scale::BodyScale;
use crate::humanoid::{HumanoidMotion, Proportions};
use crate::kinematics::world_from_local;

/// The clip on another canonical body: as [`super::from_humanoid`] followed by [`super::to_humanoid`], but
/// without a skeleton in between.
pub fn between_bodies(motion: &HumanoidMotion, body: &Proportions) -> HumanoidMotion {
    let scale = BodyScale::between(&motion.proportions, body);
    let poses = motion
        .poses
        .iter()
        .map(|pose| {
            let world = world_from_local(&motion.proportions, pose);
            let mut pose = *pose;
            scale.place(body, &mut pose, |role| world.positions[role.index()]);
            pose
        })
        .collect();
    HumanoidMotion { proportions: *body, rate_hz: motion.rate_hz, poses }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::humanoid::{Pose, Role};
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
