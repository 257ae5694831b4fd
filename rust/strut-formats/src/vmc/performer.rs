//! The body of a performer: bones ↔ poses of a canonical humanoid.

use super::bone::{BONES, Bone};
use super::frame::Frame;
use super::place::Place;
use strut_core::humanoid::{JOINTS, Pose, Proportions, Role};
use strut_core::kinematics::{WorldPose, world_from_local};
use strut_core::math::{Quat, Vec3};
use strut_core::pose_vector::heading_of;

/// Height of the lowest joint, the balls of the feet, above the ground, as a share of that of the hips above it.
const SOLE_SHARE: f32 = 0.037;
/// Bones shorter than this in all say nothing about the body, metres.
const LEAST_BODY: f32 = 0.2;
/// Heights of hips that are believed, metres.
const HIP_HEIGHTS: std::ops::RangeInclusive<f32> = 0.2..=3.0;

/// Offsets of one body differ by less than this share of the height of its hips from frame to frame.
const SAME_BODY: f32 = 0.05;

/// A performer's body and the rotations of its bones in the T-pose.
#[derive(Clone, Debug, PartialEq)]
pub struct Performer {
    proportions: Proportions,
    /// Rotation of each bone in the world in the T-pose facing +Z.
    pub(super) rest: [Quat; BONES],
    /// Bones that are sent.
    pub(super) has: [bool; BONES],
}

impl Performer {
    /// The body of the bones that a frame brought: their offsets, or the default humanoid at the height of the hips where there
    /// are none.
    /// Without a calibration all bones are unturned in the T-pose, as those of VRM 0 are.
    pub fn new(frame: &Frame, calibration: Option<&Calibration>) -> Self {
        let rest = calibration.and_then(Calibration::rest).unwrap_or([Quat::IDENTITY; BONES]);
        // A bone that was sent before is another avatar's, or not sent for a while: then the body has it as soon as it is.
        let frame = &with_bones(frame, |i| !frame.held[i]);
        let hips_height = frame.world()[0].position.y;
        let proportions = body(frame, &rest).unwrap_or_else(|| default_body(hips_height));
        Self { proportions, rest, has: frame.bones.map(|bone| bone.is_some()) }
    }

    /// A body whose bones are all sent and unturned in the T-pose.
    pub fn of_body(proportions: &Proportions) -> Self {
        let mut has = [true; BONES];
        has[Bone::UpperChest.index()] = false;
        Self { proportions: *proportions, rest: [Quat::IDENTITY; BONES], has }
    }

    /// Bone offsets.
    pub fn proportions(&self) -> &Proportions {
        &self.proportions
    }

    /// Whether the bones of a frame are those of this body: of another avatar they have other lengths, or there is one that this
    /// body lacks. Bones that are sent without lengths fit every body.
    pub fn has_body_of(&self, frame: &Frame) -> bool {
        if (0..BONES).any(|i| frame.bones[i].is_some() && !frame.held[i] && !self.has[i]) {
            return false;
        }
        let apart = |theirs: Proportions| {
            let pairs = theirs.offsets.iter().zip(&self.proportions.offsets);
            pairs.map(|(a, b)| (*a - *b).length()).fold(0.0, f32::max)
        };
        body(&with_bones(frame, |i| self.has[i]), &self.rest)
            .is_none_or(|theirs| apart(theirs) <= SAME_BODY * self.proportions.offsets[0].y)
    }

    /// Whether a frame says where its body is: hips that are sent as zero do not.
    pub fn has_root(frame: &Frame) -> bool {
        frame.bones[0].is_some_and(|hips| hips.position != Vec3::ZERO)
    }

    /// The pose of a frame on this body.
    pub fn pose(&self, frame: &Frame) -> Pose {
        let world = self.returning(frame).world();
        // Rotations relative to the T-pose: R = G · G₀⁻¹. A later bone of a role (the upper chest) counts.
        let mut turns = [Quat::IDENTITY; JOINTS];
        for bone in Bone::all() {
            if bone != Bone::UpperChest || self.has[bone.index()] {
                turns[bone.role().index()] = world[bone.index()].rotation * self.rest[bone.index()].inverse();
            }
        }
        let mut pose = Pose { root: world[0].position, rotations: turns };
        for role in Role::ALL {
            if let Some(parent) = role.parent() {
                pose.rotations[role.index()] = turns[parent.index()].inv_mul(turns[role.index()]).normalized();
            }
        }
        pose
    }

    /// The frame with the bones of this body, of which those that are not sent any more are on their way to rest.
    fn returning(&self, frame: &Frame) -> Frame {
        let mut frame = with_bones(frame, |i| self.has[i]);
        for bone in Bone::all() {
            let share = frame.rest_shares[bone.index()];
            if let (Some(place), true, Some(parent)) = (&mut frame.bones[bone.index()], share > 0.0, bone.parent()) {
                let rest = self.rest[parent.index()].inv_mul(self.rest[bone.index()]);
                place.rotation = place.rotation.slerp(rest, share).normalized();
            }
        }
        frame
    }

