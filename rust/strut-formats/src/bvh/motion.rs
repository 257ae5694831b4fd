//! [`Bvh`] ↔ [`Motion`].

use super::euler::{compose, decompose};
use super::far::Far;
use super::{Axis, Bvh, BvhError, Channel, FRAME_TIME_SECS, MAX_ABS_VALUE, MAX_FRAMES, MAX_TRANSFORMS};
use strut_core::math::{Quat, Vec3};
use strut_core::motion::Motion;
use strut_core::skeleton::{self, Skeleton};

/// Upper bound of the mean of each frame's largest rotation step in recordings, degrees: the mean is 6 at 30 Hz, 15 for
/// dances.
const SMALL_STEP: f64 = 30.0;
/// Bones shorter than this share of their offsets count as collapsed.
const FOLDED: f64 = 0.02;

impl Bvh {
    /// Returns whether the body would collapse if position channels replaced offsets: below the root the positions are
    /// near zero in the first frame, and most of these joints have offsets.
    pub(super) fn collapses(&self) -> bool {
        let mut first = 0;
        let (mut with_offset, mut folded) = (0, 0);
        for joint in &self.joints {
            let values = &self.values[first..first + joint.channels.len()];
            first += joint.channels.len();
            let positions = joint.channels.iter().zip(values).filter(|(c, _)| matches!(c, Channel::Position(_)));
            let positions: Vec<f64> = positions.map(|(_, value)| *value).collect();
            if joint.parent.is_none() || positions.len() < 3 {
                continue;
            }
            let length = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
            let offset = length(&joint.offset);
            if offset > 0.0 {
                with_offset += 1;
                folded += usize::from(length(&positions) <= FOLDED * offset);
            }
        }
        with_offset > 2 && 2 * folded > with_offset
    }

    /// Returns whether rotations change as slowly as in a recording: the largest step of each frame is less than
    /// [`SMALL_STEP`] on average. `false` for a single frame.
    pub(super) fn moves_in_small_steps(&self) -> bool {
        let is_rotation: Vec<bool> =
            self.joints.iter().flat_map(|j| &j.channels).map(|c| matches!(c, Channel::Rotation(_))).collect();
        let rows = |f: usize| self.row(f).iter().zip(self.row(f + 1)).zip(&is_rotation);
        // An angle may wrap at the end of its range.
        let step = |(a, b): (&f64, &f64)| ((b - a + 180.0).rem_euclid(360.0) - 180.0).abs();
        let largest = |f: usize| rows(f).filter(|(_, is)| **is).map(|(ab, _)| step(ab)).fold(0.0, f64::max);
        let steps = self.frames.saturating_sub(1);
        steps > 0 && (0..steps).map(largest).sum::<f64>() < SMALL_STEP * steps as f64
    }

    /// The clip as local translations and rotations. Lengths stay in the file's unit. A body far from the file's origin
    /// is moved near it.
    ///
    /// # Errors
    /// [`BvhError::Skeleton`] or [`BvhError::Motion`] for a document that was not created by [`parse()`](super::parse())
    /// and violates its rules.
    pub fn to_motion(&self) -> Result<Motion, BvhError> {
        let joints = self.joints.iter().map(|j| skeleton::Joint {
            name: j.name.clone(),
            parent: j.parent,
            offset: vec3(j.offset),
            end: j.end_site.map(vec3),
        });
        let skeleton = Skeleton::new(joints.collect())?;
        let channels = self.channels();
        let mut translations = Vec::with_capacity(self.frames * self.joints.len());
        let mut rotations = Vec::with_capacity(self.frames * self.joints.len());
        let far = self.far();
        for row in self.values.chunks_exact(channels.max(1)) {
            for (translation, rotation) in self.transforms_near(row, far) {
                translations.push(translation);
                rotations.push(rotation);
            }
        }
        Ok(Motion::new(skeleton, self.frame_time_secs, translations, rotations)?)
    }

    /// Local translation and rotation of every joint in a frame with these values, [`Bvh::channels`] of them. Joints
    /// with missing values are omitted.
    pub fn transforms(&self, row: &[f64]) -> impl Iterator<Item = (Vec3, Quat)> {
        self.transforms_near(row, None)
    }

    /// Same as [`Bvh::transforms`], with the position of a far body subtracted.
    fn transforms_near(&self, row: &[f64], far: Option<Far>) -> impl Iterator<Item = (Vec3, Quat)> {
        let added = self.added_positions;
        self.joints.iter().enumerate().scan(row, move |rest, (j, joint)| {
            let (own, others) = rest.split_at_checked(joint.channels.len())?;
            *rest = others;
            let mut translation = joint.offset;
            for (channel, &value) in joint.channels.iter().zip(own) {
                if let Channel::Position(axis) = channel {
                    let at = &mut translation[*axis as usize];
                    *at = if added && joint.parent.is_some() { *at + value } else { value };
                }
            }
            if let Some(far) = far.filter(|far| far.joint == j) {
                translation = std::array::from_fn(|axis| translation[axis] - far.place[axis]);
            }
            let turns = joint.channels.iter().zip(own).filter_map(|(channel, &value)| match channel {
                Channel::Rotation(axis) => Some((*axis, value.to_radians())),
                Channel::Position(_) => None,
            });
            let [x, y, z, w] = compose(turns).map(|v| v as f32);
            Some((vec3(translation), Quat::from_xyzw(x, y, z, w)))
        })
    }

