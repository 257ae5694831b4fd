//! All windows of a database, ready to be searched.

use super::block::{BLOCK, Probe, SquaredDistances};
#[cfg(feature = "baselines")]
use super::kd_trees::KdTrees;
use super::leaves::{Leaves, Margins};
use super::metric::{CentredWindow, LENGTH, MAX_WINDOW, Metric, QueryWindow, WINDOW};
use super::neighbours::{Neighbour, Neighbours};
use super::points::Feet;
use super::windows::Windows;
use crate::database::Database;
use crate::math::order::sort_pairs;
#[cfg(feature = "baselines")]
use std::num::NonZero;

/// All windows of a database, ready to be searched.
#[derive(Clone, Debug)]
pub struct Index {
    pub(super) windows: Windows,
    /// |y|² + |z|² of the window that ends at each row, for each metric; unused where none does.
    pub(super) norms: [Vec<f32>; 2],
    /// For each metric.
    pub(super) leaves: [Leaves; 2],
    /// Rows at which the windows of each leaf end; [`NO_ROW`] fills the last leaf of a class.
    pub(super) rows: Vec<[u32; BLOCK]>,
    /// Where each row's window stands in `rows`; [`NO_ROW`] where none ends.
    pub(super) slots: Vec<u32>,
    #[cfg(feature = "baselines")]
    pub(super) kd_trees: Option<KdTrees>,
}

pub(super) const NO_ROW: u32 = u32::MAX;

/// Working memory of a query; keep one per stream of queries.
#[derive(Clone, Debug, Default)]
pub struct Scratch {
    found: Neighbours,
    /// Which windows of each leaf have been compared, as bits.
    done: Vec<u16>,
    /// Leaves to be searched, each with a lower bound of the D of its windows.
    candidates: Vec<(f32, usize)>,
}

/// A window made ready for one index; see [`Index::prepare`].
#[derive(Clone, Copy, Debug)]
pub struct Query<'a> {
    metric: Metric,
    window: &'a CentredWindow,
    probe: Probe,
    /// Bound on the error of the probe, metres.
    error: f32,
}

impl Index {
    /// The windows of a database.
    pub fn build(db: &Database) -> Self {
        Self::with_window(db, WINDOW)
    }

    /// The windows of `length` frames; the nearest of 1 to [`MAX_WINDOW`] is taken.
    pub fn with_window(db: &Database, length: usize) -> Self {
        Self::fitted(Windows::new(db, length.clamp(1, MAX_WINDOW)))
    }

    /// The same windows, searched approximately: of each class only the `candidates` that a kd-tree finds nearest in 15
    /// dimensions are compared. Only queries by [`Metric::FullBody`] differ. Unlike the exact search, this allocates.
    #[cfg(feature = "baselines")]
    #[must_use]
    pub fn with_kd_trees(self, candidates: NonZero<usize>) -> Self {
        let trees = KdTrees::new(&self.windows, self.leaves[Metric::FullBody as usize].subspace(), candidates);
        Self { kd_trees: Some(trees), ..self }
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

    /// Positions of the feet at a row at which a window ends and at the two before it, oldest first, in the clip's frame of
    /// reference.
    pub(crate) fn last_feet(&self, row: usize) -> [Feet; 3] {
        self.windows.last_feet(row)
    }

    /// Working memory large enough for any search for `k` windows.
    pub fn scratch(&self, k: usize) -> Scratch {
        let greatest =
            self.leaves.iter().flat_map(|leaves| (0..self.classes()).map(|c| leaves.of_class(c).len())).max();
        Scratch {
            found: Neighbours::with_capacity(k),
            done: vec![0; self.rows.len()],
            candidates: Vec::with_capacity(greatest.unwrap_or(0)),
        }
    }

    /// Prepares a search for a window by a metric. The window is [`Index::window_length`] frames long.
    pub fn prepare<'a>(&self, window: &'a QueryWindow, metric: Metric) -> Query<'a> {
        let window = window.centred(metric);
        let (probe, error) = self.leaves[metric as usize].probe(window);
        Query { metric, window, probe, error }
    }

    /// The `k` windows of several classes together that are nearest by the query's metric; fewer if there are fewer.
    ///
    /// `out` may hold the result for the frame before, which makes the search faster; the result does not depend on it.
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
    /// `false` means unknown. It takes a fraction of the time of a search.
    ///
    /// # Panics
    /// If there is no such class.
    pub fn mean_exceeds(&self, query: &Query<'_>, class: usize, k: usize, mean: f32) -> bool {
        let leaves = &self.leaves[query.metric as usize];
        mean.is_finite() && leaves.mean_exceeds(class, &query.probe, self.margins(query, class), k, mean)
    }

    /// Error bounds for a query in a class.
    pub(super) fn margins(&self, query: &Query<'_>, class: usize) -> Margins {
        self.leaves[query.metric as usize].margins(class, query.window, query.error)
    }

    /// The leaves of a class that may hold a window with a D of at most `threshold`, each with a lower bound of its windows'.
    pub(super) fn leaves_within(&self, query: &Query<'_>, class: usize, threshold: f32, out: &mut Vec<(f32, usize)>) {
        let leaves = &self.leaves[query.metric as usize];
        leaves.candidates(class, &query.probe, self.margins(query, class), threshold, out);
    }

    /// Squared distances between the query and the windows of a leaf, in integers.
    #[inline]
    pub(super) fn squared_distances(&self, query: &Query<'_>, leaf: usize) -> SquaredDistances {
        self.leaves[query.metric as usize].squared_distances(leaf, &query.probe)
    }

    /// A rough estimate of the D of the nearest windows of a class, m², that costs little.
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
        #[cfg(feature = "baselines")]
        if let (Some(trees), Metric::FullBody) = (&self.kd_trees, query.metric) {
            out.begin(k);
            let leaves = &self.leaves[Metric::FullBody as usize];
            trees
                .for_each_candidate(leaves.subspace(), query.window, classes, |row| self.look_at::<S>(query, row, out));
            return;
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
            let margins = self.margins(query, class);
            candidates.clear();
            let mut threshold = found.threshold();
            leaves.candidates(class, &query.probe, margins, threshold, candidates);
            sort_pairs(candidates);
            let mut limits = margins.squared_limits(threshold);
            for &(least, leaf) in &*candidates {
                if least > threshold {
                    continue;
                }
                let mut windows = leaves.windows_within(leaf, &query.probe, &limits) & !u32::from(done[leaf]);
                while windows != 0 {
                    let i = windows.trailing_zeros() as usize;
                    windows &= windows - 1;
                    self.look_at::<S>(query, self.rows[leaf][i], found);
                }
                if found.threshold() < threshold {
                    threshold = found.threshold();
                    limits = margins.squared_limits(threshold);
                }
            }
        }
        std::mem::swap(found, out);
    }

    /// Compares the windows that are likely to be nearest: those one frame after the nearest of the frame before.
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
            // At the end of a clip, the neighbour itself.
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
    pub(super) fn distance<const S: usize>(&self, query: &Query<'_>, last: usize) -> f32 {
        let norm = self.norms[query.metric as usize][last];
        query.window.distance::<S>(query.metric, self.windows.points::<S>(last), norm)
    }
}
