//! World rotations of a file's joints when the body stands in the T-pose.
//!
//! If the zero pose resembles a person (legs down, spine up, limbs straight), it is bent into the T-pose by the shortest
//! rotations. If not (Bandai Namco's bones lie along a local axis), each joint's frame is derived from anatomy: directions of
//! the bones, hinge axes of knees and elbows, mean rotations of the trunk. All are snapped to the nearest local coordinate
//! axes, so that every clip of a skeleton gives the same rest pose.

use super::body_tree::BodyTree;
use super::sample::Sample;
use crate::humanoid::{JOINTS, Role};
use crate::math::float_funcs::{asin, atan2, sin_cos};
use crate::math::{Quat, Vec3};
use crate::skeleton::Skeleton;
use std::f32::consts::FRAC_PI_2;

/// Directions nearer than this to a coordinate axis are snapped to it: cosine of 25°. Skeletons are modelled along axes;
/// smaller deviations are estimation errors.
const SNAP_COSINE: f32 = 0.906;

/// Pitch of the line from ankle to toe joint below the horizontal with a flat sole, radians, if the zero pose does not give
/// it. Bandai Namco's avatars have 39.6°; ankles of game rigs are as high.
const FOOT_PITCH: f32 = 0.69;

/// Upward bend of the toes relative to the foot with a flat sole, radians, if the zero pose does not give it. Bandai Namco's
/// avatars have 16.6°.
const TOE_BEND: f32 = 0.29;

/// Weight of a hinge axis guessed from the mean pose relative to one observed in bending, which has the squared sine of the
/// bend as weight: they are equal at 8°.
const GUESSED_HINGE: f32 = 0.02;

/// World rotation of each file joint in the T-pose facing +Z, +Y up.
pub(super) struct RestPose {
    pub(super) world_rotations: Vec<Quat>,
    /// Whether the file's zero pose served as the reference.
    pub(super) from_zero_pose: bool,
    /// Direction of the body's up axis in the zero pose, if that served as the reference.
    pub(super) zero_up: Option<Vec3>,
    /// Pitch of the left and the right foot in the zero pose, from ankle to toe joint above the horizontal, if that served as
    /// the reference: radians.
    pub(super) zero_foot_pitch: [Option<f32>; 2],
}

/// Direction of each limb bone in the T-pose: role, the role at its end, direction.
const LIMB_BONES: [(Role, Role, Vec3); 8] = [
    (Role::LeftUpperLeg, Role::LeftLowerLeg, Vec3::NEG_Y),
    (Role::LeftLowerLeg, Role::LeftFoot, Vec3::NEG_Y),
    (Role::RightUpperLeg, Role::RightLowerLeg, Vec3::NEG_Y),
    (Role::RightLowerLeg, Role::RightFoot, Vec3::NEG_Y),
    (Role::LeftUpperArm, Role::LeftLowerArm, Vec3::X),
    (Role::LeftLowerArm, Role::LeftHand, Vec3::X),
    (Role::RightUpperArm, Role::RightLowerArm, Vec3::NEG_X),
    (Role::RightLowerArm, Role::RightHand, Vec3::NEG_X),
];

/// Axis about which knees and elbows flex, in the canonical frames of both bones.
fn hinge_of(bone: Role) -> Vec3 {
    match bone {
        Role::LeftUpperArm | Role::LeftLowerArm => Vec3::NEG_Y,
        Role::RightUpperArm | Role::RightLowerArm => Vec3::Y,
        _ => Vec3::X,
    }
}

/// Computes the rest pose of a skeleton whose required roles are known.
pub(super) fn rest_pose(skeleton: &Skeleton, roles: &[Option<usize>; JOINTS], sample: &Sample) -> RestPose {
    let tree = BodyTree::of_skeleton(skeleton, roles);
    let body = Body { skeleton, tree, roles, sample, role_of_joint: invert(skeleton.len(), roles) };
    match body.zero_pose_frame() {
        Some(frame) => RestPose {
            world_rotations: body.bend_zero_pose(frame),
            from_zero_pose: true,
            zero_up: Some(frame.inv_mul_vec3(Vec3::Y)),
            zero_foot_pitch: body.zero_foot_pitch(frame),
        },
        None => RestPose {
            world_rotations: body.read_anatomy(),
            from_zero_pose: false,
            zero_up: None,
            zero_foot_pitch: [None; 2],
        },
    }
}

