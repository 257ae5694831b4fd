//! Analytic inverse kinematics of a limb of two bones: thigh and shin, or upper arm and forearm.
//!
//! It changes only the reach of the limb: the bend keeps its plane and its side, further bending is about the anatomical
//! hinge, and near full extension the reach is softened so that a knee does not snap straight. A target at the present
//! position changes nothing.

use super::WorldPose;
use crate::humanoid::{PARENTS, Pose, Proportions, Role};
use crate::math::float_funcs::exp;
use crate::math::{Quat, Vec3};

/// Share of the limb's length before full extension over which reaching is softened. Knees in real walks straighten to within
/// 1 to 3 % of it; a larger share would shorten natural steps.
pub const SOFT_SHARE: f32 = 0.02;

/// A limb of the canonical humanoid that inverse kinematics can place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Limb {
    LeftLeg,
    RightLeg,
    LeftArm,
    RightArm,
}

impl Limb {
    /// All limbs, legs first.
    pub const ALL: [Limb; 4] = [Limb::LeftLeg, Limb::RightLeg, Limb::LeftArm, Limb::RightArm];
    /// Both legs, left first.
    pub const LEGS: [Limb; 2] = [Limb::LeftLeg, Limb::RightLeg];
    /// Both arms, left first.
    pub const ARMS: [Limb; 2] = [Limb::LeftArm, Limb::RightArm];

    /// Hip, knee and ankle, or shoulder, elbow and wrist.
    pub const fn roles(self) -> [Role; 3] {
        match self {
            Limb::LeftLeg => [Role::LeftUpperLeg, Role::LeftLowerLeg, Role::LeftFoot],
            Limb::RightLeg => [Role::RightUpperLeg, Role::RightLowerLeg, Role::RightFoot],
            Limb::LeftArm => [Role::LeftUpperArm, Role::LeftLowerArm, Role::LeftHand],
            Limb::RightArm => [Role::RightUpperArm, Role::RightLowerArm, Role::RightHand],
        }
    }

    /// Direction in which the knee or elbow moves when the limb bends, in the canonical frame of the upper bone: knees
    /// forward, elbows backward.
    pub const fn pole(self) -> Vec3 {
        match self {
            Limb::LeftLeg | Limb::RightLeg => Vec3::Z,
            Limb::LeftArm | Limb::RightArm => Vec3::NEG_Z,
        }
    }
}

/// A limb in the world, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoBones {
    /// Hip or shoulder.
    pub upper: Vec3,
    /// Knee or elbow.
    pub middle: Vec3,
    /// Ankle or wrist.
    pub end: Vec3,
    /// Direction in which the middle joint moves when the limb bends about its hinge; any length. It only affects bending
    /// beyond the present bend.
    pub pole: Vec3,
}

/// Rotations that bring a limb to its target, and the resulting positions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reach {
    /// World rotation to apply to the upper bone: `world' = upper_turn * world`.
    pub upper_turn: Quat,
    /// World rotation to apply to the lower bone.
    pub lower_turn: Quat,
    /// New position of the middle joint.
    pub middle: Vec3,
    /// New position of the end.
    pub end: Vec3,
}

impl TwoBones {
    /// Rotates both bones so that the end comes as near to `target` as lengths and soft limit allow.
    ///
    /// The limb swings to the target's direction by the shortest rotation. Then the middle joint moves off the line from
    /// upper joint to target by the offset that the lengths require: along its former offset and, for any excess over that,
    /// along the pole. A limb with a bone of length zero, or with numbers that are not finite, is unchanged.
    pub fn reach(&self, target: Vec3) -> Reach {
        let unchanged =
            Reach { upper_turn: Quat::IDENTITY, lower_turn: Quat::IDENTITY, middle: self.middle, end: self.end };
        let (upper_bone, lower_bone) = (self.middle - self.upper, self.end - self.middle);
        let (upper_length, lower_length) = (upper_bone.length(), lower_bone.length());
        let current = self.end - self.upper;
        let wanted = target - self.upper;
        let ok = upper_length > 1e-5 && lower_length > 1e-5 && (current + wanted + self.pole).is_finite();
        if !ok || wanted.length() < 1e-6 {
            return unchanged;
        }
        let distance = limited_distance(wanted.length(), current.length(), upper_length, lower_length);
        let direction = wanted / wanted.length();
        let swing = Quat::from_rotation_arc(current, direction);

        let swung = swing * upper_bone;
        let former_offset = swung - direction * swung.dot(direction);
        let along =
            (upper_length * upper_length + distance * distance - lower_length * lower_length) / (2.0 * distance);
        let offset = (upper_length * upper_length - along * along).max(0.0).sqrt();
        let pole = swing * self.pole;
        let pole = (pole - direction * pole.dot(direction)).normalize_or_zero();
        let further = (offset - former_offset.length()).max(0.0);
        let side = (former_offset + pole * further).normalize_or_zero();

        let middle = self.upper + direction * along + side * offset;
        let end = self.upper + direction * distance;
        Reach {
            upper_turn: Quat::from_rotation_arc(swung, middle - self.upper) * swing,
            lower_turn: Quat::from_rotation_arc(swing * lower_bone, end - middle) * swing,
            middle,
            end,
        }
    }
}

