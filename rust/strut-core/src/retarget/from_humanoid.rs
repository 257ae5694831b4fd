//! Retargeting from the canonical humanoid back to a file's skeleton.

use super::Binding;
use super::body_tree::BodyTree;
use super::sample::local;
use super::scale::BodyScale;
use super::stance::{SolePoint, Stance};
use crate::humanoid::{HumanoidMotion, Pose, Proportions, Role};
use crate::kinematics::{Limb, TwoBones, WorldPose, world_from_local};
use crate::math::{Quat, Vec3};
use crate::motion::Motion;

/// Source of a joint's rotation relative to the T-pose.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Turn {
    /// That of a role.
    Of(Role),
    /// Interpolated between the lower and the upper end of the trunk, by this share.
    AlongTrunk(f32),
}

/// Retargets canonical poses to a bound skeleton, one at a time and without allocation.
#[derive(Clone, Debug)]
pub struct FromHumanoid {
    binding: Binding,
    body: Proportions,
    scale: BodyScale,
    /// Adjusts a character's soles to the ground; without it ankles are only scaled.
    stance: Option<Stance>,
    /// Source of each file joint's world rotation; joints without one keep their own local rotation.
    turns: Vec<Option<Turn>>,
    /// The joint whose translation moves the body through the world.
    mover: usize,
    positions: Vec<Vec3>,
    rotations: Vec<Quat>,
}

impl FromHumanoid {
    /// Creates the retargeting from a body to the skeleton of `binding`. `source` is a clip of that skeleton; its channels
    /// determine the joint that moves the body through the world.
    ///
    /// # Panics
    /// If the skeleton of `source` is not the one that was bound ([`Binding::fits`]).
    pub fn new(binding: &Binding, body: &Proportions, source: &Motion) -> Self {
        Self::moving(binding, body, moving_joint(binding, source))
    }

    /// Creates the retargeting to a rigged character, which has no clip: the hips move the body, and joints between spine and
    /// chest share the rotation of the trunk, so that the spine bends smoothly.
    ///
    /// Feet stand like those of the body whatever their proportions, and `sole_points` are kept from penetrating the ground.
    pub fn for_character(binding: &Binding, body: &Proportions, sole_points: &[SolePoint]) -> Self {
        let hips = binding.joint_of_role[Role::Hips.index()].unwrap_or(0);
        let mut retarget = Self::moving(binding, body, hips);
        let ratio = 1.0 / retarget.scale.legs();
        retarget.stance = Some(Stance::between(body, binding, ratio, sole_points));
        for (joint, share) in trunk_shares(binding) {
            if retarget.turns[joint].is_none() {
                retarget.turns[joint] = Some(Turn::AlongTrunk(share));
            }
        }
        retarget
    }

    fn moving(binding: &Binding, body: &Proportions, mover: usize) -> Self {
        let joints = binding.parents.len();
        let mut turns = vec![None; joints];
        for (role, joint) in Role::ALL.iter().zip(binding.joint_of_role) {
            if let Some(j) = joint {
                turns[j] = Some(Turn::Of(*role));
            }
        }
        // Without a chest joint, the trunk's only joint is the parent of neck and shoulders.
        if binding.joint_of_role[Role::Chest.index()].is_none()
            && let Some(spine) = binding.joint_of_role[Role::Spine.index()]
        {
            turns[spine] = Some(Turn::Of(Role::Chest));
        }
        Self {
            binding: binding.clone(),
            body: *body,
            scale: BodyScale::between(&binding.proportions, body),
            stance: None,
            turns,
            mover,
            positions: vec![Vec3::ZERO; joints],
            rotations: vec![Quat::IDENTITY; joints],
        }
    }

    /// Writes the local transforms of one frame. On entry they must contain a frame of the file: joints without a role keep
    /// it, and all but the joint that moves the body keep their translations.
    ///
    /// # Panics
    /// If there are fewer transforms than joints.
    pub fn frame(&mut self, pose: &Pose, translations: &mut [Vec3], rotations: &mut [Quat]) {
        self.mirror(translations, rotations);
        self.write_frame(pose, translations, rotations);
        self.mirror(translations, rotations);
    }

    /// Converts between a mirrored file and its mirror image.
    fn mirror(&self, translations: &mut [Vec3], rotations: &mut [Quat]) {
        if self.binding.is_mirrored {
            for (translation, rotation) in translations.iter_mut().zip(rotations) {
                (*translation, *rotation) = local(*translation, *rotation, true);
            }
        }
    }