fn invert(joints: usize, roles: &[Option<usize>; JOINTS]) -> Vec<Option<Role>> {
    let mut role_of_joint = vec![None; joints];
    for (role, joint) in Role::ALL.iter().zip(roles) {
        if let Some(j) = joint {
            role_of_joint[*j] = Some(*role);
        }
    }
    role_of_joint
}

/// Positions of all joints for these world rotations; the root at the origin.
pub(super) fn positions(skeleton: &Skeleton, translations: &[Vec3], world_rotations: &[Quat]) -> Vec<Vec3> {
    let mut positions = vec![Vec3::ZERO; skeleton.len()];
    for (j, joint) in skeleton.joints().iter().enumerate() {
        if let Some(p) = joint.parent {
            positions[j] = positions[p] + world_rotations[p] * translations[j];
        }
    }
    positions
}

struct Body<'a> {
    skeleton: &'a Skeleton,
    tree: BodyTree,
    roles: &'a [Option<usize>; JOINTS],
    sample: &'a Sample,
    role_of_joint: Vec<Option<Role>>,
}

impl Body<'_> {
    fn at(&self, role: Role) -> Option<usize> {
        self.roles[role.index()]
    }

    /// Joint of a required role; the root if it is missing.
    fn required(&self, role: Role) -> usize {
        self.at(role).unwrap_or(0)
    }

    fn parent(&self, joint: usize) -> Option<usize> {
        self.tree.parents[joint]
    }

    /// Mean position where the bone of a joint begins, relative to that of `of` and in its frame.
    fn mean_local(&self, of: usize, joint: usize) -> Vec3 {
        let [from, to] = [of, joint].map(|j| self.tree.begins[j]);
        if [from, to] == [of, joint] {
            return self.sample.mean_local(of, joint);
        }
        self.sample.mean(|w| w[of].1.inv_mul_vec3(w[to].0 - w[from].0))
    }

    /// Top of the trunk, to which the spine points.
    fn trunk_top(&self) -> usize {
        let tops = [Role::Neck, Role::Head, Role::Chest, Role::Spine];
        tops.iter().find_map(|&r| self.at(r)).unwrap_or(0)
    }

    /// The joint to which the bone of a role points, if there is one.
    fn bone_end(&self, role: Role) -> Option<usize> {
        let end = |roles: &[Role]| roles.iter().find_map(|&r| self.at(r));
        match role {
            Role::Spine => end(&[Role::Chest, Role::Neck, Role::Head]),
            Role::Chest => end(&[Role::Neck, Role::Head]),
            Role::Neck => end(&[Role::Head]),
            Role::LeftShoulder => end(&[Role::LeftUpperArm]),
            Role::RightShoulder => end(&[Role::RightUpperArm]),
            Role::LeftFoot => end(&[Role::LeftToes]),
            Role::RightFoot => end(&[Role::RightToes]),
            _ => LIMB_BONES.iter().find(|(r, ..)| *r == role).and_then(|(_, e, _)| self.at(*e)),
        }
    }

    // ── from the zero pose ──────────────────────────────────────────────────────────────────────────

    /// The rotation that takes the zero pose to facing +Z with +Y up; `None` unless it resembles a person with about straight
    /// legs and arms.
    fn zero_pose_frame(&self) -> Option<Quat> {
        let zero = positions(self.skeleton, &self.sample.translations, &vec![Quat::IDENTITY; self.skeleton.len()]);
        let toward = |from: Role, to: Role| (zero[self.required(to)] - zero[self.required(from)]).normalize_or_zero();
        let mut down = Vec3::ZERO;
        for (upper, lower, end) in [
            (Role::LeftUpperLeg, Role::LeftLowerLeg, Role::LeftFoot),
            (Role::RightUpperLeg, Role::RightLowerLeg, Role::RightFoot),
            (Role::LeftUpperArm, Role::LeftLowerArm, Role::LeftHand),
            (Role::RightUpperArm, Role::RightLowerArm, Role::RightHand),
        ] {
            if toward(upper, lower).dot(toward(lower, end)) < 0.7 {
                return None;
            }
            if matches!(end, Role::LeftFoot | Role::RightFoot) {
                down += toward(upper, end);
            }
        }
        let hips = 0.5 * (zero[self.required(Role::LeftUpperLeg)] + zero[self.required(Role::RightUpperLeg)]);
        let up = (zero[self.tree.begins[self.trunk_top()]] - hips).normalize_or_zero();
        let left = toward(Role::RightUpperLeg, Role::LeftUpperLeg);
        let arms_apart = toward(Role::RightHand, Role::LeftHand).dot(left);
        let legs_parallel = down.length() > 1.6;
        let upright = up.dot(down.normalize_or_zero()) < -0.8;
        if !(legs_parallel && upright && left.dot(up).abs() < 0.5 && arms_apart > 0.5) {
            return None;
        }
        let up = snapped((up - down.normalize_or_zero()).normalize_or_zero());
        Some(frame_of(left, up).inverse())
    }

    fn zero_foot_pitch(&self, frame: Quat) -> [Option<f32>; 2] {
        let zero = positions(self.skeleton, &self.sample.translations, &vec![Quat::IDENTITY; self.skeleton.len()]);
        [(Role::LeftFoot, Role::LeftToes), (Role::RightFoot, Role::RightToes)].map(|(foot, toes)| {
            let bone = zero[self.at(toes)?] - zero[self.at(foot)?];
            Some(asin((frame * bone).normalize_or_zero().y.clamp(-1.0, 1.0)))
        })
    }

    fn bend_zero_pose(&self, frame: Quat) -> Vec<Quat> {
        let n = self.skeleton.len();
        let zero = positions(self.skeleton, &self.sample.translations, &vec![Quat::IDENTITY; n]);
        let mut rest = vec![frame; n];
        for &j in &self.tree.order {
            let Some(p) = self.parent(j) else { continue };
            rest[j] = rest[p];
            let Some(role) = self.role_of_joint[j] else { continue };
            let Some(end) = self.bone_end(role) else { continue };
            let bone = zero[end] - zero[j];
            if let Some((_, _, direction)) = LIMB_BONES.iter().find(|(r, ..)| *r == role) {
                rest[j] = Quat::from_rotation_arc(rest[j] * bone, *direction) * rest[j];
            } else if matches!(role, Role::LeftFoot | Role::RightFoot) {
                // The foot has the slope of the zero pose, which is standing, not that of the shin, which may lean.
                let slope = -asin((frame * bone).normalize_or_zero().y);
                let pitch = if (0.0..1.05).contains(&slope) { slope } else { FOOT_PITCH };
                rest[j] = pitched(rest[j], bone, pitch);
            }
        }
        rest
    }

    // ── from anatomy ────────────────────────────────────────────────────────────────────────────────

    fn read_anatomy(&self) -> Vec<Quat> {
        let n = self.skeleton.len();
        let mut rest = vec![Quat::IDENTITY; n];
        for &j in &self.tree.order {
            rest[j] = match self.role_of_joint[j] {
                Some(Role::Hips) => self.hips_frame(j).inverse(),
                Some(role) => self.joint_rest(role, j, &rest),
                None => {
                    let parent = self.parent(j).map_or(Quat::IDENTITY, |p| rest[p]);
                    parent * self.usual_local(j)
                }
            };
        }
        rest
    }

    /// Axes of the pelvis in the hips' own frame: the hip joints give left, the trunk gives up.
    fn hips_frame(&self, hips: usize) -> Quat {
        let local = |r: Role| self.mean_local(hips, self.required(r));
        let left = local(Role::LeftUpperLeg) - local(Role::RightUpperLeg);
        let trunk = [Role::Spine, Role::Chest, Role::Neck].iter().filter_map(|&r| self.at(r));
        let ups = trunk.map(|j| self.mean_local(hips, j));
        let up = ups.into_iter().find(|v| v.length() > 0.1 * left.length()).unwrap_or(Vec3::Y);
        frame_of(left, snapped(up))
    }

    /// Mean rotation of a joint relative to the canonical frame of its nearest mapped ancestor: the trunk, the clavicles
    /// and the feet are near rest on average.
    fn mean_in_parent(&self, joint: usize, rest: &[Quat]) -> Quat {
        let ancestor = std::iter::successors(self.parent(joint), |&p| self.parent(p))
            .find(|&p| self.role_of_joint[p].is_some())
            .unwrap_or(0);
        self.sample.mean_rotation(|w| (w[ancestor].1 * rest[ancestor].inverse()).inv_mul(w[joint].1))
    }

    /// Local rotation of a joint without a role in the T-pose.
    fn usual_local(&self, joint: usize) -> Quat {
        let mean = self.sample.mean_rotation(|w| match self.parent(joint) {
            Some(p) => w[p].1.inv_mul(w[joint].1),
            None => w[joint].1,
        });
        let axes = nearest_axes(mean);
        if axes.inv_mul(mean).angle() < 0.44 { axes } else { mean }
    }

    fn joint_rest(&self, role: Role, joint: usize, rest: &[Quat]) -> Quat {
        let bone = self.bone_end(role).map(|end| self.mean_local(joint, end));
        let bone = bone.filter(|b| b.length() > 1e-6);
        match (role, bone) {
            (Role::LeftFoot | Role::RightFoot, Some(toes)) => {
                let mean = self.mean_in_parent(joint, rest);
                let across = snapped_across(mean.inv_mul_vec3(Vec3::X), toes);
                // Local axes across, and from ankle to toes, to +X and +Z; then the slope of the bone.
                let flat = Quat::from_basis(across, toes.normalize_or_zero().cross(across), toes.normalize_or_zero());
                pitched(flat.inverse(), toes, FOOT_PITCH)
            }
            (_, Some(bone)) => {
                if let Some(&(_, end, direction)) = LIMB_BONES.iter().find(|(r, ..)| *r == role) {
                    return self.limb_rest(role, end, direction, rest);
                }
                let target = match role {
                    Role::LeftShoulder => Vec3::X,
                    Role::RightShoulder => Vec3::NEG_X,
                    _ => Vec3::Y,
                };
                nearest_turn_about(target, snapped(bone), self.mean_in_parent(joint, rest))
            }
            (Role::LeftToes | Role::RightToes, None) => Quat::from_rotation_x(-TOE_BEND) * self.leaf_rest(joint, rest),
            (_, None) => self.leaf_rest(joint, rest),
        }
    }

    /// Hands, heads and toes have no child joint: their rest rotation is that of their parent's frame, or along the nearest
    /// axes if their mean rotation is more than a quarter turn from it.
    fn leaf_rest(&self, joint: usize, rest: &[Quat]) -> Quat {
        let parent = self.parent(joint).map_or(Quat::IDENTITY, |p| rest[p]);
        let mean = self.mean_in_parent(joint, rest);
        let from_parent = parent.inv_mul(mean).angle();
        if from_parent < 1.7 { parent } else { nearest_axes(mean) }
    }

    /// Frame of a limb bone: its direction and the axis about which the knee or elbow bends.
    fn limb_rest(&self, role: Role, end: Role, direction: Vec3, rest: &[Quat]) -> Quat {
        let (joint, end) = (self.required(role), self.required(end));
        let bone = self.mean_local(joint, end).normalize_or_zero();
        let chain = limb_chain(role);
        let [upper, middle, tip] = chain.map(|r| self.required(r));
        let hinge = hinge_of(role);
        let is_arm = direction != Vec3::NEG_Y;
        let trunk_role = match self.at(Role::Chest) {
            Some(_) if is_arm => Role::Chest,
            None if is_arm => Role::Spine,
            _ => Role::Hips,
        };
        let trunk = self.required(trunk_role);
        let seen = self.sample.mean(|w| {
            let a = (w[middle].0 - w[upper].0).normalize_or_zero();
            let b = (w[tip].0 - w[middle].0).normalize_or_zero();
            let axis = a.cross(b);
            w[joint].1.inv_mul_vec3(axis * axis.length())
        });
        let guessed = self.sample.mean(|w| {
            let trunk_frame = w[trunk].1 * rest[trunk].inverse();
            let along = trunk_frame.inv_mul_vec3(w[joint].1 * bone);
            // Hanging arms are raised sideways before their hinge is compared; hanging legs are at rest.
            let raised = if is_arm { Quat::from_rotation_arc(along, direction) } else { Quat::IDENTITY };
            w[joint].1.inv_mul_vec3(trunk_frame * raised.inv_mul_vec3(hinge))
        });
        let evidence = (seen + GUESSED_HINGE * guessed).normalize_or_zero();
        // A forearm whose zero rotation continues the upper arm is at rest there: rotation about the bone is pronation and
        // does not affect the hinge. Shins hardly twist.
        let above = self.parent(joint).map_or(Quat::IDENTITY, |p| rest[p]);
        let turned = if is_arm { -0.7 } else { 0.7 };
        let continues = role == chain[1] && (above * bone).dot(direction) > SNAP_COSINE;
        if continues && (above * evidence).dot(hinge) > turned {
            return Quat::from_rotation_arc(above * bone, direction) * above;
        }
        let axis = snapped_across(evidence, bone);
        // Columns: bone and hinge in the local frame, and in the T-pose.
        let local = Quat::from_basis(axis, bone, axis.cross(bone));
        let canonical = Quat::from_basis(hinge, direction, hinge.cross(direction));
        (canonical * local.inverse()).normalized()
    }
}

