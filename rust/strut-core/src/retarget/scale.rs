//! Scaling of lengths between two bodies.

use crate::humanoid::{Pose, Proportions, Role};
use crate::kinematics::{Limb, two_bone_ik, world_from_local};
use crate::math::Vec3;

/// Extension of a leg, as a share of its length, above which the difference between its own ratio and the mean of both legs
/// is corrected. Lower values spread the correction over more of the stride, higher ones make it steeper.
const EXTENDED: f32 = 0.9;

/// Ratios of lengths of a canonical body to those of a file's body, and the vertical shift that brings the soles to the same
/// height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct BodyScale {
    /// Ratio of the legs (mean of both): scales the travel, so that steps fit the legs.
    legs: f32,
    /// Offset of scaled heights, metres: the height of the ankles above the soles differs.
    lift: f32,
    /// Length of each fully extended leg of the file, scaled by `legs`, as a share of the target's leg. Legs of captured
    /// skeletons differ by a few percent; left first.
    full_extension: [f32; 2],
    /// Length of the target's legs, metres, left first.
    target_legs: [f32; 2],
    /// Ratio of each arm, left first: scales the reach from shoulder to wrist.
    arms: [f32; 2],
}

impl BodyScale {
    /// Computes the scale from the body of a file to a target body.
    pub(super) fn between(file: &Proportions, target: &Proportions) -> Self {
        let limb = |p: &Proportions, limb: Limb| {
            let [_, middle, end] = limb.roles();
            p.offsets[middle.index()].length() + p.offsets[end.index()].length()
        };
        let both_legs = |p: &Proportions| Limb::LEGS.iter().map(|&l| limb(p, l)).sum::<f32>();
        let legs = both_legs(target) / both_legs(file);
        Self {
            legs,
            lift: ankle_height(target) - legs * ankle_height(file),
            full_extension: Limb::LEGS.map(|leg| legs * limb(file, leg) / limb(target, leg)),
            target_legs: Limb::LEGS.map(|leg| limb(target, leg)),
            arms: Limb::ARMS.map(|arm| limb(target, arm) / limb(file, arm)),
        }
    }

    /// Maps a point of the file's body (hip joint, ankle) to the target's.
    pub(super) fn to_target(self, point: Vec3) -> Vec3 {
        point * self.legs + Vec3::Y * self.lift
    }

    /// Inverse of [`Self::to_target`].
    pub(super) fn to_file(self, point: Vec3) -> Vec3 {
        (point - Vec3::Y * self.lift) / self.legs
    }

    /// Maps a vector from hip joint to ankle, already scaled by [`Self::to_target`], to the target's leg: the direction is
    /// the same, and a straight leg stays straight, although the file's two legs differ in length and the target's do not.
    /// `i` is the index in [`Limb::LEGS`].
    pub(super) fn leg_to_target(self, i: usize, hip_to_ankle: Vec3) -> Vec3 {
        let full = self.full_extension[i];
        let bent = EXTENDED * full.min(1.0);
        self.with_extension(i, hip_to_ankle, |x| bent + (x - bent) * (1.0 - bent) / (full - bent), bent)
    }

    /// Inverse of [`Self::leg_to_target`].
    pub(super) fn leg_to_file(self, i: usize, hip_to_ankle: Vec3) -> Vec3 {
        let full = self.full_extension[i];
        let bent = EXTENDED * full.min(1.0);
        self.with_extension(i, hip_to_ankle, |x| bent + (x - bent) * (full - bent) / (1.0 - bent), bent)
    }

    /// Replaces the vector's length, as a share of the leg, by `map` of it if it is above `bent`.
    fn with_extension(self, i: usize, hip_to_ankle: Vec3, map: impl Fn(f32) -> f32, bent: f32) -> Vec3 {
        let extension = hip_to_ankle.length() / self.target_legs[i];
        if extension > bent { hip_to_ankle * (map(extension) / extension) } else { hip_to_ankle }
    }