    /// The motion as a file of this hierarchy: same names, offsets and channel order, with the motion's frame time and
    /// local transforms. Only the part that the channels can express is kept. The body is as far from the origin as in
    /// this file.
    ///
    /// Angles continue from frame to frame without wrapping, starting with those nearest to this file's first frame.
    /// Values are rounded to six decimals, finer than the resolution of `f32`.
    ///
    /// # Errors
    /// [`BvhError::JointCount`] if the number of joints differs. If the file could not be read back:
    /// [`BvhError::UnwritableFrames`] and [`BvhError::UnwritableFrameTime`] outside the limits of files,
    /// [`BvhError::Unwritable`] if a value is not finite or beyond [`MAX_ABS_VALUE`].
    pub fn with_motion(&self, motion: &Motion) -> Result<Self, BvhError> {
        let (found, needed) = (motion.skeleton.len(), self.joints.len());
        if found != needed {
            return Err(BvhError::JointCount { found, needed });
        }
        let (frames, joints) = (motion.frames(), found);
        if !(1..=MAX_FRAMES).contains(&frames) || frames * joints > MAX_TRANSFORMS {
            return Err(BvhError::UnwritableFrames { frames, joints });
        }
        if !FRAME_TIME_SECS.contains(&motion.frame_time_secs) {
            return Err(BvhError::UnwritableFrameTime { secs: motion.frame_time_secs });
        }
        let channels = self.channels();
        let mut values: Vec<f64> = Vec::with_capacity(frames * channels);
        let mut previous: Vec<f64> = self.values.iter().copied().take(channels).collect();
        previous.resize(channels, 0.0);
        let mut solver = AngleSolver::default();
        let far = self.far();
        for f in 0..frames {
            let mut first = 0;
            let transforms = motion.translations_at(f).iter().zip(motion.rotations_at(f));
            for (j, (joint, (t, q))) in self.joints.iter().zip(transforms).enumerate() {
                let row = first..first + joint.channels.len();
                first = row.end;
                let is_added = self.added_positions && joint.parent.is_some();
                let t = if is_added { *t - vec3(joint.offset) } else { *t };
                let mut t = t.to_array().map(f64::from);
                if let Some(far) = far.filter(|far| far.joint == j) {
                    t = std::array::from_fn(|axis| t[axis] + far.place[axis]);
                }
                solver.write(&joint.channels, t, *q, &mut previous[row.clone()]);
                if let Some(&value) = previous[row].iter().find(|v| v.is_nan() || v.abs() > MAX_ABS_VALUE) {
                    return Err(BvhError::Unwritable { frame: f, joint: joint.name.clone(), value });
                }
            }
            values.extend(previous.iter().map(|v| (v * 1e6).round() / 1e6));
        }
        Ok(Self {
            joints: self.joints.clone(),
            added_positions: self.added_positions,
            frame_time_secs: motion.frame_time_secs,
            frames,
            values,
        })
    }
}

/// Working memory for the rotation channels of one joint.
#[derive(Default)]
struct AngleSolver {
    axes: Vec<Axis>,
    before: Vec<f64>,
    angles: Vec<f64>,
}

impl AngleSolver {
    /// Replaces the joint's channel values of the previous frame by those of a translation and rotation.
    fn write(&mut self, channels: &[Channel], translation: [f64; 3], rotation: Quat, values: &mut [f64]) {
        self.axes.clear();
        self.before.clear();
        for (channel, value) in channels.iter().zip(values.iter_mut()) {
            match channel {
                Channel::Position(axis) => *value = translation[*axis as usize],
                Channel::Rotation(axis) => {
                    self.axes.push(*axis);
                    self.before.push(value.to_radians());
                }
            }
        }
        self.angles.resize(self.axes.len(), 0.0);
        decompose(rotation.to_array().map(f64::from), &self.axes, &self.before, &mut self.angles);
        let rotation_values = channels.iter().zip(values).filter(|(c, _)| matches!(c, Channel::Rotation(_)));
        for ((_, value), angle) in rotation_values.zip(&self.angles) {
            *value = angle.to_degrees();
        }
    }
}

fn vec3(v: [f64; 3]) -> Vec3 {
    Vec3::new(v[0] as f32, v[1] as f32, v[2] as f32)
}
