//! The trained model: plain numbers.

use super::measure::Measure;
use super::mixture::{Component, MAX_AXES, Style};
use super::pose_space::{DIMS, PoseSpace, Row};

/// How many standard deviations from the mean a style can be taken to be; beyond, all is as it is there.
const FARTHEST: f64 = 100.0;

/// A map from style to pose.
#[derive(Clone, Debug, PartialEq)]
pub struct KeyStyleModel {
    /// How poses become rows.
    pub space: PoseSpace,
    /// What the numbers of a style are: one to [`MAX_AXES`].
    pub axes: Vec<Measure>,
    /// Mean of the recorded styles, in the axes' units; 0 beyond the axes.
    pub style_mean: Style,
    /// Their standard deviations; 1 beyond the axes.
    pub style_deviation: Style,
    /// The maps.
    pub components: Vec<Component>,
    /// The variance of a number of a row about the map's, which all share.
    pub variance: f64,
    /// The support ([`super::Synthesis::support`]) that all but a hundredth of the recorded styles have.
    pub least_support: f64,
    /// Whether the body goes where its feet carry it, or stays where it is.
    pub travels: bool,
    /// The recordings, in the order of their frames.
    pub clips: Vec<ClipSpan>,
    /// The style of every recorded frame, in standard deviations from the mean.
    pub styles: Vec<Style>,
    /// The pose of every recorded frame.
    pub rows: Vec<[f32; DIMS]>,
}

/// Where the frames of a recording are.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ClipSpan {
    /// What it is called.
    pub name: String,
    /// Its first frame among those of all.
    pub first_frame: usize,
    /// How many it has.
    pub frames: usize,
}

impl KeyStyleModel {
    /// A style in standard deviations from the mean; a number that is none counts as the mean.
    pub fn standardised(&self, style: &Style) -> Style {
        std::array::from_fn(|j| {
            let u = (style[j] - self.style_mean[j]) / self.style_deviation[j];
            if u.is_finite() { u.clamp(-FARTHEST, FARTHEST) } else { 0.0 }
        })
    }

    /// A standardised style in the axes' units.
    pub fn in_units(&self, u: &Style) -> Style {
        std::array::from_fn(|j| self.style_mean[j] + u[j] * self.style_deviation[j])
    }

    /// Number of axes.
    pub fn axis_count(&self) -> usize {
        self.axes.len().min(MAX_AXES)
    }

    /// The pose of a recorded frame as it was, but for its place on the floor.
    ///
    /// # Panics
    /// If there is no such frame.
    pub fn recorded_row(&self, frame: usize) -> Row {
        self.rows[frame].map(f64::from)
    }
}
