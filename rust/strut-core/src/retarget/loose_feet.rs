//! Feet that are children of the root: rigs for inverse kinematics have shins without feet and move the feet separately.

use super::binding::zero_pose_of;
use super::find_roles::find_roles;
use super::names::{NameHint, Part, Side};
use super::rest_pose::positions;
use super::sample::Sample;
use crate::humanoid::Role;
use crate::math::{Quat, Vec3};
use crate::skeleton::Skeleton;

/// Greatest distance of a foot without a matching name from the end of a shin as long as the thigh, in thigh lengths.
const NEAR: f32 = 0.6;
/// Greatest distance of a foot with a matching name from its knee, in thigh lengths.
const FARTHEST: f32 = 2.5;

/// A foot that does not descend from its leg.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LooseFoot {
    /// Its joint.
    pub joint: usize,
    /// The joint of the lower leg to which it belongs.
    pub lower_leg: usize,
}

/// Returns the feet of a character that do not descend from its legs, found by names and places; empty if both feet descend
/// from legs.
pub fn loose_feet(skeleton: &Skeleton) -> Vec<LooseFoot> {
    let sample = Sample::of(&zero_pose_of(skeleton));
    let roles = find_roles(skeleton, &sample).joint_of_role;
    let at = positions(skeleton, &sample.translations, &vec![Quat::IDENTITY; skeleton.len()]);
    let names: Vec<&str> = skeleton.joints().iter().map(|j| j.name.as_str()).collect();
    let hints = NameHint::of_all(&names);
    let way_up = |joint: usize| std::iter::successors(Some(joint), |&j| skeleton.joints()[j].parent);
    let mut found = Vec::new();
    for (side, [upper, lower, foot]) in [
        (Side::Left, [Role::LeftUpperLeg, Role::LeftLowerLeg, Role::LeftFoot]),
        (Side::Right, [Role::RightUpperLeg, Role::RightLowerLeg, Role::RightFoot]),
    ] {
        let [Some(hip), Some(knee), None] = [upper, lower, foot].map(|role| roles[role.index()]) else { continue };
        let opposite = roles[lower.mirrored().index()];
        let thigh = (at[knee] - at[hip]).length();
        // The end of the shin: at the end of its bone if it has one, else as far below as the thigh is long.
        let end = (0..skeleton.len()).filter(|&j| skeleton.joints()[j].parent == Some(knee)).map(|j| at[j]);
        let ankle = end.max_by(|a, b| from(*a, at[knee]).total_cmp(&from(*b, at[knee])));
        let ankle = ankle.filter(|a| from(*a, at[knee]) > 0.5 * thigh).unwrap_or(2.0 * at[knee] - at[hip]);
        let is_free = |j: usize| {
            j != 0 && !roles.contains(&Some(j)) && !way_up(knee).any(|k| k == j) && !way_up(j).any(|k| k == knee)
                // A joint with other joints of the body below it is not a foot.
                && !roles.iter().flatten().any(|&role| way_up(role).any(|k| k == j))
        };
        let is_nearer = |j: usize| opposite.is_none_or(|other| from(at[j], at[knee]) < from(at[j], at[other]));
        let named = |j: usize| {
            let hint = &hints[j];
            hint.side == Some(side)
                && !hint.is_other
                && hint.weight(Part::Foot) > 0.0
                && from(at[j], at[knee]) < FARTHEST * thigh
        };
        let candidates = || (0..skeleton.len()).filter(|&j| is_free(j));
        let nearest = |joints: &mut dyn Iterator<Item = usize>| {
            joints.min_by(|&a, &b| from(at[a], ankle).total_cmp(&from(at[b], ankle)))
        };
        let by_name = nearest(&mut candidates().filter(|&j| named(j)));
        let by_place = || nearest(&mut candidates().filter(|&j| is_nearer(j) && from(at[j], ankle) < NEAR * thigh));
        if let Some(joint) = by_name.or_else(by_place) {
            found.push(LooseFoot { joint, lower_leg: knee });
        }
    }
    found
}

fn from(a: Vec3, b: Vec3) -> f32 {
    (a - b).length()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::skeleton::Joint;

    /// Legs of a rig for inverse kinematics: the shin has no child, and the foot is a child of the root.
    fn rig(foot: &str, side: f32) -> Skeleton {
        let mut joints = vec![Joint { name: "Root".into(), parent: None, offset: Vec3::ZERO, end: None }];
        let mut add = |name: String, parent: usize, x: f32, y: f32, z: f32| {
            joints.push(Joint { name, parent: Some(parent), offset: Vec3::new(x, y, z), end: None });
            joints.len() - 1
        };
        let hips = add("Hips".into(), 0, 0.0, 0.9, 0.0);
        let spine = add("Spine".into(), hips, 0.0, 0.2, 0.0);
        let chest = add("Chest".into(), spine, 0.0, 0.2, 0.0);
        for (mark, x) in [("L", side), ("R", -side)] {
            let arm = add(format!("UpperArm.{mark}"), chest, 0.2 * x, 0.1, 0.0);
            let fore = add(format!("LowerArm.{mark}"), arm, 0.25 * x, 0.0, 0.0);
            add(format!("Hand.{mark}"), fore, 0.25 * x, 0.0, 0.0);
            let leg = add(format!("UpperLeg.{mark}"), hips, 0.1 * x, 0.0, 0.0);
            add(format!("LowerLeg.{mark}"), leg, 0.0, -0.42, 0.02);
            add(foot.replace('*', mark), 0, 0.1 * x, 0.08, 0.0);
            add(format!("PoleTarget.{mark}"), 0, 0.1 * x, 0.5, 0.9);
        }
        Skeleton::new(joints).unwrap()
    }

    #[test]
    fn feet_on_the_root_are_found_by_name_and_by_place() {
        for foot in ["Foot.*", "Thing.*"] {
            let skeleton = rig(foot, 1.0);
            let name = |j: usize| skeleton.joints()[j].name.clone();
            let pairs: Vec<_> = loose_feet(&skeleton).iter().map(|f| (name(f.joint), name(f.lower_leg))).collect();
            let expected = ["L", "R"].map(|mark| (foot.replace('*', mark), format!("LowerLeg.{mark}")));
            assert_eq!(pairs, expected);
        }
    }
}
