//! Whether a bound body is that of a human: who walks on four legs has arms as long as legs, and stands on them.

use super::sample::Sample;
use crate::humanoid::{JOINTS, Proportions, Role};
use crate::kinematics::Limb;

/// Arms of people are two thirds as long as their legs, those of four-legged animals about as long.
const LONGEST_ARMS: f32 = 0.85;
/// The trunk lies rather than stands on the legs below this cosine.
const LYING_TRUNK: f32 = 0.5;
/// Hands that reach this far down from the hips, in lengths of the legs, stand where the feet stand; hanging ones reach a
/// quarter.
const STANDING_HANDS: f32 = 0.7;
/// Share of the frames in which a body must stand on its hands.
const MOST_FRAMES: f32 = 0.8;

/// What makes a body that of a four-legged animal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FourLegs {
    /// Length of the arms over that of the legs.
    pub arms_per_leg: f32,
}

/// Whether a body stands on four legs in most frames, and has the proportions for it. People who crawl or sit do not, nor
/// do figures with long arms who stand.
pub(super) fn four_legs(
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
    if arms_per_leg < LONGEST_ARMS {
        return None;
    }
    let at = |role: Role| roles[role.index()];
    let top = [Role::Neck, Role::Chest, Role::Spine].into_iter().find_map(at)?;
    let pairs = [
        [Role::LeftUpperLeg, Role::RightUpperLeg],
        [Role::LeftFoot, Role::RightFoot],
        [Role::LeftHand, Role::RightHand],
    ];
    let [hips, feet, hands] = pairs.map(|pair| pair.map(|role| at(role).unwrap_or(0)));
    let stands: Vec<bool> = sample
        .each(|w| {
            let middle = |[a, b]: [usize; 2]| 0.5 * (w[a].0 + w[b].0);
            let legs = middle(feet) - middle(hips);
            let down = legs.normalize_or_zero();
            let trunk = (w[top].0 - middle(hips)).normalize_or_zero();
            -trunk.dot(down) < LYING_TRUNK && (middle(hands) - middle(hips)).dot(down) > STANDING_HANDS * legs.length()
        })
        .collect();
    let standing = stands.iter().filter(|stands| **stands).count() as f32;
    (standing >= MOST_FRAMES * stands.len() as f32).then_some(FourLegs { arms_per_leg })
}
