//! The canonical humanoid that every database, search and transfer works on.
//!
//! 21 joints with fixed roles. In its rest pose, a T-pose facing +Z, every joint's frame is aligned with the world, so
//! rotations have the same meaning on every skeleton; only bone offsets differ ([`Proportions`]). `retarget` converts between
//! files' skeletons and this one.

use crate::math::{Quat, Vec3};
use thiserror::Error;

/// Number of joints of the canonical humanoid.
pub const JOINTS: usize = 21;

/// Role of a joint. The discriminant is the joint's index in every canonical array; parents come first. Left is +X when
/// facing +Z.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(u8)]
#[allow(missing_docs)]
pub enum Role {
    Hips,
    Spine,
    Chest,
    Neck,
    Head,
    LeftShoulder,
    LeftUpperArm,
    LeftLowerArm,
    LeftHand,
    RightShoulder,
    RightUpperArm,
    RightLowerArm,
    RightHand,
    LeftUpperLeg,
    LeftLowerLeg,
    LeftFoot,
    LeftToes,
    RightUpperLeg,
    RightLowerLeg,
    RightFoot,
    RightToes,
}

use Role as R;

impl Role {
    /// All roles in canonical order.
    pub const ALL: [Role; JOINTS] = [
        R::Hips,
        R::Spine,
        R::Chest,
        R::Neck,
        R::Head,
        R::LeftShoulder,
        R::LeftUpperArm,
        R::LeftLowerArm,
        R::LeftHand,
        R::RightShoulder,
        R::RightUpperArm,
        R::RightLowerArm,
        R::RightHand,
        R::LeftUpperLeg,
        R::LeftLowerLeg,
        R::LeftFoot,
        R::LeftToes,
        R::RightUpperLeg,
        R::RightLowerLeg,
        R::RightFoot,
        R::RightToes,
    ];

    /// Index in canonical arrays.
    pub const fn index(self) -> usize {
        self as usize
    }

    /// The role's parent in the canonical humanoid; `None` for the hips.
    pub const fn parent(self) -> Option<Role> {
        match PARENTS[self as usize] {
            NO_PARENT => None,
            p => Some(Role::ALL[p]),
        }
    }

    /// Name in files and messages: the VRM humanoid bone names, in `snake_case`.
    pub const fn name(self) -> &'static str {
        match self {
            R::Hips => "hips",
            R::Spine => "spine",
            R::Chest => "chest",
            R::Neck => "neck",
            R::Head => "head",
            R::LeftShoulder => "left_shoulder",
            R::LeftUpperArm => "left_upper_arm",
            R::LeftLowerArm => "left_lower_arm",
            R::LeftHand => "left_hand",
            R::RightShoulder => "right_shoulder",
            R::RightUpperArm => "right_upper_arm",
            R::RightLowerArm => "right_lower_arm",
            R::RightHand => "right_hand",
            R::LeftUpperLeg => "left_upper_leg",
            R::LeftLowerLeg => "left_lower_leg",
            R::LeftFoot => "left_foot",
            R::LeftToes => "left_toes",
            R::RightUpperLeg => "right_upper_leg",
            R::RightLowerLeg => "right_lower_leg",
            R::RightFoot => "right_foot",
            R::RightToes => "right_toes",
        }
    }

    /// The same joint on the other side of the body; joints on the midline are their own mirror image.
    pub const fn mirrored(self) -> Role {
        match self as usize {
            i @ (5..=8 | 13..=16) => Role::ALL[i + 4],
            i @ (9..=12 | 17..=20) => Role::ALL[i - 4],
            i => Role::ALL[i],
        }
    }
}

const NO_PARENT: usize = usize::MAX;

/// Parent index of each canonical joint; `usize::MAX` for the hips.
pub const PARENTS: [usize; JOINTS] = [NO_PARENT, 0, 1, 2, 3, 2, 5, 6, 7, 2, 9, 10, 11, 0, 13, 14, 15, 0, 17, 18, 19];

/// Bone offsets of one canonical humanoid: position of each joint in its parent's frame in the T-pose,
/// metres; the hips' entry is the height of the hips in the T-pose with the soles on the ground (0, h, 0).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Proportions {
    /// Offsets by role.
    pub offsets: [Vec3; JOINTS],
}

impl Proportions {
    /// Length of thigh and shin of the left leg, metres, by which root motion is scaled.
    pub fn leg_length(&self) -> f32 {
        self.offsets[R::LeftLowerLeg.index()].length() + self.offsets[R::LeftFoot.index()].length()
    }

    /// Height of the body in the T-pose, metres: that of its head joint, in the mannequin's ratio (1.68 m in all).
    pub fn stature(&self) -> f32 {
        let head_joint = |p: &Self| [R::Hips, R::Spine, R::Chest, R::Neck, R::Head].map(|r| p.offsets[r.index()].y);
        let height = |p: &Self| head_joint(p).iter().sum::<f32>();
        1.68 * height(self) / height(&Self::default())
    }

