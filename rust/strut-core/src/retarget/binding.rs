//! Mapping of a file's skeleton to the canonical humanoid.

use super::anatomy::{FourLegs, four_legs};
use super::axes::{UpAxis, up_axis};
use super::body_tree::BodyTree;
use super::find_roles::find_roles;
use super::read_as::ReadAs;
use super::rest_pose::{RestPose, positions, rest_pose};
use super::sample::Sample;
use crate::humanoid::{JOINTS, PARENTS, Proportions, Role};
use crate::math::{Quat, Vec3};
use crate::motion::Motion;
use crate::note::{Note, NoteCode};
use crate::skeleton::Skeleton;
use thiserror::Error;

/// Roles that a skeleton must have; the others are optional.
const REQUIRED: [Role; 14] = [
    Role::LeftUpperLeg,
    Role::LeftLowerLeg,
    Role::LeftFoot,
    Role::RightUpperLeg,
    Role::RightLowerLeg,
    Role::RightFoot,
    Role::LeftUpperArm,
    Role::LeftLowerArm,
    Role::LeftHand,
    Role::RightUpperArm,
    Role::RightLowerArm,
    Role::RightHand,
    Role::Hips,
    Role::Spine,
];

/// Usual length units: metres, and their names in notes.
const UNITS: [(f32, &str); 5] =
    [(1.0, "metres"), (0.01, "centimetres"), (0.0254, "inches"), (0.001, "millimetres"), (0.1, "decimetres")];
/// Plausible leg lengths, hip joint to ankle, from children to basketball players: metres. The unit that puts the leg in this
/// range is chosen; at most one of the usual units does.
const LEG_RANGE: std::ops::RangeInclusive<f32> = 0.6..=1.1;
/// Leg length assumed for skeletons in an unknown unit, metres.
const USUAL_LEG: f32 = 0.85;

/// Ankle height above the sole per drop from ankle to toe joint. Measured standing: Bandai Namco 1.57,
/// Xia and CMU 1.5.
const ANKLE_HEIGHT_PER_DROP: f32 = 1.55;
/// The same for skeletons without toes or with level feet: share of the leg, the mannequin's.
const ANKLE_HEIGHT_PER_LEG: f32 = 0.147;

/// Known facts of a rigged character.
#[derive(Clone, Debug, PartialEq)]
pub struct CharacterFacts {
    /// Metres per unit of the skeleton's offsets; finite and above 0.
    pub metres_per_unit: f32,
    /// Height of the soles in the zero pose along the body's up axis, in the unit of the offsets and from their origin.
    /// `None` without a mesh to measure: it is then guessed from the ankles.
    pub sole_height: Option<f32>,
    /// Joints of the known roles, as from a VRM or a user's choice.
    pub roles: [Option<usize>; JOINTS],
}

/// The joint of each role, the rotations of the joints in the T-pose, and the size of the body.
///
/// The same skeleton gives the same binding for every clip, unless neither its zero pose nor its local axes resemble a body.
#[derive(Clone, Debug, PartialEq)]
pub struct Binding {
    /// Joint of each role; `None` for roles that the skeleton lacks (toes, shoulders, chest, neck, head).
    pub joint_of_role: [Option<usize>; JOINTS],
    /// Confidence in the roles: 1 if every role was found by name, about 0.6 if by the shape of the tree alone.
    pub confidence: f32,
    /// World rotation of each file joint in the T-pose facing +Z, +Y up.
    pub rest_world_rotations: Vec<Quat>,
    /// The file's up axis.
    pub up: UpAxis,
    /// Rotation from the file's world to ours: the identity for files with +Y up.
    pub world_from_file: Quat,
    /// Whether the file is a mirror image, as left-handed programs write it: it is read, and written back, mirrored at the
    /// plane x = 0.
    pub is_mirrored: bool,
    /// Height of the ground in the file along its up axis, metres; 0 for a character.
    pub floor_metres: f32,
    /// Metres per unit of length of the file.
    pub metres_per_unit: f32,
    /// The body as canonical humanoid, metres. A role without a joint is placed between its neighbours.
    pub proportions: Proportions,
    /// Joints without a role, ascending; they keep their own motion.
    pub unmapped: Vec<usize>,
    /// Notes for users on matches and assumptions.
    pub notes: Vec<String>,
    /// Possible problems; empty for a clean clip.
    pub doubts: Vec<Note>,
    /// Parent of each file joint.
    pub(super) parents: Vec<Option<usize>>,
}