/// The reached distance for a wanted one: at least the distance of the folded limb, and from [`SOFT_SHARE`] before full
/// extension an exponential approach. A limb that is already straighter may stay so: up to its present extension nothing is
/// softened.
fn limited_distance(wanted: f32, current: f32, upper_length: f32, lower_length: f32) -> f32 {
    let full = upper_length + lower_length;
    let soft_from = (full * (1.0 - SOFT_SHARE)).max(current.min(full));
    let room = full - soft_from;
    let softened = if wanted <= soft_from {
        wanted
    } else if room > 1e-6 * full {
        soft_from + room * (1.0 - exp((soft_from - wanted) / room))
    } else {
        full
    };
    softened.max((upper_length - lower_length).abs()).max(1e-4 * full)
}

/// Moves the end joint of `limb` (ankle or wrist) to `target` by rotating its two bones; the end joint keeps its world
/// rotation. `world` must be the forward kinematics of `pose` and is updated with it. Returns the remaining distance between
/// target and end joint, metres.
pub fn two_bone_ik(proportions: &Proportions, pose: &mut Pose, world: &mut WorldPose, limb: Limb, target: Vec3) -> f32 {
    let [upper, middle, end] = limb.roles().map(Role::index);
    let bones = TwoBones {
        upper: world.positions[upper],
        middle: world.positions[middle],
        end: world.positions[end],
        pole: world.rotations[upper] * limb.pole(),
    };
    let reach = bones.reach(target);

    world.rotations[upper] = (reach.upper_turn * world.rotations[upper]).normalized();
    world.rotations[middle] = (reach.lower_turn * world.rotations[middle]).normalized();
    for joint in [upper, middle, end] {
        pose.rotations[joint] = world.rotations[PARENTS[joint]].inv_mul(world.rotations[joint]);
    }
    // Positions from offsets, not from the solution: rounding must not make `world` and `pose` differ.
    world.positions[middle] = world.positions[upper] + world.rotations[upper] * proportions.offsets[middle];
    world.positions[end] = world.positions[middle] + world.rotations[middle] * proportions.offsets[end];
    for toes in (end + 1..PARENTS.len()).filter(|&j| PARENTS[j] == end) {
        world.positions[toes] = world.positions[end] + world.rotations[end] * proportions.offsets[toes];
    }
    (world.positions[end] - target).length()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::humanoid::JOINTS;
    use crate::kinematics::world_from_local;
    use crate::math::exp_map;
    use proptest::prelude::*;

    fn pose() -> impl Strategy<Value = Pose> {
        prop::collection::vec(prop::array::uniform3(-1.0f32..1.0), JOINTS).prop_map(|turns| {
            let mut pose = Pose::default();
            for (q, v) in pose.rotations.iter_mut().zip(turns) {
                *q = exp_map::exp(Vec3::from_array(v));
            }
            pose
        })
    }

    fn limb() -> impl Strategy<Value = Limb> {
        prop::sample::select(&Limb::ALL[..])
    }

    fn solved(mut pose: Pose, limb: Limb, target: Vec3) -> (Pose, WorldPose, f32) {
        let p = Proportions::default();
        let mut world = world_from_local(&p, &pose);
        let residual = two_bone_ik(&p, &mut pose, &mut world, limb, target);
        (pose, world, residual)
    }

    /// A left leg in mid-stride: thigh forward, shin back.
    fn bent_leg() -> Pose {
        let mut pose = Pose::default();
        pose.rotations[Role::LeftUpperLeg.index()] = Quat::from_rotation_x(-0.4);
        pose.rotations[Role::LeftLowerLeg.index()] = Quat::from_rotation_x(0.8);
        pose
    }

    proptest! {
        #[test]
        fn a_target_within_reach_is_reached(p in pose(), l in limb(), dir in prop::array::uniform3(-1.0f32..1.0), share in 0.2f32..0.97) {
            let dir = Vec3::from_array(dir);
            prop_assume!(dir.length() > 0.1);
            let world = world_from_local(&Proportions::default(), &p);
            let [upper, middle, end] = l.roles().map(Role::index);
            let offsets = Proportions::default().offsets;
            let length = offsets[middle].length() + offsets[end].length();
            let target = world.positions[upper] + dir.normalize() * length * share;
            let (_, _, residual) = solved(p, l, target);
            prop_assert!(residual < 1e-4, "{residual}");
        }

        #[test]
        fn world_stays_the_forward_kinematics_and_other_joints_stay(p in pose(), l in limb(), t in prop::array::uniform3(-1.5f32..1.5)) {
            let before = world_from_local(&Proportions::default(), &p);
            let (after, world, _) = solved(p, l, Vec3::from_array(t));
            let fresh = world_from_local(&Proportions::default(), &after);
            let [upper, middle, end] = l.roles().map(Role::index);
            for j in 0..JOINTS {
                prop_assert!((fresh.positions[j] - world.positions[j]).length() < 1e-4);
                if j != upper && j != middle {
                    prop_assert!(before.rotations[j].dot(world.rotations[j]).abs() > 1.0 - 1e-5, "joint {j} of end {end}");
                }
            }
        }

        #[test]
        fn a_target_at_the_present_position_changes_nothing(p in pose(), l in limb()) {
            let before = world_from_local(&Proportions::default(), &p);
            let [_, middle, end] = l.roles().map(Role::index);
            let (_, world, residual) = solved(p, l, before.positions[end]);
            prop_assert!(residual < 1e-4);
            prop_assert!((world.positions[middle] - before.positions[middle]).length() < 1e-3);
        }

        #[test]
        fn numbers_that_are_not_finite_leave_the_limb_alone(p in pose(), l in limb()) {
            let (after, _, _) = solved(p, l, Vec3::new(f32::NAN, 0.0, 0.0));
            prop_assert!(after.is_finite());
        }
    }

    #[test]
    fn shortening_a_straight_leg_bends_the_knee_forward() {
        let straight = world_from_local(&Proportions::default(), &Pose::default());
        let ankle = straight.positions[Role::LeftFoot.index()];
        let (pose, world, residual) = solved(Pose::default(), Limb::LeftLeg, ankle + Vec3::new(0.0, 0.1, 0.0));
        assert!(residual < 1e-4);
        let knee = world.positions[Role::LeftLowerLeg.index()];
        assert!(knee.z > 0.15 && (knee.x - ankle.x).abs() < 1e-3, "{knee}");
        let flexion = exp_map::log(pose.rotations[Role::LeftLowerLeg.index()]);
        assert!(flexion.x > 0.5 && flexion.y.abs() + flexion.z.abs() < 1e-3, "{flexion}");
    }

    #[test]
    fn a_bent_leg_keeps_its_plane() {
        let pose = bent_leg();
        let before = world_from_local(&Proportions::default(), &pose);
        let ankle = before.positions[Role::LeftFoot.index()];
        let (_, world, _) = solved(pose, Limb::LeftLeg, ankle + Vec3::new(0.0, 0.08, 0.05));
        let knee = world.positions[Role::LeftLowerLeg.index()];
        assert!((knee.x - ankle.x).abs() < 1e-4, "{knee}");
    }

    #[test]
    fn reaching_out_approaches_full_extension_without_a_corner() {
        let pose = bent_leg();
        let before = world_from_local(&Proportions::default(), &pose);
        let hip = before.positions[Role::LeftUpperLeg.index()];
        let full = Proportions::default().leg_length();
        let reached = |d: f32| {
            let (_, world, _) = solved(pose, Limb::LeftLeg, hip - Vec3::Y * d);
            (world.positions[Role::LeftFoot.index()] - hip).length()
        };
        let distances: Vec<f32> = (0..40).map(|i| reached(full * (0.96 + 0.002 * i as f32))).collect();
        let steps: Vec<f32> = distances.windows(2).map(|w| w[1] - w[0]).collect();
        assert!(steps.iter().all(|&s| s > -1e-5), "monotone: {steps:?}");
        assert!(steps.windows(2).all(|w| (w[1] - w[0]).abs() < 4e-4), "no corner: {steps:?}");
        assert!(distances.iter().all(|&d| d < full));
    }
}
