//! The runtime form of a database.

use super::builder::CatalogueBuilder;
use super::gait_phase::GaitPhase;
use super::header::Header;
use super::quantised::QuantisedRows;
use crate::database::{Database, PointCloud};
use crate::pose_vector::PoseRow;
use crate::search::{Index, Plan, PlanSource};
use std::ops::Deref;

/// A database made ready to style with: quantised rows, the data from which targets are computed, and the search index.
/// Point clouds are kept in the index only, canonical times as phases of gait cycles. Read-only.
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
    /// The catalogue of a database; builds the search index.
    pub fn new(db: Database) -> Self {
        Self::with_plan(db, None)
    }

    /// The catalogue of a database with the search index of a plan. Without a plan, or with that of another database, the
    /// index is built, which takes longer.
    ///
    /// # Panics
    /// Never: a [`Database`] was validated when it was made.
    pub fn with_plan(db: Database, plan: Option<Plan>) -> Self {
        let (builder, point_cloud) = Self::begin(db);
        let finish = |plan: Option<PlanSource<'_>>| {
            let copy = move |first: usize, to: &mut [PointCloud]| to.copy_from_slice(&point_cloud[first..][..to.len()]);
            builder.finish(copy, plan).expect("the database is valid")
        };
        match plan {
            Some(plan) if plan.has_all_points() => plan.with_source(|plan| finish(Some(plan))),
            _ => finish(None),
        }
    }

    /// The catalogue of a database and its index.
    ///
    /// # Panics
    /// As [`Catalogue::with_plan`].
    pub fn with_index(db: Database, index: Index) -> Self {
        Self::begin(db).0.finish_with(index)
    }

    /// The rows of a database, and its point clouds.
    fn begin(db: Database) -> (CatalogueBuilder, Vec<PointCloud>) {
        let (mut parts, _) = db.into_parts();
        let (pose, point_cloud) = (std::mem::take(&mut parts.pose), std::mem::take(&mut parts.point_cloud));
        let copy = |first: usize, to: &mut [PoseRow]| to.copy_from_slice(&pose[first..][..to.len()]);
        (CatalogueBuilder::new(parts, copy).expect("the database is valid"), point_cloud)
    }

    /// The same with another index of the same rows, such as one that is searched approximately.
    #[must_use]
    pub fn map_index(self, change: impl FnOnce(Index) -> Index) -> Self {
        Self { index: change(self.index), ..self }
    }

    /// The rows.
    pub fn rows(&self) -> &QuantisedRows {
        &self.rows
    }

    /// The search index.
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