/// Upper joint, middle joint and end of a bone's limb.
fn limb_chain(bone: Role) -> [Role; 3] {
    use crate::kinematics::Limb;
    let limb = Limb::ALL.into_iter().find(|l| l.roles().contains(&bone));
    limb.unwrap_or(Limb::LeftLeg).roles()
}

/// Rotates `rest` so that the local vector `bone` points forward (+Z) and `pitch` radians down, first by the shortest turn
/// about +Y.
fn pitched(rest: Quat, bone: Vec3, pitch: f32) -> Quat {
    let direction = rest * bone.normalize_or_zero();
    let yaw = if direction.x.abs() + direction.z.abs() > 1e-3 { atan2(direction.x, direction.z) } else { 0.0 };
    let ahead = Quat::from_rotation_y(-yaw) * rest;
    let (sin, cos) = sin_cos(pitch);
    Quat::from_rotation_arc(ahead * bone, Vec3::new(0.0, -sin, cos)) * ahead
}

/// Rotation whose columns are left, up and forward: `up` as given, `left` made orthogonal and snapped.
fn frame_of(left: Vec3, up: Vec3) -> Quat {
    let left = orthogonal(snapped(left.normalize_or_zero()), up);
    Quat::from_basis(left, up, left.cross(up))
}

/// The component of `v` orthogonal to `to`, of unit length; any such direction if it is almost zero.
fn orthogonal(v: Vec3, to: Vec3) -> Vec3 {
    let to = to.normalize_or_zero();
    let part = v - to * v.dot(to);
    if part.length() > 0.1 {
        return part.normalize_or_zero();
    }
    let helper = if to.x.abs() < 0.6 { Vec3::X } else { Vec3::Y };
    (helper - to * helper.dot(to)).normalize_or_zero()
}