/// Error of a skeleton that cannot be bound.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum BindError {
    /// A clip without frames.
    #[error("This motion has no frames. Export the clip again.")]
    NoFrames,
    /// The skeleton does not resemble a body.
    #[error("No legs and arms were found in this skeleton. Use a file of a humanoid.")]
    NotHumanoid,
    /// A required role has no joint.
    #[error("No {} was found in this skeleton. Choose the joint, or use another file.", joint_word(*.0))]
    Missing(Role),
    /// Several required roles of a character have no joint.
    #[error("No {} was found in this skeleton. Choose the joints, or use another file.", joint_words(.0))]
    MissingRoles(Vec<Role>),
    /// A chosen joint is not in the skeleton, or is not a descendant of the joint of the role above.
    #[error("{} cannot be the {}: it is not connected to the rest of the body.", joint_named(.joint), joint_word(*.role))]
    Misplaced {
        /// The role.
        role: Role,
        /// The joint's name, or its index if there is no such joint.
        joint: String,
    },
    /// The skeleton has no joint of a chosen name.
    #[error("This skeleton has no joint '{joint}', which was chosen as the {}.", joint_word(*.role))]
    UnknownJoint {
        /// The role.
        role: Role,
        /// The name.
        joint: String,
    },
    /// A body that is not human.
    #[error(
        "This body stands on four legs: its hands are on the ground like its feet, and its arms are {:.2} and its trunk {:.2} \
         times as long as its legs. Strut animates humans. To use this body as a human, choose its joints.",
        .0.arms_per_leg, .0.trunk_per_leg
    )]
    NotHuman(FourLegs),
    /// A limb bone has length 0.
    #[error("The {} is at the same position as its parent joint. Choose another joint, or use another file.", joint_word(*.0))]
    NoLength(Role),
    /// A character's size is outside the range of bodies.
    #[error("This body is far too small or too large. Set the length of one unit in metres.")]
    Size,
}

/// Common name of the joint of a role, for messages.
fn joint_word(role: Role) -> &'static str {
    match role {
        Role::Hips => "hips",
        Role::Spine => "spine",
        Role::Chest => "chest",
        Role::Neck => "neck",
        Role::Head => "head",
        Role::LeftShoulder => "left collarbone",
        Role::LeftUpperArm => "left shoulder",
        Role::LeftLowerArm => "left elbow",
        Role::LeftHand => "left wrist",
        Role::RightShoulder => "right collarbone",
        Role::RightUpperArm => "right shoulder",
        Role::RightLowerArm => "right elbow",
        Role::RightHand => "right wrist",
        Role::LeftUpperLeg => "left hip",
        Role::LeftLowerLeg => "left knee",
        Role::LeftFoot => "left ankle",
        Role::LeftToes => "left toes",
        Role::RightUpperLeg => "right hip",
        Role::RightLowerLeg => "right knee",
        Role::RightFoot => "right ankle",
        Role::RightToes => "right toes",
    }
}

/// Joint names in a list: `left ankle or right ankle`; of more than four the first three.
fn joint_words(roles: &[Role]) -> String {
    let words: Vec<&str> = roles.iter().map(|role| joint_word(*role)).collect();
    match words.as_slice() {
        [] => "joint".to_owned(),
        [only] => (*only).to_owned(),
        [a, b, c, rest @ ..] if rest.len() > 1 => format!("{a}, {b}, {c} and {} other joints", rest.len()),
        [before @ .., last] => format!("{} or {last}", before.join(", ")),
    }
}

/// Formats a joint, which may have no name, for the beginning of a sentence.
fn joint_named(name: &str) -> String {
    if name.is_empty() { "A joint without a name".to_owned() } else { format!("Joint '{name}'") }
}

