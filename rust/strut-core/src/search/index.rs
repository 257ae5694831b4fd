//! Search index of all windows of a database.

use super::block::{BLOCK, Probe, SquaredDistances};
use super::leaves::{Leaves, Margins};
use super::metric::{CentredWindow, LENGTH, MAX_WINDOW, Metric, QueryWindow, WINDOW};
use super::neighbours::{Neighbour, Neighbours};
use super::points::Feet;
use super::subspace::{COORDINATES, REAL};
use super::windows::Windows;
use crate::database::Database;
use crate::math::order::sort_pairs;
use std::fmt::Debug;
use std::sync::Arc;

/// Search index of all windows of a database.
#[derive(Clone, Debug)]
pub struct Index {
    pub(super) windows: Windows,
    /// |y|² + |z|² of the window that ends at each row, for each metric; unused if none ends there.
    pub(super) norms: [Vec<f32>; 2],
    /// One for each metric.
    pub(super) leaves: [Leaves; 2],
    /// Rows at which the windows of each leaf end; [`NO_ROW`] pads the last leaf of a class.
    pub(super) rows: Vec<[u32; BLOCK]>,
    /// Position of each row's window in `rows`; [`NO_ROW`] if none ends at the row.
    pub(super) slots: Vec<u32>,
    /// Replaces the exact search by the full-body metric.
    pub(super) candidates: Option<Arc<dyn CandidateSource>>,
}

pub(super) const NO_ROW: u32 = u32::MAX;

/// An approximate search: chooses the windows that are compared with a query.
pub trait CandidateSource: Debug + Send + Sync {
    /// Calls `visit` with the rows at which the candidates of some classes end, for a query with these
    /// [coordinates](Index::coordinates).
    fn for_each_candidate(&self, coordinates: &[f32; COORDINATES], classes: &[usize], visit: &mut dyn FnMut(u32));
}

/// Working memory of a query; keep one for each stream of queries.
#[derive(Clone, Debug, Default)]
pub struct Scratch {
    found: Neighbours,
    /// Windows of each leaf that have been compared, as bits.
    done: Vec<u16>,
    /// Leaves to be searched, each with a lower bound of the D of its windows.
    candidates: Vec<(f32, usize)>,
}

/// A window prepared for one index; see [`Index::prepare`].
#[derive(Clone, Copy, Debug)]
pub struct Query<'a> {
    metric: Metric,
    window: &'a CentredWindow,
    probe: Probe,
    /// Bound on the error of the probe, metres.
    error: f32,
}

impl Index {
    /// Number of coordinates of a window.
    pub const COORDINATES: usize = COORDINATES;
    /// Number of real coordinates, which come first; the others are pairs of real and imaginary parts.
    pub const REAL_COORDINATES: usize = REAL;

    /// Builds the index of a database.
    pub fn build(db: &Database) -> Self {
        Self::with_window(db, WINDOW)
    }

    /// Builds an index of windows of `length` frames, clamped to 1 to [`MAX_WINDOW`].
    pub fn with_window(db: &Database, length: usize) -> Self {
        Self::fitted(Windows::new(db, length.clamp(1, MAX_WINDOW)))
    }

    /// The same windows with an approximate search: only the candidates of `source` are compared. Only queries by
    /// [`Metric::FullBody`] differ.
    #[must_use]
    pub fn with_candidates(self, source: Arc<dyn CandidateSource>) -> Self {
        Self { candidates: Some(source), ..self }
    }

    /// Coordinates of the window that ends at a row, by the full-body metric, metres. The first
    /// [`Index::REAL_COORDINATES`] are real; the others are real and imaginary parts of complex coordinates, whose common
    /// phase does not matter.
    ///
    /// # Panics
    /// If the row does not exist.
    pub fn coordinates(&self, row: usize) -> [f32; COORDINATES] {
        let subspace = self.leaves[Metric::FullBody as usize].subspace();
        subspace.project(&self.windows.centred(row, Metric::FullBody)).coordinates
    }