    /// Places the target's body, its ankles and its wrists at the file's scaled places, given the file's joint positions;
    /// `pose` has the rotations.
    pub(super) fn place(self, target: &Proportions, pose: &mut Pose, file: impl Fn(Role) -> Vec3) {
        // Hip joints are scaled like the ankles, which keeps the bend of the legs.
        let hip_joints = 0.5 * (file(Role::LeftUpperLeg) + file(Role::RightUpperLeg));
        let from_hips = |r: Role| target.offsets[r.index()];
        let below = 0.5 * (from_hips(Role::LeftUpperLeg) + from_hips(Role::RightUpperLeg));
        pose.root = self.to_target(hip_joints) - pose.rotations[0] * below;

        let mut world = world_from_local(target, pose);
        for (i, leg) in Limb::LEGS.into_iter().enumerate() {
            let [hip, _, ankle] = leg.roles();
            let hip = world.positions[hip.index()];
            let ankle = hip + self.leg_to_target(i, self.to_target(file(ankle)) - hip);
            two_bone_ik(target, pose, &mut world, leg, ankle);
        }
        for (i, arm) in Limb::ARMS.into_iter().enumerate() {
            let [shoulder, _, wrist] = arm.roles();
            let reach = (file(wrist) - file(shoulder)) * self.arm(i);
            let wrist = world.positions[shoulder.index()] + reach;
            two_bone_ik(target, pose, &mut world, arm, wrist);
        }
    }

    /// Ratio of the legs.
    pub(super) fn legs(self) -> f32 {
        self.legs
    }

    /// Ratio of an arm; `i` is the index in [`Limb::ARMS`].
    pub(super) fn arm(self, i: usize) -> f32 {
        self.arms[i]
    }
}

/// Mean height of the ankles above the soles in the T-pose, metres.
fn ankle_height(p: &Proportions) -> f32 {
    let drop = |limb: Limb| limb.roles().iter().map(|r| p.offsets[r.index()].y).sum::<f32>();
    p.offsets[Role::Hips.index()].y + 0.5 * (drop(Limb::LeftLeg) + drop(Limb::RightLeg))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_body_of_half_the_size_takes_half_the_step_and_stands_on_the_ground() {
        let big = Proportions::default();
        let mut small = big;
        small.offsets.iter_mut().for_each(|o| *o *= 0.5);
        let scale = BodyScale::between(&big, &small);
        let ankle = Vec3::new(1.0, ankle_height(&big), 2.0);
        let there = scale.to_target(ankle);
        assert!((there - Vec3::new(0.5, ankle_height(&small), 1.0)).length() < 1e-6, "{there}");
        assert!((scale.to_file(there) - ankle).length() < 1e-5);
    }

    /// The mannequin with its right shin lengthened by this share.
    fn limping(longer: f32) -> Proportions {
        let mut p = Proportions::default();
        p.offsets[Role::RightFoot.index()] *= 1.0 + longer;
        p
    }

    #[test]
    fn a_straight_leg_stays_straight_on_a_body_with_equal_legs() {
        let (file, target) = (limping(0.05), Proportions::default());
        let scale = BodyScale::between(&file, &target);
        for (i, shin) in [Role::LeftFoot, Role::RightFoot].into_iter().enumerate() {
            let length = file.offsets[Role::LeftLowerLeg.index()].length() + file.offsets[shin.index()].length();
            let straight = scale.leg_to_target(i, Vec3::NEG_Y * length * scale.legs);
            assert!((straight.length() - target.leg_length()).abs() < 1e-5, "{straight}");
        }
    }

    proptest! {
        #[test]
        fn extension_maps_back(longer in -0.1f32..0.1, length in 0.0f32..0.85, i in 0usize..2) {
            let scale = BodyScale::between(&limping(longer), &Proportions::default());
            let v = Vec3::new(0.6, -0.8, 0.0) * length;
            prop_assert!((scale.leg_to_file(i, scale.leg_to_target(i, v)) - v).length() < 1e-5);
        }
    }
}