impl Binding {
    /// Binds a rigged character, of which more is known than of a clip. The zero pose of `skeleton` is the pose in which the
    /// character was modelled, and its offsets are differences of positions there, so its joints' frames are aligned with the
    /// world.
    ///
    /// If all required roles are given, no others are searched, and the confidence is 1. A detected role that conflicts with
    /// given ones is omitted.
    ///
    /// # Errors
    /// See [`BindError`].
    pub fn of_character(skeleton: &Skeleton, facts: &CharacterFacts) -> Result<Self, BindError> {
        let sample = Sample::of(&zero_pose_of(skeleton));
        let of = |roles: &[Option<usize>; JOINTS], confidence| {
            let binding = Self::of(skeleton, &sample, roles, confidence, Some(facts), &ReadAs::default())?;
            let chosen = facts.roles.iter().any(Option::is_some);
            match four_legs(skeleton, roles, &sample, &binding.proportions) {
                Some(four_legs) if !chosen => Err(BindError::NotHuman(four_legs)),
                _ => Ok(binding),
            }
        };
        if REQUIRED.iter().all(|role| facts.roles[role.index()].is_some()) {
            return of(&facts.roles, 1.0);
        }
        let found = find_roles(skeleton, &sample);
        let mut roles = found.joint_of_role;
        let is_given = facts.roles.iter().any(Option::is_some);
        for (role, given) in roles.iter_mut().zip(facts.roles) {
            *role = given.or(role.filter(|joint| !facts.roles.contains(&Some(*joint))));
        }
        if is_given {
            leave_out_misplaced(skeleton, &mut roles, facts);
        }
        if roles.iter().all(Option::is_none) {
            return Err(BindError::NotHumanoid);
        }
        let missing = missing_roles(&roles);
        if missing.len() > 1 {
            return Err(BindError::MissingRoles(missing));
        }
        leave_out_toes_without_length(&sample, &mut roles);
        of(&roles, found.confidence)
    }

    /// Returns the joints of a character's roles as far as they are known or can be detected: a proposal for the user when
    /// [`Binding::of_character`] fails.
    pub fn likely_roles_of_character(skeleton: &Skeleton, known: &[Option<usize>; JOINTS]) -> [Option<usize>; JOINTS] {
        let mut roles = find_roles(skeleton, &Sample::of(&zero_pose_of(skeleton))).joint_of_role;
        for (role, given) in roles.iter_mut().zip(known) {
            *role = given.or(role.filter(|joint| !known.contains(&Some(*joint))));
        }
        roles
    }

    /// Whether a skeleton has the bound hierarchy, so that its motions may use this binding.
    pub fn fits(&self, skeleton: &Skeleton) -> bool {
        skeleton.joints().iter().map(|j| j.parent).eq(self.parents.iter().copied())
    }

    /// Binds a skeleton whose roles are known, without its floor.
    pub(super) fn of(
        skeleton: &Skeleton,
        sample: &Sample,
        joint_of_role: &[Option<usize>; JOINTS],
        confidence: f32,
        facts: Option<&CharacterFacts>,
        read_as: &ReadAs,
    ) -> Result<Self, BindError> {
        check_roles(skeleton, joint_of_role)?;
        let rest = rest_pose(skeleton, joint_of_role, sample);
        let at_rest = positions(skeleton, &sample.translations, &rest.world_rotations);
        let begins = BodyTree::of_skeleton(skeleton, joint_of_role).begins;
        let at_rest: Vec<Vec3> = begins.iter().map(|&joint| at_rest[joint]).collect();
        let mut proportions = offsets_between(&role_positions(joint_of_role, &at_rest));
        let leg = leg_length(&proportions);
        for role in REQUIRED.into_iter().filter(|r| *r != Role::Hips && *r != Role::Spine) {
            let upper =
                matches!(role, Role::LeftUpperLeg | Role::RightUpperLeg | Role::LeftUpperArm | Role::RightUpperArm);
            if !upper && proportions.offsets[role.index()].length() <= 1e-3 * leg {
                return Err(BindError::NoLength(role));
            }
        }
        if !leg.is_finite() {
            return Err(BindError::NotHumanoid);
        }
        let known_unit = facts.map(|facts| facts.metres_per_unit).or(read_as.metres_per_unit);
        let unit = match known_unit {
            Some(known) => UNITS.iter().find(|(unit, _)| *unit == known),
            None => UNITS.iter().find(|(unit, _)| LEG_RANGE.contains(&(leg * unit))),
        };
        let metres_per_unit = known_unit.unwrap_or_else(|| unit.map_or(USUAL_LEG / leg, |(unit, _)| *unit));
        for offset in &mut proportions.offsets {
            *offset *= metres_per_unit;
        }
        let ankle = facts.and_then(|f| ankle_over_sole(f, skeleton, sample, joint_of_role, &rest));
        let ankle = ankle.unwrap_or_else(|| usual_ankle_height(joint_of_role, &proportions));
        proportions.offsets[0] = Vec3::new(0.0, leg_drop(&proportions) + ankle, 0.0);
        if known_unit.is_some() && !proportions.is_valid() {
            return Err(BindError::Size);
        }
        let unmapped: Vec<usize> = (0..skeleton.len()).filter(|j| !joint_of_role.contains(&Some(*j))).collect();
        let found = up_axis(joint_of_role, sample, &rest);
        let up = read_as.up.unwrap_or(found.axis);
        let mut doubts = Vec::new();
        if let (Some(axis), None) = (found.doubt, read_as.up) {
            doubts.push(Note::new(
                NoteCode::UpUnsure,
                format!(
                    "Either the body lies along {axis}, or {axis} is the up axis of this file. {up} was used as up."
                ),
            ));
        } else if up != UpAxis::Y && facts.is_none() {
            doubts.push(Note::new(NoteCode::Up, format!("The up axis of this file is {up}.")));
        }
        let notes = notes(skeleton, &unmapped, &rest, unit.map(|(_, word)| *word), metres_per_unit, up);
        Ok(Self {
            joint_of_role: *joint_of_role,
            confidence,
            rest_world_rotations: rest.world_rotations,
            up,
            world_from_file: up.to_y(),
            is_mirrored: false,
            floor_metres: 0.0,
            metres_per_unit,
            proportions,
            unmapped,
            notes,
            doubts,
            parents: skeleton.joints().iter().map(|j| j.parent).collect(),
        })
    }
}

