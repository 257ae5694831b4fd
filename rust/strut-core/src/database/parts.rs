//! Data of a database: clips, classes and tensors.

use crate::humanoid::{JOINTS, Proportions};
use crate::math::Vec3;
use crate::pose_vector::{PoseChart, PoseRow};
use std::ops::Range;

/// Joint positions of a row, metres, with the heading removed and the hips above the origin.
pub type PointCloud = [Vec3; JOINTS];

/// One clip of a [`Database`](super::Database).
#[derive(Clone, Debug, PartialEq)]
pub struct Clip {
    /// File stem or other display name.
    pub name: String,
    /// Index into [`DatabaseParts::actions`].
    pub action: u16,
    /// Index into [`DatabaseParts::styles`].
    pub style: u16,
    /// Number of the take.
    pub take: u32,
    /// First row.
    pub first_frame: usize,
    /// Number of rows, at least 1.
    pub frames: usize,
    /// Origin of the clip.
    pub source: String,
    /// Licence, empty if unknown.
    pub licence: String,
}

impl Clip {
    /// Rows of the clip.
    pub fn rows(&self) -> Range<usize> {
        self.first_frame..self.first_frame + self.frames
    }
}

/// All frames of one action in one style.
#[derive(Clone, Debug, PartialEq)]
pub struct Class {
    /// Index of the action.
    pub action: u16,
    /// Index of the style.
    pub style: u16,
    /// Rows of the class.
    pub rows: Range<usize>,
    /// Clips of the class, as indices into [`DatabaseParts::clips`].
    pub clips: Range<usize>,
}

/// Data of a database; N rows, S styles, M counterparts.
#[derive(Clone, Debug, PartialEq)]
pub struct DatabaseParts {
    /// Frames per second of every clip.
    pub rate_hz: f32,
    /// Bone offsets of the database's humanoid.
    pub proportions: Proportions,
    /// Centres of the exponential maps.
    pub chart: PoseChart,
    /// Names of the actions.
    pub actions: Vec<String>,
    /// Names of the styles.
    pub styles: Vec<String>,
    /// Index of the neutral style.
    pub neutral: u16,
    /// Clips sorted by (action, style); their rows are contiguous.
    pub clips: Vec<Clip>,
    /// N rows of degrees of freedom.
    pub pose: Vec<PoseRow>,
    /// N sets of heading-free joint positions, metres.
    pub point_cloud: Vec<PointCloud>,
    /// N times on the canonical timeline of the action (the neutral reference cycle), in canonical frames.
    pub canonical_time: Vec<f32>,
    /// N durations: seconds per canonical frame, positive.
    pub time_step: Vec<f32>,
    /// N contacts [left, right]: 1 while the foot is planted, else 0.
    pub contact: Vec<[u8; 2]>,
    /// M, at most [`MAX_COUNTERPARTS`](crate::registration::MAX_COUNTERPARTS).
    pub counterparts_per_style: usize,
    /// N × S × M registered rows as fractional row indices; −1 for none. A frame has either no counterpart in a style
    /// or at least one, listed first. Single precision, as in the file: the resolution is 1/128 frame at 80,000 rows,
    /// 1/8 at a million.
    pub counterpart: Vec<f32>,
}
