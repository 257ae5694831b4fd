//! What takes long to find out about an index, and does not change what it finds.

use super::block::{BLOCK, Point, is_within_bounds, quantise};
use super::leaves::Leaves;
use super::metric::{CentredWindow, Metric, WINDOW};
use super::order::arrange;
use super::subspace::{COORDINATES, Subspace};
use super::windows::Windows;
use super::{Index, NO_ROW};
use crate::database::Database;
use thiserror::Error;

/// Windows that the directions of a subspace are taken from, and that stored points are compared with.
const SAMPLES: usize = 512;

const METRICS: [Metric; 2] = [Metric::FullBody, Metric::LowerBody];

/// The parts of an [`Index`] that a file may hold. How fast a search is depends on them. What it finds does not depend on
/// the order and the bases, so that they need not be trusted; the points are compared with the database here and there.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// The rows at which windows end, class by class; within a class near ones together.
    pub order: Vec<u32>,
    /// For the full-body and the lower-body metric the mean and the principal directions of windows, in lanes:
    /// [`Plan::BASIS_LENGTH`] numbers each.
    pub bases: [Vec<f32>; 2],
    /// For both metrics where the windows lie by these directions, quantised, in this order.
    pub points: [Vec<[i16; Plan::COORDINATES]>; 2],
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
    /// The points are not those of the database's windows.
    #[error("its points are not those of the database's windows")]
    Points,
}

impl Plan {
    /// Changes whenever what [`Plan::bases`] or [`Plan::points`] mean does.
    pub const VERSION: u32 = 2;
    /// Numbers of each of [`Plan::bases`].
    pub const BASIS_LENGTH: usize = Subspace::float_count(WINDOW);
    /// Numbers of each of [`Plan::points`].
    pub const COORDINATES: usize = COORDINATES;
}

impl Index {
    /// The windows of `length` frames, 1 to [`super::MAX_WINDOW`], by a plan that is made for them.
    pub(super) fn planned(db: &Database, length: usize) -> Self {
        let windows = Windows::new(db, length);
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
            index.add_points(class, Metric::FullBody, &points);
            index.add_points(class, Metric::LowerBody, &lower);
        }
        index
    }

    /// The windows of [`WINDOW`] frames by a plan: the same as [`Index::build`] makes, sooner. The database's point clouds
    /// are forgotten, as the index takes their place.
    ///
    /// # Errors
    /// [`PlanError`] if the plan is not one for this database, which then stays as it is.
    pub fn from_plan(db: &mut Database, plan: Plan) -> Result<Self, PlanError> {
        let Plan { order, bases, points } = plan;
        let subspaces = METRICS.map(|metric| Subspace::from_floats(&bases[metric as usize], WINDOW, metric));
        let [Some(full), Some(lower)] = subspaces else {
            return Err(PlanError::Basis);
        };
        let (windows, subspaces) = (Windows::new(db, WINDOW), [full, lower]);
        let mut rest = &order[..];
        for class in 0..windows.classes.len() {
            let rows: Vec<u32> = windows.of_class(class).map(|row| row as u32).collect();
            let (here, others) = rest.split_at_checked(rows.len()).ok_or(PlanError::Order)?;
            if !is_permutation(here, &rows) {
                return Err(PlanError::Order);
            }
            rest = others;
        }
        if !rest.is_empty() {
            return Err(PlanError::Order);
        }
        for ((metric, points), subspace) in METRICS.into_iter().zip(&points).zip(&subspaces) {
            let agrees = |(row, found): (&u32, &Point)| {
                *found == quantise(&subspace.project(&windows.centred(*row as usize, metric)))
            };
            let all_agree = points.len() == order.len() && sample(&order).zip(sample(points)).all(agrees);
            if !all_agree || !points.iter().all(is_within_bounds) {
                return Err(PlanError::Points);
            }
        }

        db.forget_point_clouds();
        let mut index = Self::new(windows, subspaces);
        let mut begin = 0;
        for class in 0..index.classes() {
            let here = begin..begin + index.windows_in_class(class);
            begin = here.end;
            index.add_rows(&order[here.clone()]);
            for (metric, points) in METRICS.into_iter().zip(&points) {
                index.add_points(class, metric, &points[here.clone()]);
            }
        }
        Ok(index)
    }

    /// What [`Index::from_plan`] takes.
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

    /// With room for its leaves.
    fn new(windows: Windows, subspaces: [Subspace; 2]) -> Self {
        let classes = 0..windows.classes.len();
        let leaves = classes.map(|class| windows.of_class(class).count().div_ceil(BLOCK)).sum();
        Self {
            norms: METRICS.map(|metric| windows.norms(metric)),
            leaves: subspaces.map(|s| Leaves::new(s, leaves)),
            rows: Vec::with_capacity(leaves),
            slots: vec![NO_ROW; windows.rows()],
            windows,
            #[cfg(feature = "offline")]
            kd_trees: None,
        }
    }

    /// The integers of the window that ends at a row.
    fn point(&self, row: u32, metric: Metric) -> Point {
        self.leaves[metric as usize].point(&self.windows.centred(row as usize, metric))
    }

    /// Adds the rows of a class, …
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

    /// … and the integers of its windows by a metric, in the same order.
    fn add_points(&mut self, class: usize, metric: Metric, points: &[Point]) {
        let bounds = self.windows.bounds(class, metric, &self.norms[metric as usize]);
        self.leaves[metric as usize].add_class(points, bounds);
    }
}

/// About [`SAMPLES`] of these, evenly spread.
fn sample<T>(of: &[T]) -> impl Iterator<Item = &T> {
    of.iter().step_by(of.len().div_ceil(SAMPLES).max(1))
}

/// Whether `order` holds the numbers of the ascending `rows` in any order.
fn is_permutation(order: &[u32], rows: &[u32]) -> bool {
    let mut seen = vec![false; rows.len()];
    order.len() == rows.len()
        && order.iter().all(|row| rows.binary_search(row).is_ok_and(|i| !std::mem::replace(&mut seen[i], true)))
}