/// A character's zero pose as a clip of one frame.
pub(super) fn zero_pose_of(skeleton: &Skeleton) -> Motion {
    Motion {
        skeleton: skeleton.clone(),
        frame_time_secs: 1.0,
        translations: skeleton.joints().iter().map(|j| j.offset).collect(),
        rotations: vec![Quat::IDENTITY; skeleton.len()],
    }
}

/// The required roles without a joint. Hips and spine are derived from the limbs, so they are listed only if no limb is
/// missing.
fn missing_roles(roles: &[Option<usize>; JOINTS]) -> Vec<Role> {
    let missing = |role: &Role| roles[role.index()].is_none();
    let limbs: Vec<Role> =
        REQUIRED.into_iter().filter(|role| !matches!(role, Role::Hips | Role::Spine)).filter(missing).collect();
    if limbs.is_empty() { REQUIRED.into_iter().filter(missing).collect() } else { limbs }
}

/// Checks that every required role has a joint, and that every joint descends from that of the nearest role above.
pub(super) fn check_roles(skeleton: &Skeleton, roles: &[Option<usize>; JOINTS]) -> Result<(), BindError> {
    if let Some(&role) = REQUIRED.iter().find(|r| roles[r.index()].is_none()) {
        return Err(BindError::Missing(role));
    }
    match misplaced(skeleton, roles).first() {
        Some(&(role, joint)) => {
            let name = skeleton.joints().get(joint).map_or_else(|| joint.to_string(), |found| found.name.clone());
            Err(BindError::Misplaced { role, joint: name })
        }
        None => Ok(()),
    }
}

/// The roles whose joint does not exist or does not descend from that of the nearest role above, with the joint.
fn misplaced(skeleton: &Skeleton, roles: &[Option<usize>; JOINTS]) -> Vec<(Role, usize)> {
    let tree = BodyTree::of_skeleton(skeleton, roles);
    let parent = |j: usize| tree.parents.get(j).copied().flatten();
    let hangs = |role: Role, joint: usize| {
        let above = std::iter::successors(role.parent(), |r| r.parent()).find_map(|r| roles[r.index()]);
        above.is_none_or(|a| std::iter::successors(parent(joint), |&p| parent(p)).any(|p| p == a))
    };
    let joints = Role::ALL.into_iter().filter_map(|role| roles[role.index()].map(|joint| (role, joint)));
    joints.filter(|&(role, joint)| joint >= skeleton.len() || !hangs(role, joint)).collect()
}

