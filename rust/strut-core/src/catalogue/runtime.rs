//! Runtime form of a database.

use super::gait_phase::GaitPhase;
use super::header::Header;
use super::quantised::QuantisedRows;
use crate::humanoid::Pose;
use crate::pose_vector::PoseRow;
use crate::search::Index;
use std::ops::Deref;

/// A database prepared for styling: quantised rows, the data from which targets are computed, and the search index.
/// Point clouds are stored in the index only, and canonical times as phases of gait cycles. Read-only.
#[derive(Clone, Debug)]
pub struct Catalogue {
    pub(super) header: Header,
    pub(super) rows: QuantisedRows,
    pub(super) time_step: Vec<f32>,
    pub(super) gait_phase: GaitPhase,
    pub(super) contact: Vec<[u8; 2]>,
    pub(super) counterparts_per_style: usize,
    pub(super) counterpart: Vec<f32>,
    pub(super) sigma: PoseRow,
    pub(super) step_sigma: PoseRow,
    pub(super) observed_range: Box<[PoseRow; 2]>,
    pub(super) index: Index,
}

impl Catalogue {
    /// Quantised rows.
    pub fn rows(&self) -> &QuantisedRows {
        &self.rows
    }

    /// Poses of a clip, starting above the origin and heading along +Z.
    ///
    /// # Panics
    /// If the clip does not exist.
    pub fn poses_of_clip(&self, clip: usize) -> Vec<Pose> {
        let rows = self.clips[clip].rows().map(|row| self.rows.get(row));
        self.chart.decode_clip(rows, 1.0 / self.rate_hz)
    }

    /// Search index.
    pub fn index(&self) -> &Index {
        &self.index
    }

    /// Duration of a row: seconds per canonical frame, positive.
    pub fn time_step(&self, row: usize) -> f32 {
        self.time_step[row]
    }

    /// Phases of the rows.
    pub fn gait_phase(&self) -> &GaitPhase {
        &self.gait_phase
    }

    /// Contacts of a row [left, right]: 1 while the foot is planted, else 0.
    pub fn contact(&self, row: usize) -> [u8; 2] {
        self.contact[row]
    }

    /// Counterparts of a row in a style: fractional row indices, none if the style is missing for the row's action.
    pub fn counterparts(&self, row: usize, style: u16) -> impl Iterator<Item = f32> + '_ {
        let m = self.counterparts_per_style;
        let first = (row * self.styles.len() + usize::from(style)) * m;
        self.counterpart[first..first + m].iter().copied().take_while(|&c| c >= 0.0)
    }

    /// Standard deviation of each degree of freedom over all rows, floored at 1e-4; padding is 1.
    pub fn sigma(&self) -> &PoseRow {
        &self.sigma
    }

    /// Standard deviation of each degree of freedom's change from one frame to the next, floored at 1e-5; padding is 1.
    pub fn step_sigma(&self) -> &PoseRow {
        &self.step_sigma
    }

    /// Least and greatest value of each degree of freedom over all rows.
    pub fn observed_range(&self) -> &[PoseRow; 2] {
        &self.observed_range
    }
}

impl Deref for Catalogue {
    type Target = Header;
    fn deref(&self) -> &Header {
        &self.header
    }
}