    /// Rows at which the windows of a class end, ascending.
    ///
    /// # Panics
    /// If the class does not exist.
    pub fn windows_of_class(&self, class: usize) -> impl Iterator<Item = usize> + '_ {
        self.windows.of_class(class)
    }

    /// Number of frames of a window.
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
    /// If the class does not exist.
    pub fn windows_in_class(&self, class: usize) -> usize {
        self.windows.of_class(class).count()
    }

    /// Positions of the feet at a row at which a window ends and at the two rows before it, oldest first, in the clip's
    /// frame of reference.
    pub(crate) fn last_feet(&self, row: usize) -> [Feet; 3] {
        self.windows.last_feet(row)
    }

    /// Creates working memory for any search for `k` windows.
    pub fn scratch(&self, k: usize) -> Scratch {
        let greatest =
            self.leaves.iter().flat_map(|leaves| (0..self.classes()).map(|c| leaves.of_class(c).len())).max();
        Scratch {
            found: Neighbours::with_capacity(k),
            done: vec![0; self.rows.len()],
            candidates: Vec::with_capacity(greatest.unwrap_or(0)),
        }
    }

    /// Prepares a search for a window by a metric. The window has [`Index::window_length`] frames.
    pub fn prepare<'a>(&self, window: &'a QueryWindow, metric: Metric) -> Query<'a> {
        let window = window.centred(metric);
        let (probe, error) = self.leaves[metric as usize].probe(window);
        Query { metric, window, probe, error }
    }

    /// Finds the `k` windows in several classes together that are nearest by the query's metric; fewer if there are fewer.
    ///
    /// `out` may contain the result for the previous frame, which makes the search faster; the result does not depend
    /// on it.
    ///
    /// # Panics
    /// If a class does not exist.
    pub fn nearest(&self, query: &Query<'_>, classes: &[usize], k: usize, scratch: &mut Scratch, out: &mut Neighbours) {
        if self.windows.length == WINDOW || LENGTH == WINDOW {
            self.nearest_sized::<WINDOW>(query, classes, k, scratch, out);
        } else {
            self.nearest_sized::<LENGTH>(query, classes, k, scratch, out);
        }
    }

    /// Returns whether the mean D of the `k` windows of a class that are nearest by the query's metric certainly
    /// exceeds `mean`; `false` means unknown. It takes a fraction of the time of a search.
    ///
    /// # Panics
    /// If the class does not exist.
    pub fn mean_exceeds(&self, query: &Query<'_>, class: usize, k: usize, mean: f32) -> bool {
        let leaves = &self.leaves[query.metric as usize];
        mean.is_finite() && leaves.mean_exceeds(class, &query.probe, self.margins(query, class), k, mean)
    }

    /// Error bounds for a query in a class.
    pub(super) fn margins(&self, query: &Query<'_>, class: usize) -> Margins {
        self.leaves[query.metric as usize].margins(class, query.window, query.error)
    }

    /// Finds the leaves of a class that may contain a window with a D of at most `threshold`, each with a lower bound
    /// of its windows' D.
    pub(super) fn leaves_within(&self, query: &Query<'_>, class: usize, threshold: f32, out: &mut Vec<(f32, usize)>) {
        let leaves = &self.leaves[query.metric as usize];
        leaves.candidates(class, &query.probe, self.margins(query, class), threshold, out);
    }

    /// Squared distances between the query and the windows of a leaf, in integers.
    #[inline]
    pub(super) fn squared_distances(&self, query: &Query<'_>, leaf: usize) -> SquaredDistances {
        self.leaves[query.metric as usize].squared_distances(leaf, &query.probe)
    }

    /// A rough estimate of the D of the nearest windows of a class, m², that is cheap to compute.
    ///
    /// # Panics
    /// If the class does not exist.
    pub fn rough_distance(&self, query: &Query<'_>, class: usize) -> f32 {
        self.leaves[query.metric as usize].nearest_centre(class, &query.probe)
    }

    /// Same as [`Index::nearest`], for windows of `S` frames.
    fn nearest_sized<const S: usize>(
        &self,
        query: &Query<'_>,
        classes: &[usize],
        k: usize,
        scratch: &mut Scratch,
        out: &mut Neighbours,
    ) {
        if let (Some(source), Metric::FullBody) = (&self.candidates, query.metric) {
            out.begin(k);
            let at = self.leaves[Metric::FullBody as usize].subspace().project(query.window).coordinates;
            source.for_each_candidate(&at, classes, &mut |row| self.look_at::<S>(query, row, out));
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

    /// Compares the windows that are likely to be nearest: the successors of the previous frame's nearest windows.
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
            // At the end of a clip the neighbour itself is used.
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
        // The last leaf of a class may be padded.
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