    fn write_frame(&mut self, pose: &Pose, translations: &mut [Vec3], rotations: &mut [Quat]) {
        let world = world_from_local(&self.body, pose);
        self.turn_joints(&world, translations, rotations);
        self.move_body(&world, translations);
        for (i, leg) in Limb::LEGS.into_iter().enumerate() {
            let [hip, _, ankle] = leg.roles();
            let hip = world.positions[hip.index()];
            let ankle = hip + self.scale.leg_to_file(i, world.positions[ankle.index()] - hip);
            let scaled = self.scale.to_file(ankle);
            let placed = self.stance.as_ref().map_or(scaled, |stance| stance.ankle(i, &world, scaled));
            self.reach(&world, leg, self.place_in_file(placed), rotations);
        }
        for (i, arm) in Limb::ARMS.into_iter().enumerate() {
            let [shoulder, _, wrist] = arm.roles();
            let reach = world.positions[wrist.index()] - world.positions[shoulder.index()];
            let target = self.positions[self.joint(shoulder)] + self.in_file(reach / self.scale.arm(i));
            self.reach(&world, arm, target, rotations);
        }
    }

    /// Converts a vector from metres and our axes to the file's unit and axes.
    fn in_file(&self, v: Vec3) -> Vec3 {
        self.binding.world_from_file.inv_mul_vec3(v) / self.binding.metres_per_unit
    }

    /// Converts a place above our ground to the file's unit and axes.
    fn place_in_file(&self, place: Vec3) -> Vec3 {
        self.in_file(place + Vec3::Y * self.binding.floor_metres)
    }

    /// The joint of a required role.
    fn joint(&self, role: Role) -> usize {
        self.binding.joint_of_role[role.index()].unwrap_or(0)
    }

    /// Converts world rotations by role, W = G · Wᵣ with the rest rotation Wᵣ, to local rotations, and updates positions.
    fn turn_joints(&mut self, world: &WorldPose, translations: &[Vec3], rotations: &mut [Quat]) {
        for joint in 0..self.turns.len() {
            let (position, above) = match self.binding.parents[joint] {
                Some(p) => (self.positions[p], self.rotations[p]),
                None => (Vec3::ZERO, Quat::IDENTITY),
            };
            if let Some(turn) = self.turns[joint] {
                let turned = match turn {
                    Turn::Of(role) => world.rotations[role.index()],
                    Turn::AlongTrunk(share) => {
                        let [spine, chest] = [Role::Spine, Role::Chest].map(|r| world.rotations[r.index()]);
                        spine.slerp(chest, share)
                    }
                };
                let turn = turned * self.binding.rest_world_rotations[joint];
                rotations[joint] = above.inv_mul(self.binding.world_from_file.inv_mul(turn)).normalized();
            }
            self.positions[joint] = position + above * translations[joint];
            self.rotations[joint] = above * rotations[joint];
        }
    }

    /// Shifts the body so that its hip joints are at the canonical ones' places.
    fn move_body(&mut self, world: &WorldPose, translations: &mut [Vec3]) {
        let (left, right) = (Role::LeftUpperLeg, Role::RightUpperLeg);
        let canonical = 0.5 * (world.positions[left.index()] + world.positions[right.index()]);
        let current = 0.5 * (self.positions[self.joint(left)] + self.positions[self.joint(right)]);
        let shift = self.place_in_file(self.scale.to_file(canonical)) - current;
        let above = self.binding.parents[self.mover].map_or(Quat::IDENTITY, |p| self.rotations[p]);
        translations[self.mover] += above.inv_mul_vec3(shift);
        // Later joints that do not descend from the mover have no role, and their positions are not used below.
        for position in &mut self.positions[self.mover..] {
            *position += shift;
        }
    }