    /// Whether every offset is finite and every limb bone has a length.
    pub fn is_valid(&self) -> bool {
        self.offsets.iter().all(|o| o.is_finite() && o.length() < 100.0)
            && [R::LeftLowerLeg, R::LeftFoot, R::RightLowerLeg, R::RightFoot]
                .iter()
                .chain(&[R::LeftLowerArm, R::LeftHand, R::RightLowerArm, R::RightHand])
                .all(|r| self.offsets[r.index()].length() > 1e-3)
    }
}

impl Default for Proportions {
    /// The default mannequin: 1.68 m tall, 7 heads.
    fn default() -> Self {
        let side = |s: f32| {
            [
                (Vec3::new(0.03 * s, 0.143, -0.004), Vec3::new(0.128 * s, 0.0, 0.0)),
                (Vec3::new(0.272 * s, 0.0, 0.0), Vec3::new(0.242 * s, 0.0, 0.0)),
                (Vec3::new(0.084 * s, -0.022, 0.0), Vec3::new(0.0, -0.391, 0.0)),
                (Vec3::new(0.0, -0.410, 0.0), Vec3::new(0.0, -0.084, 0.128)),
            ]
        };
        let (l, r) = (side(1.0), side(-1.0));
        Self {
            offsets: [
                Vec3::new(0.0, 0.941, 0.0),
                Vec3::new(0.0, 0.172, 0.0),
                Vec3::new(0.0, 0.108, -0.004),
                Vec3::new(0.0, 0.182, 0.0),
                Vec3::new(0.0, 0.085, 0.006),
                l[0].0,
                l[0].1,
                l[1].0,
                l[1].1,
                r[0].0,
                r[0].1,
                r[1].0,
                r[1].1,
                l[2].0,
                l[2].1,
                l[3].0,
                l[3].1,
                r[2].0,
                r[2].1,
                r[3].0,
                r[3].1,
            ],
        }
    }
}

/// One frame of a canonical humanoid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// World position of the hips, metres.
    pub root: Vec3,
    /// Rotation of each joint relative to its parent; the hips' relative to the world.
    pub rotations: [Quat; JOINTS],
}

impl Default for Pose {
    /// The T-pose at the default mannequin's height.
    fn default() -> Self {
        Self { root: Proportions::default().offsets[0], rotations: [Quat::IDENTITY; JOINTS] }
    }
}

/// Floats of one [`Pose`] in a flat array: root x y z, then x y z w of every rotation.
pub const POSE_FLOATS: usize = 3 + 4 * JOINTS;

impl Pose {
    /// Writes the pose as [`POSE_FLOATS`] numbers.
    pub fn write_to(&self, out: &mut [f32; POSE_FLOATS]) {
        out[..3].copy_from_slice(&self.root.to_array());
        for (chunk, q) in out[3..].chunks_exact_mut(4).zip(&self.rotations) {
            chunk.copy_from_slice(&q.to_array());
        }
    }

    /// Reads [`POSE_FLOATS`] numbers; rotations are normalised.
    pub fn read_from(floats: &[f32; POSE_FLOATS]) -> Self {
        let mut pose = Self { root: Vec3::new(floats[0], floats[1], floats[2]), rotations: [Quat::IDENTITY; JOINTS] };
        for (q, c) in pose.rotations.iter_mut().zip(floats[3..].chunks_exact(4)) {
            *q = Quat::from_xyzw(c[0], c[1], c[2], c[3]).normalized();
        }
        pose
    }

    /// Whether every number is finite.
    pub fn is_finite(&self) -> bool {
        self.root.is_finite() && self.rotations.iter().all(|q| q.is_finite())
    }

    /// The mirror image at the plane x = 0: left and right are swapped.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        Self {
            root: Vec3::new(-self.root.x, self.root.y, self.root.z),
            rotations: Role::ALL.map(|role| self.rotations[role.mirrored().index()].mirrored()),
        }
    }

    /// Interpolates the root linearly and rotations spherically; `t` in [0, 1].
    pub fn lerp(&self, to: &Self, t: f32) -> Self {
        let mut out = *self;
        out.root = self.root + (to.root - self.root) * t;
        for (o, (a, b)) in out.rotations.iter_mut().zip(self.rotations.iter().zip(&to.rotations)) {
            *o = a.slerp(*b, t);
        }
        out
    }
}

/// A clip of a canonical humanoid at a constant rate.
#[derive(Clone, Debug, PartialEq)]
pub struct HumanoidMotion {
    /// Bone offsets.
    pub proportions: Proportions,
    /// Frames per second; finite and positive.
    pub rate_hz: f32,
    /// One pose per frame.
    pub poses: Vec<Pose>,
}