/// The nearest coordinate axis of a direction, or the unit direction itself if none is near.
fn snapped(v: Vec3) -> Vec3 {
    let v = v.normalize_or_zero();
    let axis = AXES.into_iter().max_by(|a, b| a.dot(v).total_cmp(&b.dot(v))).unwrap_or(Vec3::X);
    if v.dot(axis) > SNAP_COSINE { axis } else { v }
}

/// The direction orthogonal to `bone` nearest to `v`: a coordinate axis if the bone is along one, else the snapped direction.
fn snapped_across(v: Vec3, bone: Vec3) -> Vec3 {
    let along = snapped(bone);
    if !is_axis(along) {
        return orthogonal(snapped(v), bone);
    }
    let axes = AXES.into_iter().filter(|a| a.dot(along) == 0.0);
    let nearest = axes.max_by(|a, b| a.dot(v).total_cmp(&b.dot(v))).unwrap_or(Vec3::X);
    orthogonal(nearest, bone)
}

/// The six coordinate axes.
const AXES: [Vec3; 6] = [Vec3::X, Vec3::Y, Vec3::Z, Vec3::NEG_X, Vec3::NEG_Y, Vec3::NEG_Z];

/// Whether a unit vector is a coordinate axis.
fn is_axis(v: Vec3) -> bool {
    AXES.contains(&v)
}

