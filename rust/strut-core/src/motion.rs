//! A clip on its own skeleton: a local translation and rotation per joint and frame.

use crate::math::{Quat, Vec3};
use crate::skeleton::Skeleton;
use thiserror::Error;

/// A clip: `frames × joints` local transforms, row by row.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// The hierarchy that the transforms belong to.
    pub skeleton: Skeleton,
    /// Seconds from one frame to the next; finite and positive.
    pub frame_time_secs: f64,
    /// Position of each joint in its parent's frame, in the file's own length unit; `frames × joints`.
    pub translations: Vec<Vec3>,
    /// Rotation of each joint relative to its parent; `frames × joints`.
    pub rotations: Vec<Quat>,
}

/// Error of arrays that are not a valid motion.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum MotionError {
    /// An array is not a whole number of frames, or the arrays differ in length.
    #[error(
        "{translations} translations and {rotations} rotations are not the same whole number of frames of {joints} joints"
    )]
    Shape {
        /// Length of `translations`.
        translations: usize,
        /// Length of `rotations`.
        rotations: usize,
        /// Number of joints of the skeleton.
        joints: usize,
    },
    /// The frame time is zero, negative or not finite.
    #[error("the frame time is {0} s; a positive number was expected")]
    FrameTime(f64),
}

impl Motion {
    /// Creates a motion from its parts after checking them.
    ///
    /// # Errors
    /// See [`MotionError`].
    pub fn new(
        skeleton: Skeleton,
        frame_time_secs: f64,
        translations: Vec<Vec3>,
        rotations: Vec<Quat>,
    ) -> Result<Self, MotionError> {
        let joints = skeleton.len();
        if translations.len() != rotations.len() || !rotations.len().is_multiple_of(joints) {
            return Err(MotionError::Shape { translations: translations.len(), rotations: rotations.len(), joints });
        }
        if !(frame_time_secs.is_finite() && frame_time_secs > 0.0) {
            return Err(MotionError::FrameTime(frame_time_secs));
        }
        Ok(Self { skeleton, frame_time_secs, translations, rotations })
    }

    /// Number of frames.
    pub fn frames(&self) -> usize {
        self.rotations.len() / self.skeleton.len()
    }

    /// Local translations of frame `f`, one per joint.
    pub fn translations_at(&self, f: usize) -> &[Vec3] {
        let n = self.skeleton.len();
        &self.translations[f * n..(f + 1) * n]
    }

    /// Local rotations of frame `f`, one per joint.
    pub fn rotations_at(&self, f: usize) -> &[Quat] {
        let n = self.skeleton.len();
        &self.rotations[f * n..(f + 1) * n]
    }

    /// Length in seconds, counting every frame's duration.
    pub fn duration_secs(&self) -> f64 {
        self.frames() as f64 * self.frame_time_secs
    }
}
