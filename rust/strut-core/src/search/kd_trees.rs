//! Candidates from kd-trees: the usual approximate search, to compare the exact one with.
//!
//! A kd-tree needs points with a Euclidean distance. A window's coordinates in the [subspace](super::subspace) are one
//! once their phase, which the metric does not see, is chosen: here the first complex coordinate becomes a positive
//! number. Windows that a better turn would bring together are missed, and so are those whose differences lie outside
//! the coordinates; so many candidates are taken from the tree and ordered by their true D.

use super::metric::{CentredWindow, Metric};
use super::subspace::{Projection, REAL};
use super::{Index, Neighbours, Query};
use kiddo::{ImmutableKdTree, SquaredEuclidean};
use std::num::NonZero;

/// Coordinates of heights, the first ones …
const HEIGHTS: usize = 8;
/// … and of the ground plane, real and imaginary parts; the imaginary part of the first is always 0.
const GROUND: usize = 8;
/// Dimensions of the trees.
const DIMENSIONS: usize = HEIGHTS + GROUND - 1;

/// A tree for each class, by the full-body metric.
#[derive(Clone, Debug)]
pub(super) struct KdTrees {
    candidates: NonZero<usize>,
    classes: Vec<Class>,
}

#[derive(Clone, Debug)]
struct Class {
    /// Where the windows end that the items of the tree number.
    rows: Vec<u32>,
    /// `None` of no windows.
    tree: Option<ImmutableKdTree<f32, DIMENSIONS>>,
}

impl Index {
    /// The same windows, searched approximately: of each class only the `candidates` that a kd-tree finds nearest in 15
    /// dimensions are looked at. Only queries by [`Metric::FullBody`] differ. Unlike the exact search, this allocates.
    #[must_use]
    pub fn with_kd_trees(self, candidates: NonZero<usize>) -> Self {
        let class = |class| {
            let rows: Vec<u32> = self.windows.of_class(class).map(|row| row as u32).collect();
            let points: Vec<_> =
                rows.iter().map(|&r| self.place(&self.windows.centred(r as usize, Metric::FullBody))).collect();
            let tree = (!points.is_empty()).then(|| ImmutableKdTree::new_from_slice(&points));
            Class { rows, tree }
        };
        let classes = (0..self.classes()).map(class).collect();
        Self { kd_trees: Some(KdTrees { candidates, classes }), ..self }
    }

    /// [`Index::nearest`] among the candidates of kd-trees.
    pub(super) fn nearest_of_candidates<const S: usize>(
        &self,
        trees: &KdTrees,
        query: &Query<'_>,
        classes: &[usize],
        k: usize,
        out: &mut Neighbours,
    ) {
        let at = self.place(query.window);
        out.begin(k);
        for Class { rows, tree } in classes.iter().map(|&class| &trees.classes[class]) {
            let candidates = tree.iter().flat_map(|t| t.nearest_n::<SquaredEuclidean>(&at, trees.candidates));
            candidates.for_each(|c| self.look_at::<S>(query, rows[c.item as usize], out));
        }
    }

    /// Where a window lies in its tree.
    fn place(&self, window: &CentredWindow) -> [f32; DIMENSIONS] {
        aligned(&self.leaves[Metric::FullBody as usize].subspace().project(window))
    }
}

/// The first coordinates, in the phase that makes the first complex one a positive number.
fn aligned(projection: &Projection) -> [f32; DIMENSIONS] {
    let (real, complex) = projection.coordinates.split_at(REAL);
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
