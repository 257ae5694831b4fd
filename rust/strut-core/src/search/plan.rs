//! Plans: the parts of an index that take long to compute, in the form that a file stores.

use super::block::{BLOCK, Point, has_squared_length};
use super::index::{Index, NO_ROW};
use super::leaves::Leaves;
use super::metric::{CentredWindow, LENGTH, Metric, WINDOW};
use super::order::arrange;
use super::points::{POINTS, PointRow};
use super::subspace::{COORDINATES, Subspace};
use super::windows::Windows;
use crate::database::Database;
use std::ops::Range;
use thiserror::Error;

/// Approximate number of windows to which the directions of a subspace are fitted, and whose points in a plan are
/// compared in full.
const SAMPLES: usize = 512;

/// Memory for each row of the class that is being built, bytes: three copies of its window's coordinates, and its order.
const ROW_TO_BUILD: u64 = 3 * size_of::<Point>() as u64 + 40;
/// Memory of the windows to which directions are fitted, and of their numbers in double precision, bytes.
const TO_FIT: u64 = (SAMPLES * (size_of::<CentredWindow>() + 16 * WINDOW * POINTS) + 400_000) as u64;

const METRICS: [Metric; 2] = [Metric::FullBody, Metric::LowerBody];

/// Parts of an [`Index`] that take long to compute and that a file may contain.
///
/// The order and the bases affect the speed of a search, not its result. The points determine what is excluded: a
/// search is exact if every point is that of its window. Computing all of them would take as long as building the
/// index, so [`Index::from_plan`] computes some of them and checks the length of all. This detects damage and mistakes.
/// A plan with deliberately wrong points of the right lengths can make a search miss windows, but cannot do other harm.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Rows at which windows end, ordered by class; within a class near windows are adjacent.
    pub order: Vec<u32>,
    /// For the full-body and the lower-body metric the mean and the principal directions of windows, in lanes:
    /// [`Plan::BASIS_LENGTH`] numbers each.
    pub bases: [Vec<f32>; 2],
    /// For both metrics the quantised coordinates of the windows along these directions, in this order.
    pub points: [Vec<[i16; Plan::COORDINATES]>; 2],
}

/// A plan whose points are read in parts: those of a file are never in memory completely.
pub struct PlanSource<'a> {
    /// [`Plan::order`].
    pub order: Vec<u32>,
    /// [`Plan::bases`].
    pub bases: [Vec<f32>; 2],
    /// Copies some of [`Plan::points`]: those of a metric from an index on. There are as many as rows in `order`.
    pub points: &'a PointReader<'a>,
}

type PointReader<'a> = dyn Fn(usize, usize, &mut [[i16; Plan::COORDINATES]]) + 'a;

/// Number of points that are read at once, a multiple of the leaf size.
const PORTION: usize = 64 * BLOCK;

/// Reason why a plan does not match a database.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum PlanError {
    /// The rows are not those at which windows of the database end, each once and by class.
    #[error("its order is not one of the database's windows")]
    Order,
    /// The numbers are not orthonormal directions.
    #[error("its directions are not orthonormal")]
    Basis,
    /// The points are not those of the database's windows.
    #[error("its points are not those of the database's windows")]
    Points,
}

impl Plan {
    /// Version of the format; it changes with the meaning of [`Plan::bases`] or [`Plan::points`].
    pub const VERSION: u32 = 2;
    /// Number of values in each of [`Plan::bases`].
    pub const BASIS_LENGTH: usize = Subspace::float_count(WINDOW);
    /// Number of values in each of [`Plan::points`].
    pub const COORDINATES: usize = COORDINATES;

    /// Returns whether both metrics have a point for each row of the order.
    pub(crate) fn has_all_points(&self) -> bool {
        self.points.iter().all(|points| points.len() == self.order.len())
    }

    /// Calls `with` with this plan, which has all points, as a source that is read in parts.
    pub(crate) fn with_source<T>(self, with: impl FnOnce(PlanSource<'_>) -> T) -> T {
        let Self { order, bases, points } = self;
        let read = |metric: usize, first: usize, to: &mut [Point]| {
            to.copy_from_slice(&points[metric][first..][..to.len()]);
        };
        with(PlanSource { order, bases, points: &read })
    }
}

impl Index {
    /// Index of these windows: from a plan if it matches them, otherwise built.
    pub(crate) fn of_windows(windows: Windows, plan: Option<PlanSource<'_>>) -> Self {
        match plan.map(|plan| (Self::subspaces_of(&windows, &plan.order, &plan.bases), plan)) {
            Some((Ok(subspaces), plan)) => {
                let empty = Self::new(windows, subspaces);
                empty.planned(&plan).unwrap_or_else(|windows| Self::fitted(*windows))
            }
            _ => Self::fitted(windows),
        }
    }