/// Largest number of frames after resampling: more than four hours at 60 Hz.
pub const MAX_FRAMES: usize = 1_000_000;

/// Error of a motion that is too long to be resampled to a rate.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error("the motion has {frames} frames at {rate_hz} Hz; at most {MAX_FRAMES} are supported")]
pub struct TooManyFrames {
    /// Frames at the new rate.
    pub frames: usize,
    /// The new rate.
    pub rate_hz: f32,
}

impl HumanoidMotion {
    /// Resamples the motion to another rate. The first frame is kept; the last one is the last whole new frame within the
    /// clip. A motion with frames keeps at least one.
    ///
    /// # Errors
    /// See [`HumanoidMotion::frames_at`]; nothing is allocated then.
    pub fn resampled(&self, rate_hz: f32) -> Result<Self, TooManyFrames> {
        let frames = self.frames_at(rate_hz)?;
        let step = self.frames_per_frame_at(rate_hz);
        let poses = (0..frames).map(|f| self.sample(f as f64 * step)).collect();
        Ok(Self { proportions: self.proportions, rate_hz, poses })
    }

    /// Number of frames that the motion has at another rate.
    ///
    /// # Errors
    /// If there are more than [`MAX_FRAMES`].
    pub fn frames_at(&self, rate_hz: f32) -> Result<usize, TooManyFrames> {
        let Some(last) = self.poses.len().checked_sub(1) else { return Ok(0) };
        // The cast saturates.
        let frames = ((last as f64 / self.frames_per_frame_at(rate_hz) + 1e-6).floor() as usize).saturating_add(1);
        if frames > MAX_FRAMES { Err(TooManyFrames { frames, rate_hz }) } else { Ok(frames) }
    }

    /// Frames of this motion per frame at another rate.
    fn frames_per_frame_at(&self, rate_hz: f32) -> f64 {
        f64::from(self.rate_hz) / f64::from(rate_hz)
    }

    /// The pose at a fractional frame, clamped to the clip; the default pose if the clip is empty.
    pub fn sample(&self, frame: f64) -> Pose {
        let Some(last) = self.poses.len().checked_sub(1) else { return Pose::default() };
        let frame = frame.clamp(0.0, last as f64);
        let i = (frame.floor() as usize).min(last);
        let t = (frame - i as f64) as f32;
        if t <= 0.0 || i == last { self.poses[i] } else { self.poses[i].lerp(&self.poses[i + 1], t) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parents_come_first_and_mirror_twice_is_identity() {
        for role in Role::ALL {
            assert_eq!(Role::ALL[role.index()], role);
            assert_eq!(role.mirrored().mirrored(), role);
            assert!(role.parent().is_none_or(|p| p < role));
            assert_eq!(role.parent().map(Role::mirrored), role.mirrored().parent());
        }
    }

    #[test]
    fn floats_round_trip() {
        let mut pose = Pose { root: Vec3::new(1.0, 2.0, 3.0), ..Pose::default() };
        pose.rotations[4] = Quat::from_rotation_x(0.5);
        let mut floats = [0.0; POSE_FLOATS];
        pose.write_to(&mut floats);
        let back = Pose::read_from(&floats);
        assert!((back.rotations[4].dot(pose.rotations[4]) - 1.0).abs() < 1e-6);
        assert_eq!(back.root, pose.root);
    }

    #[test]
    fn resampling_keeps_first_and_last_frame() {
        let poses = (0..11).map(|i| Pose { root: Vec3::new(i as f32, 0.0, 0.0), ..Pose::default() }).collect();
        let clip = HumanoidMotion { proportions: Proportions::default(), rate_hz: 30.0, poses };
        let up = clip.resampled(60.0).unwrap();
        assert_eq!(up.poses.len(), 21);
        assert!((up.poses[20].root.x - 10.0).abs() < 1e-5);
        assert!((up.poses[3].root.x - 1.5).abs() < 1e-5);
    }

    #[test]
    fn resampling_to_too_many_frames_is_refused() {
        let clip = |rate_hz: f32, frames: usize| HumanoidMotion {
            proportions: Proportions::default(),
            rate_hz,
            poses: vec![Pose::default(); frames],
        };
        // 20,000 frames of 10 s each.
        let refusal = clip(0.1, 20_000).resampled(60.0).unwrap_err();
        assert_eq!(refusal.to_string(), "the motion has 11999400 frames at 60 Hz; at most 1000000 are supported");
        assert_eq!(clip(1.0, 2).frames_at(1e6), Err(TooManyFrames { frames: 1_000_001, rate_hz: 1e6 }));
        assert_eq!(clip(1.0, 2).frames_at(999_999.0), Ok(MAX_FRAMES));
        assert_eq!(clip(f32::MIN_POSITIVE, 2).frames_at(f32::MAX).unwrap_err().frames, usize::MAX);
    }
}
