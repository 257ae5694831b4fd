//! Exact search for the stored windows that resemble the last frames of the input.
//!
//! A window ends at a row and holds it and the rows before it in the same clip, [`WINDOW`] in all; the first
//! rows of a clip end no window. Rows are kept once, in a frame of reference of their clip that is rebuilt by
//! integrating the rows' velocities and heading rates, so that overlapping windows share them.

mod block;
#[cfg(any(test, feature = "offline"))]
mod brute_force;
#[cfg(feature = "offline")]
mod kd_trees;
mod lanes;
mod leaves;
mod metric;
mod neighbours;
mod order;
mod plan;
mod principal;
mod subspace;
mod windows;

pub(crate) use metric::{FEET_ROLES, Feet};
pub use metric::{JOINT_WEIGHTS, MAX_WINDOW, Metric, QueryWindow, WINDOW};
pub use neighbours::{Neighbour, Neighbours};
pub use plan::{Plan, PlanError};

use crate::database::Database;
use crate::math::order::sort_pairs;
use block::{BLOCK, Probe};
use leaves::Leaves;
use metric::{CentredWindow, LENGTH};
use windows::Windows;

/// All windows of a database, ready to be searched.
#[derive(Clone, Debug)]
pub struct Index {
    windows: Windows,
    /// |y|² + |z|² of the window that ends at each row, for each metric; unused where none does.
    norms: [Vec<f32>; 2],
    /// For each metric.
    leaves: [Leaves; 2],
    /// Rows at which the windows of each leaf end; [`NO_ROW`] fills the last leaf of a class.
    rows: Vec<[u32; BLOCK]>,
    /// Where each row's window stands in `rows`; [`NO_ROW`] where none ends.
    slots: Vec<u32>,
    #[cfg(feature = "offline")]
    kd_trees: Option<kd_trees::KdTrees>,
}

const NO_ROW: u32 = u32::MAX;

/// Working memory of a query; keep one per stream of queries.
#[derive(Clone, Debug, Default)]
pub struct Scratch {
    found: Neighbours,
    /// Which windows of each leaf have been looked at, as bits.
    done: Vec<u16>,
    /// Leaves to be looked at, each after the least D that it may hold.
    candidates: Vec<(f32, usize)>,
}

/// A window made ready for one index; see [`Index::prepare`].
#[derive(Clone, Copy, Debug)]
pub struct Query<'a> {
    metric: Metric,
    window: &'a CentredWindow,
    probe: Probe,
    /// How far the probe may be off, metres.
    error: f32,
}

impl Index {
    /// The windows of a database.
    pub fn build(db: &Database) -> Self {
        Self::with_window(db, WINDOW)
    }

    /// The windows of `length` frames; the nearest of 1 to [`MAX_WINDOW`] is taken.
    pub fn with_window(db: &Database, length: usize) -> Self {
        Self::planned(db, length.clamp(1, MAX_WINDOW))
    }

    /// Frames of a window.
    pub fn window_length(&self) -> usize {
        self.windows.length
    }

    /// Number of classes.
    pub fn classes(&self) -> usize {
        self.windows.classes.len()
    }

    /// Number of windows of a class.
    ///
    /// # Panics
    /// If there is no such class.
    pub fn windows_in_class(&self, class: usize) -> usize {
        self.windows.of_class(class).count()
    }

    /// Where the feet are at a row: seen from where the other rows of its clip are seen from.
    pub(crate) fn feet(&self, row: usize) -> Feet {
        self.windows.feet(row)
    }

    /// Working memory that no search for `k` windows outgrows.
    pub fn scratch(&self, k: usize) -> Scratch {
        let greatest =
            self.leaves.iter().flat_map(|leaves| (0..self.classes()).map(|c| leaves.of_class(c).len())).max();
        Scratch {
            found: Neighbours::with_capacity(k),
            done: vec![0; self.rows.len()],
            candidates: Vec::with_capacity(greatest.unwrap_or(0)),
        }
    }

