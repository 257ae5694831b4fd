//! The trained model: plain data.

use super::measure::Measure;
use super::mixture::{Component, MAX_AXES, Style};
use super::pose_space::{DIMS, PoseSpace, Row};

/// Limit of a style's distance from the mean, standard deviations; styles beyond are clamped.
const FARTHEST: f64 = 100.0;

/// A map from style to pose.
#[derive(Clone, Debug, PartialEq)]
pub struct KeyStyleModel {
    /// Conversion between poses and rows.
    pub space: PoseSpace,
    /// Measures of the axes of a style: one to [`MAX_AXES`].
    pub axes: Vec<Measure>,
    /// Mean of the recorded styles, in the axes' units; 0 beyond the axes.
    pub style_mean: Style,
    /// Their standard deviations; 1 beyond the axes.
    pub style_deviation: Style,
    /// The maps.
    pub components: Vec<Component>,
    /// Variance of each number of a row about the map's prediction, common to all components.
    pub variance: f64,
    /// The support ([`super::Synthesis::support`]) that all but one percent of the recorded styles have.
    pub least_support: f64,
    /// Whether the feet move the body over the floor; otherwise it stays in place.
    pub travels: bool,
    /// The recordings, in the order of their frames.
    pub clips: Vec<ClipSpan>,
    /// The style of every recorded frame, in standard deviations from the mean.
    pub styles: Vec<Style>,
    /// The pose of every recorded frame.
    pub rows: Vec<[f32; DIMS]>,
}

/// Frame range of a recording.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ClipSpan {
    /// Its name.
    pub name: String,
    /// Its first frame among those of all recordings.
    pub first_frame: usize,
    /// Number of its frames.
    pub frames: usize,
}

impl KeyStyleModel {
    /// Converts a style to standard deviations from the mean; NaN is replaced by the mean.
    pub fn standardised(&self, style: &Style) -> Style {
        std::array::from_fn(|j| {
            let u = (style[j] - self.style_mean[j]) / self.style_deviation[j];
            if u.is_finite() { u.clamp(-FARTHEST, FARTHEST) } else { 0.0 }
        })
    }

    /// Converts a standardised style to the axes' units.
    pub fn in_units(&self, u: &Style) -> Style {
        std::array::from_fn(|j| self.style_mean[j] + u[j] * self.style_deviation[j])
    }

    /// Number of axes.
    pub fn axis_count(&self) -> usize {
        self.axes.len().min(MAX_AXES)
    }

    /// Returns the pose of a recorded frame, without its place on the floor.
    ///
    /// # Panics
    /// If there is no such frame.
    pub fn recorded_row(&self, frame: usize) -> Row {
        self.rows[frame].map(f64::from)
    }
}
