//! Body of a sender: conversion between bones and poses of a canonical humanoid.

use super::bone::{BONES, Bone};
use super::frame::Frame;
use super::place::Place;
use strut_core::humanoid::{JOINTS, Pose, Proportions, Role};
use strut_core::kinematics::{WorldPose, world_from_local};
use strut_core::math::{Quat, Vec3};
use strut_core::pose_vector::heading_of;

/// Height of the lowest joint, the ball of the foot, above the ground, as a share of the hips' height above it.
const SOLE_SHARE: f32 = 0.037;
/// If the bones' total length is less than this, they are no measure of the body, metres.
const LEAST_BODY: f32 = 0.2;
/// Plausible heights of the hips, metres.
const HIP_HEIGHTS: std::ops::RangeInclusive<f32> = 0.2..=3.0;

/// Two frames have the same body if offsets differ by less than this share of the height of the hips.
const SAME_BODY: f32 = 0.05;

/// Body of a sender, and the rotations of its bones in the T-pose.
#[derive(Clone, Debug, PartialEq)]
pub struct Performer {
    proportions: Proportions,
    /// World rotation of each bone in the T-pose facing +Z.
    pub(super) rest: [Quat; BONES],
    /// Bones that are sent.
    pub(super) has: [bool; BONES],
}

impl Performer {
    /// Body from the bones of a frame: their offsets, or the default humanoid at the height of the hips if there are
    /// none. Without a calibration all bones have the identity rotation in the T-pose, as in VRM 0.
    pub fn new(frame: &Frame, calibration: Option<&Calibration>) -> Self {
        let rest = calibration.and_then(Calibration::rest).unwrap_or([Quat::IDENTITY; BONES]);
        // A bone that was sent before belongs to another avatar, or is missing for a while; it is added when it is sent
        // again.
        let frame = &with_bones(frame, |i| !frame.held[i]);
        let hips_height = frame.world()[0].position.y;
        let proportions = body(frame, &rest).unwrap_or_else(|| default_body(hips_height));
        Self { proportions, rest, has: frame.bones.map(|bone| bone.is_some()) }
    }

    /// Body of which all bones are sent, with the identity rotation in the T-pose.
    pub fn of_body(proportions: &Proportions) -> Self {
        let mut has = [true; BONES];
        has[Bone::UpperChest.index()] = false;
        Self { proportions: *proportions, rest: [Quat::IDENTITY; BONES], has }
    }

    /// Bone offsets.
    pub fn proportions(&self) -> &Proportions {
        &self.proportions
    }

    /// Returns whether the bones of a frame belong to this body. The bones of another avatar have other lengths, or
    /// include one that this body lacks. Bones without lengths match every body.
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

    /// Returns whether a frame contains the position of its body: hips at zero do not count.
    pub fn has_root(frame: &Frame) -> bool {
        frame.bones[0].is_some_and(|hips| hips.position != Vec3::ZERO)
    }

    /// Pose of a frame on this body.
    pub fn pose(&self, frame: &Frame) -> Pose {
        let world = self.returning(frame).world();
        // Rotations relative to the T-pose: R = G · G₀⁻¹. The later bone of a role (the upper chest) is used.
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

    /// The frame with the bones of this body. Bones that are no longer sent are interpolated towards rest.
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

    /// A pose on this body as a frame of the bones that are sent, with the model's position in `like`. Positions of
    /// bones other than the hips are those of `like`, or else the body's.
    pub fn frame(&self, pose: &Pose, like: &Frame) -> Frame {
        let turns = world_from_local(&self.proportions, pose).rotations;
        let mut frame = *like;
        let mut world = [Quat::IDENTITY; BONES];
        for bone in Bone::all() {
            let i = bone.index();
            let parent = bone.parent().map_or(like.root.place.rotation, |parent| world[parent.index()]);
            // A bone that is not sent has its parent's rotation.
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

/// The frame with only the bones whose index `these` selects.
fn with_bones(frame: &Frame, these: impl Fn(usize) -> bool) -> Frame {
    let bones = std::array::from_fn(|i| frame.bones[i].filter(|_| these(i)));
    Frame { bones, ..*frame }
}

/// Body of a frame's bones, given their rotations in the T-pose; `None` if they have no lengths or implausible ones.
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
    // The chest is the upper chest if that is sent; otherwise both are at the same position.
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

/// Averages a T-pose that the performer holds: the rotations G₀ of the bones in it, whatever rest rotations the sender
/// uses.
#[derive(Clone, Debug, Default)]
pub struct Calibration {
    /// Sums of the bones' world rotations.
    sums: Option<[Quat; BONES]>,
    /// Last frame: its joint positions determine which direction the performer faces.
    last: Frame,
}

impl Calibration {
    /// Adds a frame of the T-pose.
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

    /// Rotations of the bones in the T-pose facing +Z; `None` without frames.
    fn rest(&self) -> Option<[Quat; BONES]> {
        let mean = self.sums?.map(Quat::normalized);
        let world = self.last.world();
        let joints =
            WorldPose { positions: std::array::from_fn(|i| world[i].position), rotations: [Quat::IDENTITY; JOINTS] };
        // Joints that are all at one position have no facing direction; +Z is then used.
        let facing = Quat::from_rotation_y(heading_of(&joints).unwrap_or(0.0));
        Some(mean.map(|q| facing.inv_mul(q)))
    }
}