/// Removes toes at the place of the ankle, which are no evidence of the foot's direction.
pub(super) fn leave_out_toes_without_length(sample: &Sample, roles: &mut [Option<usize>; JOINTS]) {
    let at = |roles: &[Option<usize>; JOINTS], role: Role| roles[role.index()];
    for [knee, foot, toes] in
        [[Role::LeftLowerLeg, Role::LeftFoot, Role::LeftToes], [Role::RightLowerLeg, Role::RightFoot, Role::RightToes]]
    {
        let (Some(knee), Some(foot), Some(toe)) = (at(roles, knee), at(roles, foot), at(roles, toes)) else { continue };
        if sample.mean_local(foot, toe).length() <= 1e-3 * sample.mean_local(knee, foot).length() {
            roles[toes.index()] = None;
        }
    }
}

/// Moves a hand at the place of the elbow to the first joint below it that is elsewhere.
pub(super) fn move_hands_without_length(skeleton: &Skeleton, sample: &Sample, roles: &mut [Option<usize>; JOINTS]) {
    let at = |roles: &[Option<usize>; JOINTS], role: Role| roles[role.index()];
    for [upper, lower, hand] in [
        [Role::LeftUpperArm, Role::LeftLowerArm, Role::LeftHand],
        [Role::RightUpperArm, Role::RightLowerArm, Role::RightHand],
    ] {
        let (Some(upper), Some(lower), Some(wrist)) = (at(roles, upper), at(roles, lower), at(roles, hand)) else {
            continue;
        };
        let least = 1e-3 * sample.mean_local(upper, lower).length();
        let is_elsewhere = |joint: usize| sample.mean_local(lower, joint).length() > least;
        let parent = |joint: usize| skeleton.joints()[joint].parent;
        let hangs_on_wrist = |joint: usize| std::iter::successors(parent(joint), |&j| parent(j)).any(|j| j == wrist);
        if !is_elsewhere(wrist)
            && let Some(below) = (wrist + 1..skeleton.len()).find(|&j| hangs_on_wrist(j) && is_elsewhere(j))
        {
            roles[hand.index()] = Some(below);
        }
    }
}

/// Positions of all roles in the T-pose, file units; a role without a joint is placed between its neighbours.
fn role_positions(roles: &[Option<usize>; JOINTS], at_rest: &[Vec3]) -> [Vec3; JOINTS] {
    let known = |r: Role| roles[r.index()].map(|j| at_rest[j]);
    let mut out = [Vec3::ZERO; JOINTS];
    for role in Role::ALL {
        let parent = role.parent().map_or(Vec3::ZERO, |p| out[p.index()]);
        let toward = |end: Option<Vec3>, share: f32| end.map_or(parent, |e| parent + (e - parent) * share);
        let foot = |leg: [Role; 3]| {
            // The mannequin's foot, scaled to the leg.
            let [hip, knee, ankle] = leg.map(|r| out[r.index()]);
            parent + Vec3::new(0.0, -0.105, 0.16) * ((knee - hip).length() + (ankle - knee).length())
        };
        out[role.index()] = known(role).unwrap_or_else(|| match role {
            Role::Neck => toward(known(Role::Head), 0.7),
            Role::LeftShoulder => toward(known(Role::LeftUpperArm), 0.2),
            Role::RightShoulder => toward(known(Role::RightUpperArm), 0.2),
            Role::LeftToes => foot([Role::LeftUpperLeg, Role::LeftLowerLeg, Role::LeftFoot]),
            Role::RightToes => foot([Role::RightUpperLeg, Role::RightLowerLeg, Role::RightFoot]),
            _ => parent,
        });
    }
    out
}

/// In the T-pose all frames are aligned with the world, so offsets are differences of positions.
fn offsets_between(positions: &[Vec3; JOINTS]) -> Proportions {
    let mut offsets = [Vec3::ZERO; JOINTS];
    for j in 1..JOINTS {
        offsets[j] = positions[j] - positions[PARENTS[j]];
    }
    Proportions { offsets }
}

/// Mean length of both legs, hip joint to ankle.
fn leg_length(p: &Proportions) -> f32 {
    let length = |r: Role| p.offsets[r.index()].length();
    let left = length(Role::LeftLowerLeg) + length(Role::LeftFoot);
    0.5 * (left + length(Role::RightLowerLeg) + length(Role::RightFoot))
}

