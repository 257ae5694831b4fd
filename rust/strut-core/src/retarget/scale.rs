//! How lengths change between two bodies.

use crate::humanoid::{Proportions, Role};
use crate::kinematics::Limb;
use crate::math::Vec3;

/// Lengths of a canonical body per length of a file's body (both in metres), and the shift that puts
/// one's soles where the other's were.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct BodyScale {
    /// Ratio of the legs: scales the travel, so that steps fit the legs that take them.
    legs: f32,
    /// Metres added to scaled heights: ankles differ in their height above the sole.
    lift: f32,
    /// Ratio of each arm, left first: scales the reach from shoulder to wrist.
    arms: [f32; 2],
}

impl BodyScale {
    /// From the body of a file to a target body.
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
            arms: Limb::ARMS.map(|arm| limb(target, arm) / limb(file, arm)),
        }
    }

    /// Where a point of the file's body (hip joint, ankle) lies for the target's.
    pub(super) fn to_target(self, point: Vec3) -> Vec3 {
        point * self.legs + Vec3::Y * self.lift
    }

    /// Inverse of [`Self::to_target`].
    pub(super) fn to_file(self, point: Vec3) -> Vec3 {
        (point - Vec3::Y * self.lift) / self.legs
    }

    /// Ratio of an arm; `i` counts [`Limb::ARMS`].
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
}