    /// Builds the index of these windows.
    pub(super) fn fitted(windows: Windows) -> Self {
        let length = windows.length;
        let ends: Vec<usize> = (0..windows.classes.len()).flat_map(|class| windows.of_class(class)).collect();
        let sample =
            |metric| -> Vec<CentredWindow> { sample(&ends).map(|&row| windows.centred(row, metric)).collect() };
        let subspaces = METRICS.map(|metric| Subspace::fit(&sample(metric), length, metric));
        let mut index = Self::new(windows, subspaces);
        for class in 0..index.classes() {
            let rows: Vec<u32> = index.windows.of_class(class).map(|row| row as u32).collect();
            let points: Vec<Point> = rows.iter().map(|&row| index.point(row, Metric::FullBody)).collect();
            let mut items: Vec<usize> = (0..rows.len()).collect();
            arrange(&points, &mut items);
            let rows: Vec<u32> = items.iter().map(|&i| rows[i]).collect();
            let points: Vec<Point> = items.iter().map(|&i| points[i]).collect();
            let lower: Vec<Point> = rows.iter().map(|&row| index.point(row, Metric::LowerBody)).collect();
            index.add_rows(&rows);
            for (metric, points) in [(Metric::FullBody, points), (Metric::LowerBody, lower)] {
                index.leaves[metric as usize].add_leaves(&points);
                index.end_class(class, metric);
            }
        }
        index
    }

    /// Creates the index of windows of [`WINDOW`] frames from a plan: the same as [`Index::build`], but faster.
    ///
    /// # Errors
    /// [`PlanError`] if the plan does not match this database.
    pub fn from_plan(db: &Database, plan: Plan) -> Result<Self, PlanError> {
        let windows = Windows::new(db, WINDOW);
        let subspaces = Self::subspaces_of(&windows, &plan.order, &plan.bases)?;
        if !plan.has_all_points() {
            return Err(PlanError::Points);
        }
        plan.with_source(|source| Self::new(windows, subspaces).planned(&source)).map_err(|_| PlanError::Points)
    }

    /// Subspaces of a plan, if its order is one of these windows.
    fn subspaces_of(windows: &Windows, order: &[u32], bases: &[Vec<f32>; 2]) -> Result<[Subspace; 2], PlanError> {
        let subspaces = METRICS.map(|metric| Subspace::from_floats(&bases[metric as usize], windows.length, metric));
        let [Some(full), Some(lower)] = subspaces else {
            return Err(PlanError::Basis);
        };
        let mut rest = order;
        for class in 0..windows.classes.len() {
            let rows: Vec<u32> = windows.of_class(class).map(|row| row as u32).collect();
            let (here, others) = rest.split_at_checked(rows.len()).ok_or(PlanError::Order)?;
            if !is_permutation(here, &rows) {
                return Err(PlanError::Order);
            }
            rest = others;
        }
        if rest.is_empty() { Ok([full, lower]) } else { Err(PlanError::Order) }
    }

    /// Adds the leaves of a plan to an index without leaves. Returns the windows if the points do not match them.
    fn planned(mut self, plan: &PlanSource<'_>) -> Result<Self, Box<Windows>> {
        let mut begin = 0;
        for class in 0..self.classes() {
            let here = begin..begin + self.windows_in_class(class);
            begin = here.end;
            self.add_rows(&plan.order[here]);
        }
        let mut points = vec![[0; COORDINATES]; PORTION.min(plan.order.len())];
        for metric in METRICS {
            let mut begin = 0;
            for class in 0..self.classes() {
                let end = begin + self.windows_in_class(class);
                for first in (begin..end).step_by(PORTION) {
                    let here = first..end.min(first + PORTION);
                    let points = &mut points[..here.len()];
                    (plan.points)(metric as usize, first, points);
                    if !self.are_points_of(metric, &plan.order, here, points) {
                        return Err(Box::new(self.windows));
                    }
                    self.leaves[metric as usize].add_leaves(points);
                }
                self.end_class(class, metric);
                begin = end;
            }
        }
        Ok(self)
    }

