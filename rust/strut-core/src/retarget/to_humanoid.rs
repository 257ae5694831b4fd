//! Retargeting from a file's skeleton to the canonical humanoid.

use super::Binding;
use super::sample::local;
use super::scale::BodyScale;
use crate::humanoid::{HumanoidMotion, JOINTS, PARENTS, Pose, Proportions, Role};
use crate::math::{Quat, Vec3};
use crate::motion::Motion;

/// Retargets frames of a bound skeleton to a canonical body, one at a time and without allocation.
#[derive(Clone, Debug)]
pub struct ToHumanoid {
    parents: Vec<Option<usize>>,
    joint_of_role: [Option<usize>; JOINTS],
    /// Rotation from a role's T-pose frame (the world's) to its joint's frame: inverse rest rotations.
    joint_from_rest: [Quat; JOINTS],
    world_from_file: Quat,
    is_mirrored: bool,
    /// Position of the file's origin relative to the ground, metres.
    origin: Vec3,
    metres_per_unit: f32,
    target: Proportions,
    scale: BodyScale,
    /// World transforms of the file's joints up to the last one with a role.
    world: Vec<(Vec3, Quat)>,
}

impl ToHumanoid {
    /// Creates the retargeting from the skeleton of `binding` to a body.
    pub fn new(binding: &Binding, target: &Proportions) -> Self {
        let joints = binding.joint_of_role.iter().flatten().max().map_or(0, |last| last + 1);
        Self {
            parents: binding.parents[..joints].to_vec(),
            joint_of_role: binding.joint_of_role,
            joint_from_rest: binding
                .joint_of_role
                .map(|joint| joint.map_or(Quat::IDENTITY, |j| binding.rest_world_rotations[j].inverse())),
            world_from_file: binding.world_from_file,
            is_mirrored: binding.is_mirrored,
            origin: Vec3::new(0.0, -binding.floor_metres, 0.0),
            metres_per_unit: binding.metres_per_unit,
            target: *target,
            scale: BodyScale::between(&binding.proportions, target),
            world: vec![(Vec3::ZERO, Quat::IDENTITY); joints],
        }
    }

    /// Returns the pose of one frame, given the local translations and rotations of all joints of the file.
    ///
    /// # Panics
    /// If there are fewer of them than joints up to the last one with a role.
    pub fn frame(&mut self, translations: &[Vec3], rotations: &[Quat]) -> Pose {
        self.update_world(translations, rotations);
        let file = |role: Role| self.joint_of_role[role.index()].map_or(Vec3::ZERO, |j| self.world[j].0);

        // World rotations relative to the T-pose are the same for every body: G = W · Wᵣ⁻¹.
        let mut turns = [Quat::IDENTITY; JOINTS];
        for role in Role::ALL {
            let i = role.index();
            turns[i] = match (self.joint_of_role[i], role.parent()) {
                (Some(joint), _) => self.world[joint].1 * self.joint_from_rest[i],
                (None, Some(parent)) => turns[parent.index()],
                (None, None) => Quat::IDENTITY,
            };
        }
        let mut pose = Pose { root: Vec3::ZERO, rotations: turns };
        for (i, rotation) in pose.rotations.iter_mut().enumerate().skip(1) {
            *rotation = turns[PARENTS[i]].inv_mul(turns[i]).normalized();
        }
        for toes in [Role::LeftToes, Role::RightToes] {
            let rotation = &mut pose.rotations[toes.index()];
            *rotation = not_upside_down(*rotation);
        }
        pose.rotations[0] = turns[0].normalized();

        self.scale.place(&self.target, &mut pose, file);
        pose
    }

    /// World transforms of the file's joints in our axes, metres.
    fn update_world(&mut self, translations: &[Vec3], rotations: &[Quat]) {
        // Tested here, because a test in the loop would cost a fifth of the time.
        if self.is_mirrored {
            self.compose(|joint| local(translations[joint], rotations[joint], true));
        } else {
            self.compose(|joint| (translations[joint], rotations[joint]));
        }
    }

    fn compose(&mut self, local_of: impl Fn(usize) -> (Vec3, Quat)) {
        for (joint, parent) in self.parents.iter().enumerate() {
            let (position, rotation) = parent.map_or((self.origin, self.world_from_file), |p| self.world[p]);
            let (translation, turn) = local_of(joint);
            self.world[joint] = (position + rotation * (translation * self.metres_per_unit), rotation * turn);
        }
    }
}

/// Removes a half turn of the toes about their length. Recordings converted from ASF/AMC contain toes bent up as turned
/// upside down, and flip between frames.
fn not_upside_down(toes: Quat) -> Quat {
    let (swing, twist) = toes.swing_twist(Vec3::Z);
    if twist.w.abs() < std::f32::consts::FRAC_1_SQRT_2 { swing } else { toes }
}

/// Retargets a clip to a canonical body, at the same rate.
///
/// # Panics
/// If the clip's skeleton is not the one that was bound ([`Binding::fits`]).
pub fn to_humanoid(motion: &Motion, binding: &Binding, proportions: &Proportions) -> HumanoidMotion {
    let mut retarget = ToHumanoid::new(binding, proportions);
    let poses =
        (0..motion.frames()).map(|f| retarget.frame(motion.translations_at(f), motion.rotations_at(f))).collect();
    HumanoidMotion { proportions: *proportions, rate_hz: (1.0 / motion.frame_time_secs) as f32, poses }
}
