//! Descriptive data of a catalogue: rate, body, names, clips and classes.

use crate::database::{Class, Clip, DatabaseParts};
use crate::humanoid::Proportions;
use crate::pose_vector::PoseChart;

/// Frame rate, body, names, clips and classes of a catalogue.
#[derive(Clone, Debug)]
pub struct Header {
    /// Frames per second of every clip.
    pub rate_hz: f32,
    /// Bone offsets of the catalogue's humanoid.
    pub proportions: Proportions,
    /// Centres of the exponential maps.
    pub chart: PoseChart,
    /// Names of the actions.
    pub actions: Vec<String>,
    /// Names of the styles.
    pub styles: Vec<String>,
    /// Index of the neutral style.
    pub neutral: u16,
    /// Clips in the order of their rows.
    pub clips: Vec<Clip>,
    classes: Vec<Class>,
}

impl Header {
    /// Moves names and clips out of a database.
    pub(super) fn take(parts: &mut DatabaseParts, classes: Vec<Class>) -> Self {
        Self {
            rate_hz: parts.rate_hz,
            proportions: parts.proportions,
            chart: parts.chart,
            actions: std::mem::take(&mut parts.actions),
            styles: std::mem::take(&mut parts.styles),
            neutral: parts.neutral,
            clips: std::mem::take(&mut parts.clips),
            classes,
        }
    }

    /// Classes in order of their rows.
    pub fn classes(&self) -> &[Class] {
        &self.classes
    }

    /// Number of rows.
    pub fn frames(&self) -> usize {
        self.clips.last().map_or(0, |clip| clip.rows().end)
    }

    /// Index of the class of a row.
    ///
    /// # Panics
    /// If `row` is not below [`Header::frames`].
    pub fn class_of_row(&self, row: usize) -> usize {
        assert!(row < self.frames(), "row {row} of {}", self.frames());
        self.classes.partition_point(|class| class.rows.end <= row)
    }

    /// Index of the clip of a row.
    ///
    /// # Panics
    /// If `row` is not below [`Header::frames`].
    pub fn clip_of_row(&self, row: usize) -> usize {
        assert!(row < self.frames(), "row {row} of {}", self.frames());
        self.clips.partition_point(|clip| clip.rows().end <= row)
    }

    /// Index of the style of this name.
    pub fn style_index(&self, name: &str) -> Option<u16> {
        self.styles.iter().position(|style| style == name).map(|i| i as u16)
    }

    /// Index of the action of this name.
    pub fn action_index(&self, name: &str) -> Option<u16> {
        self.actions.iter().position(|action| action == name).map(|i| i as u16)
    }
}
