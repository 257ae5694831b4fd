//! Check that a bound body is human: a four-legged animal has arms or a trunk as long as its legs, and stands on all fours.

use super::body_tree::BodyTree;
use super::rest_pose::positions;
use super::sample::Sample;
use crate::humanoid::{JOINTS, Proportions, Role};
use crate::kinematics::Limb;
use crate::math::{Quat, Vec3};
use crate::skeleton::Skeleton;

/// Human arms are two thirds as long as the legs; those of four-legged animals are about as long.
const LONGEST_ARMS: f32 = 0.85;
/// The human trunk, from the hip joints to the shoulders, is half as long as the legs; that of four-legged animals about as
/// long.
const LONGEST_TRUNK: f32 = 0.8;
/// The zero pose is upright if the cosine between trunk and legs is above this.
const UPRIGHT: f32 = 0.8;
/// The trunk is horizontal rather than upright if this cosine is below this.
const LYING_TRUNK: f32 = 0.5;
/// Hands that reach this far down from the hips, in leg lengths, are at the height of the feet; hanging hands reach a
/// quarter.
const STANDING_HANDS: f32 = 0.7;
/// Share of the frames in which an animal must stand on its hands.
const MOST_FRAMES: f32 = 0.8;

/// Evidence that a body is four-legged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FourLegs {
    /// Ratio of the arms' length to the legs'.
    pub arms_per_leg: f32,
    /// Ratio of the length of the trunk, from hip joints to shoulders, to the legs'.
    pub trunk_per_leg: f32,
}

/// Returns the evidence if a body stands on four legs in most frames and has the proportions for it. This excludes people who
/// crawl or sit, and figures with long arms that are upright, even if only in the zero pose.
pub(super) fn four_legs(
    skeleton: &Skeleton,
    roles: &[Option<usize>; JOINTS],
    sample: &Sample,
    proportions: &Proportions,
) -> Option<FourLegs> {
    let length = |limb: Limb| {
        let [_, middle, end] = limb.roles();
        proportions.offsets[middle.index()].length() + proportions.offsets[end.index()].length()
    };
    let both = |limbs: [Limb; 2]| limbs.iter().map(|limb| length(*limb)).sum::<f32>();
    let arms_per_leg = both(Limb::ARMS) / both(Limb::LEGS);
    let joints = Joints::of(skeleton, roles)?;
    let zero = positions(skeleton, &sample.translations, &vec![Quat::IDENTITY; skeleton.len()]);
    let trunk_per_leg = joints.trunk_per_leg(&zero);
    if arms_per_leg < LONGEST_ARMS && trunk_per_leg < LONGEST_TRUNK || joints.upright(|j| zero[j]) > UPRIGHT {
        return None;
    }
    let stands: Vec<bool> = sample.each(|w| joints.stand_on_hands_and_feet(|j| w[j].0)).collect();
    let standing = stands.iter().filter(|stands| **stands).count() as f32;
    (standing >= MOST_FRAMES * stands.len() as f32).then_some(FourLegs { arms_per_leg, trunk_per_leg })
}

/// The joints that distinguish two legs from four, left and right.
struct Joints {
    /// Start of the legs: the first joints below the hips. An animal's leg has three long bones; with ambiguous names the
    /// role of the upper leg may be assigned below its thigh.
    hips: [usize; 2],
    /// Joints of the legs from there to the feet.
    legs: [Vec<usize>; 2],
    feet: [usize; 2],
    shoulders: [usize; 2],
    hands: [usize; 2],
}

impl Joints {
    fn of(skeleton: &Skeleton, roles: &[Option<usize>; JOINTS]) -> Option<Self> {
        let pair = |left: Role| Some([roles[left.index()]?, roles[left.mirrored().index()]?]);
        let tree = BodyTree::of_skeleton(skeleton, roles);
        let pelvis = roles[Role::Hips.index()]?;
        let thighs = pair(Role::LeftUpperLeg)?;
        let feet = pair(Role::LeftFoot)?;
        let leg = |side: usize| {
            let up = std::iter::successors(Some(feet[side]), |&j| tree.parents[j]);
            let mut leg: Vec<usize> = up.take_while(|&j| j != pelvis && j != feet[1 - side]).collect();
            leg.reverse();
            // A pelvis that is the parent of both thighs belongs to neither leg.
            let shared =
                |j: usize| std::iter::successors(Some(feet[1 - side]), |&j| tree.parents[j]).any(|other| other == j);
            leg.retain(|&j| !shared(j) || j == thighs[side]);
            leg
        };
        let legs = [leg(0), leg(1)];
        Some(Self {
            hips: [*legs[0].first()?, *legs[1].first()?],
            feet,
            legs,
            shoulders: pair(Role::LeftUpperArm)?,
            hands: pair(Role::LeftHand)?,
        })
    }

    /// Vectors from the hips to the feet, the shoulders and the hands, means of both sides.
    fn toward_ends(&self, at: impl Fn(usize) -> Vec3) -> [Vec3; 3] {
        let middle = |[a, b]: [usize; 2]| 0.5 * (at(a) + at(b));
        [self.feet, self.shoulders, self.hands].map(|pair| middle(pair) - middle(self.hips))
    }

    /// Ratio of the trunk's length to the legs' in the zero pose.
    fn trunk_per_leg(&self, zero: &[Vec3]) -> f32 {
        let length = |leg: &[usize]| leg.windows(2).map(|bone| (zero[bone[1]] - zero[bone[0]]).length()).sum::<f32>();
        let legs = 0.5 * self.legs.iter().map(|leg| length(leg)).sum::<f32>();
        let [_, trunk, _] = self.toward_ends(|j| zero[j]);
        trunk.length() / legs
    }

    /// Cosine between the directions up the trunk and up the legs.
    fn upright(&self, at: impl Fn(usize) -> Vec3) -> f32 {
        let [legs, trunk, _] = self.toward_ends(at);
        -trunk.normalize_or_zero().dot(legs.normalize_or_zero())
    }

    /// Whether the trunk is horizontal and the hands reach as far down as the feet.
    fn stand_on_hands_and_feet(&self, at: impl Fn(usize) -> Vec3) -> bool {
        let [legs, _, hands] = self.toward_ends(&at);
        self.upright(at) < LYING_TRUNK && hands.dot(legs.normalize_or_zero()) > STANDING_HANDS * legs.length()
    }
}