    /// Plan of this index, for [`Index::from_plan`].
    pub fn plan(&self) -> Plan {
        let windows =
            || self.rows.iter().enumerate().flat_map(|(leaf, rows)| (0..BLOCK).map(move |i| (leaf, i, rows[i])));
        let windows = || windows().filter(|&(_, _, row)| row != NO_ROW);
        Plan {
            order: windows().map(|(_, _, row)| row).collect(),
            bases: [0, 1].map(|i| self.leaves[i].subspace().floats()),
            points: [0, 1].map(|m| windows().map(|(leaf, i, _)| self.leaves[m].point_in(leaf, i)).collect()),
        }
    }

    /// Memory of the index of this number of rows and classes, and at most while it is created: from a plan, or without
    /// one if the size of the largest class is given, bytes.
    pub(crate) fn bytes(rows: u64, classes: u64, largest_to_build: Option<u64>) -> u64 {
        let windows = rows.saturating_mul(size_of::<PointRow>() as u64);
        let of_row = 2 * size_of::<f32>() + size_of::<u32>();
        let leaves = (rows / BLOCK as u64).saturating_add(classes);
        let all = Leaves::bytes(leaves, classes)
            .saturating_mul(2)
            .saturating_add(leaves.saturating_mul(size_of::<[u32; BLOCK]>() as u64))
            .saturating_add(rows.saturating_mul(of_row as u64));
        let rest =
            largest_to_build.map_or(all, |rows| all.saturating_add(rows.saturating_mul(ROW_TO_BUILD)).max(TO_FIT));
        windows.saturating_add(rest)
    }

    /// An index without leaves, with capacity for them.
    fn new(windows: Windows, subspaces: [Subspace; 2]) -> Self {
        let classes = windows.classes.len();
        let leaves = (0..classes).map(|class| windows.of_class(class).count().div_ceil(BLOCK)).sum();
        Self {
            norms: METRICS.map(|metric| windows.norms(metric)),
            leaves: subspaces.map(|s| Leaves::new(s, leaves, classes)),
            rows: Vec::with_capacity(leaves),
            slots: vec![NO_ROW; windows.rows()],
            windows,
            candidates: None,
        }
    }

    /// Returns whether these are the points of the windows `here` of the order: some are compared, the lengths of all
    /// are checked.
    fn are_points_of(&self, metric: Metric, order: &[u32], here: Range<usize>, points: &[Point]) -> bool {
        let (subspace, norms) = (self.leaves[metric as usize].subspace(), &self.norms[metric as usize]);
        let (scale, stride) = (self.windows.scale(metric), stride_of(order.len()));
        let has_length = |row: u32, point: &Point| {
            let frames = self.windows.points::<LENGTH>(row as usize);
            let (expected, error) = subspace.squared_length(metric, frames, scale, norms[row as usize]);
            has_squared_length(point, expected, error)
        };
        here.zip(points).all(|(i, point)| {
            let row = order[i];
            has_length(row, point) && (i % stride != 0 || *point == self.point(row, metric))
        })
    }

    /// Quantised coordinates of the window that ends at a row.
    fn point(&self, row: u32, metric: Metric) -> Point {
        self.leaves[metric as usize].point(&self.windows.centred(row as usize, metric))
    }

    /// Adds the rows of a class; its leaves are then added for each metric.
    fn add_rows(&mut self, rows: &[u32]) {
        for rows in rows.chunks(BLOCK) {
            let mut leaf = [NO_ROW; BLOCK];
            leaf[..rows.len()].copy_from_slice(rows);
            for (i, row) in rows.iter().enumerate() {
                self.slots[*row as usize] = (self.rows.len() * BLOCK + i) as u32;
            }
            self.rows.push(leaf);
        }
    }

    /// Ends a class whose leaves have been added.
    fn end_class(&mut self, class: usize, metric: Metric) {
        let bounds = self.windows.bounds(class, metric, &self.norms[metric as usize]);
        let windows = self.windows_in_class(class);
        self.leaves[metric as usize].end_class(windows, bounds);
    }
}

/// About [`SAMPLES`] of these, evenly distributed.
fn sample<T>(of: &[T]) -> impl Iterator<Item = &T> {
    of.iter().step_by(stride_of(of.len()))
}

/// Step between two samples if there are about [`SAMPLES`] samples of `count` items.
fn stride_of(count: usize) -> usize {
    count.div_ceil(SAMPLES).max(1)
}

/// Returns whether `order` contains the ascending `rows` in any order.
fn is_permutation(order: &[u32], rows: &[u32]) -> bool {
    let mut seen = vec![false; rows.len()];
    order.len() == rows.len()
        && order.iter().all(|row| rows.binary_search(row).is_ok_and(|i| !std::mem::replace(&mut seen[i], true)))
}
