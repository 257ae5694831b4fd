//! Candidates from kd-trees: the usual approximate search, for comparison with the exact one.
//!
//! A kd-tree needs points with a Euclidean distance. A window's [coordinates](Index::coordinates) become
//! such a point if their phase, to which the metric is invariant, is fixed: here the first complex coordinate becomes a
//! positive number. Windows that are near only with another phase are missed, and so are those whose differences lie
//! outside the subspace. Therefore several candidates are taken from the tree and ordered by their true D.

use kiddo::{ImmutableKdTree, SquaredEuclidean};
use std::num::NonZero;
use std::sync::Arc;
use strut_core::search::{CandidateSource, Index};

/// Number of height coordinates, the first ones …
const HEIGHTS: usize = 8;
/// … and of coordinates on the ground, real and imaginary parts; the imaginary part of the first is always 0.
const GROUND: usize = 8;
/// Dimensions of the trees.
const DIMENSIONS: usize = HEIGHTS + GROUND - 1;

/// The same windows with approximate search: in each class only the `candidates` nearest windows of a kd-tree in 15
/// dimensions are compared. Unlike the exact search, this allocates.
#[must_use]
pub fn with_kd_trees(index: Index, candidates: NonZero<usize>) -> Index {
    let trees = KdTrees::new(&index, candidates);
    index.with_candidates(Arc::new(trees))
}

/// A tree for each class, by the full-body metric.
#[derive(Clone, Debug)]
struct KdTrees {
    candidates: NonZero<usize>,
    classes: Vec<Class>,
}

#[derive(Clone, Debug)]
struct Class {
    /// Rows at which the windows of the tree's items end.
    rows: Vec<u32>,
    /// `None` without windows.
    tree: Option<ImmutableKdTree<f32, DIMENSIONS>>,
}

impl KdTrees {
    /// Builds trees of all windows by their coordinates. A search returns this number of candidates.
    fn new(index: &Index, candidates: NonZero<usize>) -> Self {
        let class = |class| {
            let rows: Vec<u32> = index.windows_of_class(class).map(|row| row as u32).collect();
            let points: Vec<_> = rows.iter().map(|&row| aligned(&index.coordinates(row as usize))).collect();
            let tree = (!points.is_empty()).then(|| ImmutableKdTree::new_from_slice(&points));
            Class { rows, tree }
        };
        Self { candidates, classes: (0..index.classes()).map(class).collect() }
    }
}

impl CandidateSource for KdTrees {
    fn for_each_candidate(
        &self,
        coordinates: &[f32; Index::COORDINATES],
        classes: &[usize],
        visit: &mut dyn FnMut(u32),
    ) {
        let at = aligned(coordinates);
        for Class { rows, tree } in classes.iter().map(|&class| &self.classes[class]) {
            let candidates = tree.iter().flat_map(|t| t.nearest_n::<SquaredEuclidean>(&at, self.candidates));
            candidates.for_each(|c| visit(rows[c.item as usize]));
        }
    }
}

/// First coordinates, with the phase for which the first complex one is a positive number.
fn aligned(coordinates: &[f32; Index::COORDINATES]) -> [f32; DIMENSIONS] {
    let (real, complex) = coordinates.split_at(Index::REAL_COORDINATES);
    let (re, im) = (complex[0], complex[1]);
    let size = (re * re + im * im).sqrt();
    let [cos, sin] = if size > 0.0 { [re / size, im / size] } else { [1.0, 0.0] };
    let mut point = [0.0; DIMENSIONS];
    let (heights, ground) = point.split_at_mut(HEIGHTS);
    heights.copy_from_slice(&real[..HEIGHTS]);
    ground[0] = size;
    for (p, z) in ground[1..].chunks_exact_mut(2).zip(complex[2..].chunks_exact(2)) {
        p.copy_from_slice(&[cos * z[0] + sin * z[1], cos * z[1] - sin * z[0]]);
    }
    point
}
