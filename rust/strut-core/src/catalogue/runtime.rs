//! The runtime form of a database.

use super::gait_phase::GaitPhase;
use super::header::Header;
use super::quantised::QuantisedRows;
use crate::database::{Database, DatabaseParts};
use crate::humanoid::JOINTS;
use crate::math::Vec3;
use crate::pose_vector::{DOFS, PoseRow, ROW};
use crate::search::{Index, Plan, WINDOW, Windows, places};
use std::ops::Deref;

/// A database made ready to style with: quantised rows, the data from which targets are computed, and the search index.
/// Point clouds are kept in the index only, canonical times as phases of gait cycles. Read-only.
#[derive(Clone, Debug)]
pub struct Catalogue {
    header: Header,
    rows: QuantisedRows,
    time_step: Vec<f32>,
    gait_phase: GaitPhase,
    contact: Vec<[u8; 2]>,
    counterparts_per_style: usize,
    counterpart: Vec<f32>,
    sigma: PoseRow,
    step_sigma: PoseRow,
    observed_range: Box<[PoseRow; 2]>,
    index: Index,
}

impl Catalogue {
    /// The catalogue of a database; builds the search index.
    pub fn new(db: Database) -> Self {
        Self::with_plan(db, None)
    }

    /// The catalogue of a database with the search index of a plan. Without a plan, or with that of another database, the
    /// index is built, which takes longer.
    pub fn with_plan(db: Database, plan: Option<Plan>) -> Self {
        let places = places(&db);
        Self::assemble(db, |header, point_cloud| {
            let windows = Windows::of_clouds(&header.clips, header.classes(), &point_cloud, &places, WINDOW);
            drop((point_cloud, places));
            Index::of_windows(windows, plan)
        })
    }

    /// The catalogue of a database and its index.
    pub fn with_index(db: Database, index: Index) -> Self {
        Self::assemble(db, |_, _| index)
    }

    /// Makes the index, of the point clouds, after the database's rows have been freed: a package's memory never shrinks.
    fn assemble(db: Database, index: impl FnOnce(&Header, Vec<[Vec3; JOINTS]>) -> Index) -> Self {
        let (sigma, step_sigma) = (*db.sigma(), step_deviation(&db));
        let observed_range = Box::new(*db.observed_range());
        let rows = QuantisedRows::new(&db.pose, &observed_range);
        let gait_phase = GaitPhase::new(&db);
        let (mut parts, classes) = db.into_parts();
        let header = Header::take(&mut parts, classes);
        let DatabaseParts { pose, point_cloud, time_step, contact, counterparts_per_style, counterpart, .. } = parts;
        drop(pose);
        let index = index(&header, point_cloud);
        Self {
            header,
            rows,
            time_step,
            gait_phase,
            contact,
            counterparts_per_style,
            counterpart,
            sigma,
            step_sigma,
            observed_range,
            index,
        }
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

fn step_deviation(db: &Database) -> PoseRow {
    let (mut sums, mut squares, mut count) = ([0.0_f64; ROW], [0.0_f64; ROW], 0.0_f64);
    for clip in &db.clips {
        for pair in db.pose[clip.rows()].windows(2) {
            count += 1.0;
            add_step([&pair[0], &pair[1]], &mut sums, &mut squares);
        }
    }
    let n = count.max(1.0);
    let deviation = |d: usize| (squares[d] / n - (sums[d] / n) * (sums[d] / n)).max(0.0).sqrt() as f32;
    std::array::from_fn(|d| if d < DOFS { deviation(d).max(1e-5) } else { 1.0 })
}

#[inline(never)] // In WebAssembly a function becomes fast once it has been called often.
fn add_step([from, to]: [&PoseRow; 2], sums: &mut [f64; ROW], squares: &mut [f64; ROW]) {
    for (d, (sum, square)) in sums.iter_mut().zip(squares).enumerate() {
        let step = f64::from(to[d]) - f64::from(from[d]);
        *sum += step;
        *square += step * step;
    }
}