    /// A pose on this body as a frame of the bones that are sent, where the model stands as in `like`. Positions of bones
    /// other than the hips are those of `like`, or else the body's.
    pub fn frame(&self, pose: &Pose, like: &Frame) -> Frame {
        let turns = world_from_local(&self.proportions, pose).rotations;
        let mut frame = *like;
        let mut world = [Quat::IDENTITY; BONES];
        for bone in Bone::all() {
            let i = bone.index();
            let parent = bone.parent().map_or(like.root.place.rotation, |parent| world[parent.index()]);
            // One that is not sent is turned as what it hangs on.
            world[i] = if self.has[i] { turns[bone.role().index()] * self.rest[i] } else { parent };
            let position = match bone {
                Bone::Of(Role::Hips) => {
                    like.root.place.relative(&Place { position: pose.root, ..Place::default() }).position
                }
                _ => like.bones[i].map_or(self.proportions.offsets[bone.role().index()], |place| place.position),
            };
            let rotation = parent.inv_mul(world[i]).normalized();
            frame.bones[i] = self.has[i].then_some(Place { position, rotation });
        }
        frame
    }
}

/// The frame with those of its bones alone whose number is one of `these`.
fn with_bones(frame: &Frame, these: impl Fn(usize) -> bool) -> Frame {
    let bones = std::array::from_fn(|i| frame.bones[i].filter(|_| these(i)));
    Frame { bones, ..*frame }
}

/// The body that a frame's bones have, given their rotations in the T-pose; `None` if they have no lengths, or no
/// plausible ones.
fn body(frame: &Frame, rest: &[Quat; BONES]) -> Option<Proportions> {
    let mut positions = [Vec3::ZERO; BONES];
    let mut length = 0.0;
    for bone in Bone::all().skip(1) {
        let parent = bone.parent().map_or(0, Bone::index);
        let offset = frame.bones[bone.index()].map_or(Vec3::ZERO, |place| place.position);
        length += offset.length();
        positions[bone.index()] = positions[parent] + rest[parent] * offset;
    }
    if length < LEAST_BODY {
        return None;
    }
    // The chest is the upper one where that is sent; where not, both are at the same place.
    let upper_chest = positions[Bone::UpperChest.index()];
    positions[Role::Chest.index()] = upper_chest;
    let mut offsets: [Vec3; JOINTS] = std::array::from_fn(|i| positions[i]);
    for role in Role::ALL {
        if let Some(parent) = role.parent() {
            offsets[role.index()] = positions[role.index()] - positions[parent.index()];
        }
    }
    let lowest = positions.iter().map(|p| p.y).fold(0.0, f32::min);
    offsets[0] = Vec3::new(0.0, -lowest * (1.0 + SOLE_SHARE), 0.0);
    let body = Proportions { offsets };
    (body.is_valid() && HIP_HEIGHTS.contains(&offsets[0].y)).then_some(body)
}

fn default_body(hips_height: f32) -> Proportions {
    let mut body = Proportions::default();
    if HIP_HEIGHTS.contains(&hips_height) {
        let scale = hips_height / body.offsets[0].y;
        body.offsets.iter_mut().for_each(|offset| *offset *= scale);
    }
    body
}

/// Averages a T-pose that the performer holds: the rotations G₀ that bones have in it, however the sender turns them.
#[derive(Clone, Debug, Default)]
pub struct Calibration {
    /// Sums of the bones' rotations in the world.
    sums: Option<[Quat; BONES]>,
    /// The last frame: where the joints are says which way the performer faces.
    last: Frame,
}

impl Calibration {
    /// Takes a frame of the T-pose.
    pub fn push(&mut self, frame: &Frame) {
        let world = frame.world().map(|place| place.rotation);
        self.sums = Some(match self.sums {
            None => world,
            Some(sums) => std::array::from_fn(|i| {
                let (sum, q) = (sums[i], world[i].nearest_to(sums[i]));
                Quat::from_xyzw(sum.x + q.x, sum.y + q.y, sum.z + q.z, sum.w + q.w)
            }),
        });
        self.last = *frame;
    }

    /// The rotations of the bones in the T-pose facing +Z; `None` without frames.
    fn rest(&self) -> Option<[Quat; BONES]> {
        let mean = self.sums?.map(Quat::normalized);
        let world = self.last.world();
        let joints =
            WorldPose { positions: std::array::from_fn(|i| world[i].position), rotations: [Quat::IDENTITY; JOINTS] };
        // Joints that are all in one place face no way: then it is +Z.
        let facing = Quat::from_rotation_y(heading_of(&joints).unwrap_or(0.0));
        Some(mean.map(|q| facing.inv_mul(q)))
    }
}