    /// Moves the end of a limb to a target in the file's world; the end keeps its world rotation.
    fn reach(&mut self, world: &WorldPose, limb: Limb, target: Vec3, rotations: &mut [Quat]) {
        let [upper_role, ..] = limb.roles();
        let [upper, middle, end] = limb.roles().map(|r| self.joint(r));
        let pole = self.binding.world_from_file.inv_mul_vec3(world.rotations[upper_role.index()] * limb.pole());
        let bones =
            TwoBones { upper: self.positions[upper], middle: self.positions[middle], end: self.positions[end], pole };
        let reach = bones.reach(target);
        // Joints between two roles rotate rigidly with the role above them.
        let parent = |joint: usize| self.binding.parents[joint];
        let above = parent(upper).map_or(Quat::IDENTITY, |p| self.rotations[p]);
        let above_middle = parent(middle).map_or(Quat::IDENTITY, |p| reach.upper_turn * self.rotations[p]);
        let above_end = parent(end).map_or(Quat::IDENTITY, |p| reach.lower_turn * self.rotations[p]);
        rotations[upper] = above.inv_mul(reach.upper_turn * self.rotations[upper]).normalized();
        rotations[middle] = above_middle.inv_mul(reach.lower_turn * self.rotations[middle]).normalized();
        rotations[end] = above_end.inv_mul(self.rotations[end]).normalized();
    }
}

/// The joints strictly between spine and chest, each with its share of the rotation: by count, as rigs space them evenly.
fn trunk_shares(binding: &Binding) -> Vec<(usize, f32)> {
    let [spine, chest] = [Role::Spine, Role::Chest].map(|r| binding.joint_of_role[r.index()]);
    let (Some(spine), Some(chest)) = (spine, chest) else { return Vec::new() };
    let tree = BodyTree::of(binding.parents.clone(), &binding.joint_of_role);
    let above = std::iter::successors(tree.parents[chest], |&j| tree.parents[j]);
    let between: Vec<usize> = above.take_while(|&j| j != spine).collect();
    let steps = (between.len() + 1) as f32;
    between.iter().enumerate().map(|(i, &joint)| (joint, 1.0 - (i + 1) as f32 / steps)).collect()
}

/// The nearest of the hips and the joints above them that has moving position channels; the root of a skeleton without one.
fn moving_joint(binding: &Binding, source: &Motion) -> usize {
    let hips = binding.joint_of_role[Role::Hips.index()].unwrap_or(0);
    let moves = |&joint: &usize| {
        let offset = source.skeleton.joints()[joint].offset;
        (0..source.frames()).any(|f| source.translations_at(f)[joint] != offset)
    };
    std::iter::successors(Some(hips), |&j| binding.parents[j]).find(moves).unwrap_or(0)
}

/// Retargets a canonical clip to the skeleton of `source`, at the canonical clip's rate.
///
/// Frame i takes joints that the humanoid does not have, such as fingers, from the fractional frame `source_frames[i]` of the
/// source, clamped to it. If there are fewer of them than poses, the last one is used for the rest. A source without frames
/// gives a motion without frames.
///
/// # Panics
/// If the skeleton of `source` is not the one that was bound ([`Binding::fits`]).
pub fn from_humanoid(humanoid: &HumanoidMotion, source: &Motion, binding: &Binding, source_frames: &[f64]) -> Motion {
    let joints = source.skeleton.len();
    let mut motion = Motion {
        skeleton: source.skeleton.clone(),
        frame_time_secs: 1.0 / f64::from(humanoid.rate_hz),
        translations: Vec::new(),
        rotations: Vec::new(),
    };
    let Some(last) = source.frames().checked_sub(1) else { return motion };
    motion.translations = vec![Vec3::ZERO; humanoid.poses.len() * joints];
    motion.rotations = vec![Quat::IDENTITY; humanoid.poses.len() * joints];
    let mut retarget = FromHumanoid::new(binding, &humanoid.proportions, source);
    let frames = motion.translations.chunks_exact_mut(joints).zip(motion.rotations.chunks_exact_mut(joints));
    for ((i, pose), (translations, rotations)) in humanoid.poses.iter().enumerate().zip(frames) {
        let at = source_frames.get(i).or(source_frames.last()).copied().unwrap_or(0.0).clamp(0.0, last as f64);
        sample_locals(source, at, translations, rotations);
        retarget.frame(pose, translations, rotations);
    }
    motion
}

/// Local transforms at a fractional frame of the clip.
fn sample_locals(source: &Motion, frame: f64, translations: &mut [Vec3], rotations: &mut [Quat]) {
    let before = frame.floor() as usize;
    let after = (before + 1).min(source.frames() - 1);
    let t = (frame - before as f64) as f32;
    translations.copy_from_slice(source.translations_at(before));
    rotations.copy_from_slice(source.rotations_at(before));
    if t > 0.0 {
        for (a, b) in translations.iter_mut().zip(source.translations_at(after)) {
            *a += (*b - *a) * t;
        }
        for (a, b) in rotations.iter_mut().zip(source.rotations_at(after)) {
            *a = a.slerp(*b, t);
        }
    }
}