/// Height of the hips above the ankles in the T-pose, in the unit of the offsets.
fn leg_drop(p: &Proportions) -> f32 {
    let y = |r: Role| -p.offsets[r.index()].y;
    let legs = [Role::LeftUpperLeg, Role::LeftLowerLeg, Role::LeftFoot].map(|r| 0.5 * (y(r) + y(r.mirrored())));
    legs.iter().sum()
}

/// Height of the ankles above the soles of a body without known soles, in the unit of the offsets.
fn usual_ankle_height(roles: &[Option<usize>; JOINTS], p: &Proportions) -> f32 {
    let y = |r: Role| -p.offsets[r.index()].y;
    let side = |r: Role| if roles[r.index()].is_some() { y(r) } else { 0.0 };
    let drop = 0.5 * (side(Role::LeftToes) + side(Role::RightToes));
    let leg = leg_length(p);
    let from_toes = ANKLE_HEIGHT_PER_DROP * drop;
    if from_toes > 0.03 * leg { from_toes } else { ANKLE_HEIGHT_PER_LEG * leg }
}

/// Mean height of the ankles above given soles, metres: feet keep the slope of the zero pose, and so their height. `None`
/// without given soles, or if the zero pose is not upright.
fn ankle_over_sole(
    facts: &CharacterFacts,
    skeleton: &Skeleton,
    sample: &Sample,
    roles: &[Option<usize>; JOINTS],
    rest: &RestPose,
) -> Option<f32> {
    let (sole, up) = (facts.sole_height?, rest.zero_up?);
    let zero = positions(skeleton, &sample.translations, &vec![Quat::IDENTITY; skeleton.len()]);
    let height = |role: Role| roles[role.index()].map(|joint| up.dot(zero[joint] + sample.translations[0]));
    let ankles = 0.5 * (height(Role::LeftFoot)? + height(Role::RightFoot)?);
    Some((ankles - sole) * facts.metres_per_unit)
}

/// Removes detected roles that conflict with the hierarchy: repeatedly the one whose removal leaves the fewest misplaced
/// roles, as long as their number falls.
fn leave_out_misplaced(skeleton: &Skeleton, roles: &mut [Option<usize>; JOINTS], facts: &CharacterFacts) {
    let is_optional = |role: &Role| facts.roles[role.index()].is_none() && !REQUIRED.contains(role);
    let mut left = misplaced(skeleton, roles).len();
    while left > 0 {
        let without = Role::ALL.into_iter().filter(is_optional).map(|role| {
            let mut fewer = *roles;
            fewer[role.index()] = None;
            (misplaced(skeleton, &fewer).len(), fewer)
        });
        match without.min_by_key(|(count, _)| *count) {
            Some((count, fewer)) if count < left => (left, *roles) = (count, fewer),
            _ => return,
        }
    }
}

/// Formats a length for users: one decimal, or as many as show its first significant digit.
fn significant(length: f32) -> String {
    let (mut digits, mut shown) = (1, 10.0 * length);
    while shown < 1.0 && digits < 9 {
        (digits, shown) = (digits + 1, 10.0 * shown);
    }
    format!("{length:.digits$}")
}

fn notes(
    skeleton: &Skeleton,
    unmapped: &[usize],
    rest: &RestPose,
    unit: Option<&str>,
    metres_per_unit: f32,
    up: UpAxis,
) -> Vec<String> {
    let mut notes = Vec::new();
    let all = skeleton.len();
    let matched = all - unmapped.len();
    notes.push(match unmapped {
        [] => format!("Matched all {all} joints."),
        [one] => {
            let name = skeleton.joints()[*one].name.as_str();
            let one = if name.is_empty() { "One without a name" } else { name };
            format!("Matched {matched} of {all} joints. {one} stays as it was.")
        }
        many => format!("Matched {matched} of {all} joints. The other {} stay as they were.", many.len()),
    });
    notes.push(match unit {
        Some(word) => format!("Lengths are in {word}."),
        None => format!("One unit of length was read as {} cm.", significant(100.0 * metres_per_unit)),
    });
    if !rest.from_zero_pose {
        notes.push("The zero pose is not a T-pose; the rest pose was computed from the motion.".to_owned());
    }
    if up != UpAxis::Y {
        notes.push(format!("The up axis of this file is {up}."));
    }
    notes
}