    /// A window to be looked for by a metric. It is as long as [`Index::window_length`].
    pub fn prepare<'a>(&self, window: &'a QueryWindow, metric: Metric) -> Query<'a> {
        let window = window.centred(metric);
        let (probe, error) = self.leaves[metric as usize].probe(window);
        Query { metric, window, probe, error }
    }

    /// The `k` windows of several classes together that are nearest by the query's metric; fewer if there are fewer.
    ///
    /// What `out` holds beforehand is taken as the result for the frame before: if it is, the search is
    /// faster; the result does not depend on it.
    ///
    /// # Panics
    /// If there is no such class.
    pub fn nearest(&self, query: &Query<'_>, classes: &[usize], k: usize, scratch: &mut Scratch, out: &mut Neighbours) {
        if self.windows.length == WINDOW || LENGTH == WINDOW {
            self.nearest_sized::<WINDOW>(query, classes, k, scratch, out);
        } else {
            self.nearest_sized::<LENGTH>(query, classes, k, scratch, out);
        }
    }

    /// Whether the mean D of the `k` windows of a class that are nearest by the query's metric certainly exceeds `mean`;
    /// `false` says nothing. It takes a fraction of the time of finding them.
    ///
    /// # Panics
    /// If there is no such class.
    pub fn mean_exceeds(&self, query: &Query<'_>, class: usize, k: usize, mean: f32) -> bool {
        let leaves = &self.leaves[query.metric as usize];
        let margins = leaves.margins(class, query.window, query.error);
        mean.is_finite() && leaves.mean_exceeds(class, &query.probe, margins, k, mean)
    }

    /// Roughly the D of the nearest windows of a class, m²: what is known soonest about it.
    ///
    /// # Panics
    /// If there is no such class.
    pub fn rough_distance(&self, query: &Query<'_>, class: usize) -> f32 {
        self.leaves[query.metric as usize].nearest_centre(class, &query.probe)
    }

    /// [`Index::nearest`] with windows of `S` frames.
    fn nearest_sized<const S: usize>(
        &self,
        query: &Query<'_>,
        classes: &[usize],
        k: usize,
        scratch: &mut Scratch,
        out: &mut Neighbours,
    ) {
        #[cfg(feature = "offline")]
        if let (Some(trees), Metric::FullBody) = (&self.kd_trees, query.metric) {
            return self.nearest_of_candidates::<S>(trees, query, classes, k, out);
        }
        let Scratch { found, done, candidates } = scratch;
        let leaves = &self.leaves[query.metric as usize];
        found.begin(k);
        done.resize(self.rows.len(), 0);
        for &class in classes {
            done[leaves.of_class(class)].fill(0);
        }
        self.look_at_successors::<S>(query, classes, out.as_slice(), done, found);
        for &class in classes {
            let margins = leaves.margins(class, query.window, query.error);
            candidates.clear();
            leaves.candidates(class, &query.probe, margins, found.threshold(), candidates);
            sort_pairs(candidates);
            for &(least, leaf) in &*candidates {
                if least > found.threshold() {
                    break;
                }
                let within = leaves.windows_within(leaf, &query.probe, margins, found.threshold());
                let mut windows = within & !u32::from(done[leaf]);
                while windows != 0 {
                    let i = windows.trailing_zeros() as usize;
                    windows &= windows - 1;
                    self.look_at::<S>(query, self.rows[leaf][i], found);
                }
            }
        }
        std::mem::swap(found, out);
    }

    /// Looks at the windows that are likely to be nearest: one frame after those that were so in the frame before.
    fn look_at_successors<const S: usize>(
        &self,
        query: &Query<'_>,
        classes: &[usize],
        last: &[Neighbour],
        done: &mut [u16],
        found: &mut Neighbours,
    ) {
        let leaves = &self.leaves[query.metric as usize];
        let slot = |row: u32| self.slots.get(row as usize).copied().filter(|&s| s != NO_ROW);
        for n in last {
            // At the end of a clip the neighbour itself stands in.
            let Some(slot) = slot(n.row.saturating_add(1)).or_else(|| slot(n.row)) else { continue };
            let (leaf, i) = (slot as usize / BLOCK, slot as usize % BLOCK);
            let is_asked_for = classes.iter().any(|&c| leaves.of_class(c).contains(&leaf));
            if is_asked_for && done[leaf] & (1 << i) == 0 {
                done[leaf] |= 1 << i;
                self.look_at::<S>(query, self.rows[leaf][i], found);
            }
        }
    }

    #[inline]
    fn look_at<const S: usize>(&self, query: &Query<'_>, row: u32, found: &mut Neighbours) {
        // The last leaf of a class may not be full.
        if row != NO_ROW {
            found.offer(Neighbour { distance: self.distance::<S>(query, row as usize), row });
        }
    }

    /// D between the query and the window that ends at row `last`.
    #[inline]
    fn distance<const S: usize>(&self, query: &Query<'_>, last: usize) -> f32 {
        let (heights, ground) = self.windows.points::<S>(last);
        query.window.distance::<S>(query.metric, heights, ground, self.norms[query.metric as usize][last])
    }
}

#[cfg(test)]
mod tests;
