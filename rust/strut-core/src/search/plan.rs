//! What takes long to find out about an index, and does not change what it finds.

use super::block::{BLOCK, Point};
use super::leaves::Leaves;
use super::metric::{CentredWindow, Metric, WINDOW};
use super::order::arrange;
use super::subspace::Subspace;
use super::windows::Windows;
use super::{Index, NO_ROW};
use crate::database::Database;
use thiserror::Error;

/// Windows that the directions of a subspace are taken from.
const SAMPLES: usize = 512;

const METRICS: [Metric; 2] = [Metric::FullBody, Metric::LowerBody];

/// The parts of an [`Index`] that a file may hold: how fast a search is depends on them, what it finds does not, so
/// that they need not be trusted.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// The rows at which windows end, class by class; within a class near ones together.
    pub order: Vec<u32>,
    /// For the full-body and the lower-body metric the mean and the principal directions of windows, in lanes:
    /// [`Plan::BASIS_LENGTH`] numbers each.
    pub bases: [Vec<f32>; 2],
}

/// Why a plan is none for a database.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum PlanError {
    /// The rows are not those at which windows of the database end, each once and by class.
    #[error("its order is not one of the database's windows")]
    Order,
    /// The numbers are no orthonormal directions.
    #[error("its directions are not orthonormal")]
    Basis,
}

impl Plan {
    /// Changes whenever what [`Plan::bases`] mean does.
    pub const VERSION: u32 = 1;
    /// Numbers of each of [`Plan::bases`].
    pub const BASIS_LENGTH: usize = Subspace::float_count(WINDOW);
}

impl Index {
    /// The windows of `length` frames, 1 to [`super::MAX_WINDOW`], by a plan that is made for them.
    pub(super) fn planned(db: &Database, length: usize) -> Self {
        let windows = Windows::new(db, length);
        let ends: Vec<usize> = (0..windows.classes.len()).flat_map(|class| windows.of_class(class)).collect();
        let samples = || ends.iter().step_by(ends.len().div_ceil(SAMPLES).max(1));
        let subspaces = METRICS.map(|metric| {
            let sample: Vec<CentredWindow> = samples().map(|&row| windows.centred(row, metric)).collect();
            Subspace::fit(&sample, length)
        });
        let mut index = Self::new(windows, subspaces);
        for class in 0..index.classes() {
            let rows: Vec<u32> = index.windows.of_class(class).map(|row| row as u32).collect();
            let points = index.begin_class(class, &rows, Metric::FullBody);
            let mut items: Vec<usize> = (0..rows.len()).collect();
            arrange(&points, &mut items);
            let rows: Vec<u32> = items.iter().map(|&i| rows[i]).collect();
            let points: Vec<Point> = items.iter().map(|&i| points[i]).collect();
            index.end_class(class, &rows, &points);
        }
        index
    }

    /// The windows of [`WINDOW`] frames by a plan: the same as [`Index::build`] makes, sooner.
    ///
    /// # Errors
    /// [`PlanError`] if the plan is not one for this database.
    pub fn from_plan(db: &Database, plan: &Plan) -> Result<Self, PlanError> {
        let [Some(full), Some(lower)] = [0, 1].map(|i| Subspace::from_floats(&plan.bases[i], WINDOW)) else {
            return Err(PlanError::Basis);
        };
        let mut index = Self::new(Windows::new(db, WINDOW), [full, lower]);
        let mut order = &plan.order[..];
        for class in 0..index.classes() {
            let rows: Vec<u32> = index.windows.of_class(class).map(|row| row as u32).collect();
            let (here, rest) = order.split_at_checked(rows.len()).ok_or(PlanError::Order)?;
            if !is_permutation(here, &rows) {
                return Err(PlanError::Order);
            }
            let points = index.begin_class(class, here, Metric::FullBody);
            index.end_class(class, here, &points);
            order = rest;
        }
        if order.is_empty() { Ok(index) } else { Err(PlanError::Order) }
    }

    /// What [`Index::from_plan`] takes.
    pub fn plan(&self) -> Plan {
        Plan {
            order: self.rows.as_flattened().iter().copied().filter(|&row| row != NO_ROW).collect(),
            bases: [0, 1].map(|i| self.leaves[i].subspace().floats()),
        }
    }

    /// With room for its leaves.
    fn new(windows: Windows, subspaces: [Subspace; 2]) -> Self {
        let (rows, classes) = (windows.rows(), 0..windows.classes.len());
        let leaves = classes.map(|class| windows.of_class(class).count().div_ceil(BLOCK)).sum();
        Self {
            windows,
            norms: METRICS.map(|_| vec![0.0; rows]),
            leaves: subspaces.map(|s| Leaves::new(s, leaves)),
            rows: Vec::with_capacity(leaves),
            slots: vec![NO_ROW; rows],
            #[cfg(feature = "offline")]
            kd_trees: None,
        }
    }

    /// Begins a class in the leaves of a metric; returns the integers of its windows, which end at `rows`.
    fn begin_class(&mut self, class: usize, rows: &[u32], metric: Metric) -> Vec<Point> {
        let Self { windows, norms, leaves, .. } = self;
        let uncentred_length = windows.uncentred_length(class, metric);
        let centred = rows.iter().map(|&row| {
            let window = windows.centred(row as usize, metric);
            norms[metric as usize][row as usize] = window.norm;
            window
        });
        leaves[metric as usize].begin_class(centred, uncentred_length)
    }

    /// Ends a class of these windows, whose integers by the full-body metric are given.
    fn end_class(&mut self, class: usize, rows: &[u32], points: &[Point]) {
        self.leaves[Metric::FullBody as usize].end_class(points);
        let points = self.begin_class(class, rows, Metric::LowerBody);
        self.leaves[Metric::LowerBody as usize].end_class(&points);
        for rows in rows.chunks(BLOCK) {
            let mut leaf = [NO_ROW; BLOCK];
            leaf[..rows.len()].copy_from_slice(rows);
            for (i, row) in rows.iter().enumerate() {
                self.slots[*row as usize] = (self.rows.len() * BLOCK + i) as u32;
            }
            self.rows.push(leaf);
        }
    }
}

/// Whether `order` holds the numbers of the ascending `rows` in any order.
fn is_permutation(order: &[u32], rows: &[u32]) -> bool {
    let mut seen = vec![false; rows.len()];
    order.len() == rows.len()
        && order.iter().all(|row| rows.binary_search(row).is_ok_and(|i| !std::mem::replace(&mut seen[i], true)))
}