/// The nearest to `q` of the 24 rotations that take coordinate axes to coordinate axes.
fn nearest_axes(q: Quat) -> Quat {
    let mut best = Quat::IDENTITY;
    for x in AXES {
        for y in AXES.into_iter().filter(|y| x.dot(*y) == 0.0) {
            let candidate = Quat::from_basis(x, y, x.cross(y));
            if candidate.dot(q).abs() > best.dot(q).abs() {
                best = candidate;
            }
        }
    }
    best
}

/// The nearest to `q` of the rotations that take the local direction `from` to `to`, in quarter turns about `to` if `from` is
/// a coordinate axis.
fn nearest_turn_about(to: Vec3, from: Vec3, q: Quat) -> Quat {
    let base = Quat::from_rotation_arc(from, to);
    if is_axis(from) {
        let turns = (0..4).map(|i| Quat::from_axis_angle(to, FRAC_PI_2 * i as f32) * base);
        return turns.max_by(|a, b| a.dot(q).abs().total_cmp(&b.dot(q).abs())).unwrap_or(base);
    }
    let (_, twist) = (q * base.inverse()).swing_twist(to);
    twist * base
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn directions_near_an_axis_are_the_axis() {
        assert_eq!(snapped(Vec3::new(0.3, -0.9, 0.1)), Vec3::NEG_Y);
        let oblique = Vec3::new(0.6, 0.8, 0.0);
        assert!((snapped(oblique) - oblique).length() < 1e-6);
    }

    proptest! {
        #[test]
        fn rotations_along_axes_are_their_own_nearest(i in 0u8..4, j in 0u8..4, k in 0u8..4) {
            let quarter = |axis: Vec3, n: u8| Quat::from_axis_angle(axis, FRAC_PI_2 * f32::from(n));
            let q = quarter(Vec3::X, i) * quarter(Vec3::Y, j) * quarter(Vec3::Z, k);
            prop_assert!(nearest_axes(q * Quat::from_axis_angle(Vec3::Y, 0.3)).dot(q).abs() > 1.0 - 1e-5);
        }

        #[test]
        fn a_pitched_foot_points_ahead_and_down(turn in prop::array::uniform3(-1.0f32..1.0), pitch in 0.0f32..1.0) {
            let rest = crate::math::exp_map::exp(Vec3::from_array(turn));
            let toes = Vec3::new(0.2, -0.1, 0.9);
            let d = pitched(rest, toes, pitch) * toes.normalize();
            prop_assert!(d.x.abs() < 1e-4 && d.z > 0.0 && (asin(-d.y) - pitch).abs() < 1e-3, "{d}");
        }
    }
}
