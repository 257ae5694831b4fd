//! Leaves: blocks of near windows of a class by one metric, each enclosed in a ball.
//!
//! Distances in a [subspace](Subspace) are lower bounds of the windows' distances, and are a metric themselves. So they
//! exclude whole leaves, whose centres are in blocks like the windows, and single windows of the other leaves.
//!
//! Bounds hold for the computed D, not only for the exact one: every rounding error is bounded, and NaN excludes nothing.

use super::block::{
    BLOCK, Block, ERROR, PER_METRE, Point, Probe, QUADS, QUANTISATION, SquaredDistances, complex_product, quantise,
};
use super::lanes::FloatLane;
use super::metric::CentredWindow;
use super::subspace::{COORDINATES, REAL, Subspace};
use crate::math::order::positive;
use std::ops::Range;

/// Bound on the rounding error of a computed D = |q|² + |p|² − 2 (h + t): a share of (length of the query) × (length of
/// the stored window before it is centred). h is a sum that rounds 2 s + 8 times for windows of s frames, and so is
/// each part of t: 2 ((2 s + 8) (1 + √2) + 5) · 2⁻²⁴.
fn product_rounding(frames: usize) -> f32 {
    (5 * (2 * frames + 8) + 10) as f32 / 16_777_216.0
}

/// A share of |q|² + |p|²: norms and the last sums round 8 times, and the result twice when it is compared.
const NORM_ROUNDING: f32 = 16.0 / 16_777_216.0;

/// Multiples of a mean at which windows are counted, to test whether the mean of the nearest exceeds it.
const LEVELS: [f32; 6] = [0.4, 0.7, 1.0, 1.3, 1.7, 2.2];

/// All leaves of a database by one metric, in the order of its windows.
#[derive(Clone, Debug)]
pub(super) struct Leaves {
    subspace: Subspace,
    /// One for each leaf.
    blocks: Vec<Block>,
    /// Greatest distance of a leaf's windows from its centre, in integers.
    radii: Vec<f32>,
    /// Centres of the leaves, sixteen in each block.
    centres: Vec<Block>,
    /// Centres of the leaves of the class that is being added.
    middles: Vec<Point>,
    classes: Vec<Class>,
}

/// Data shared by the leaves of a class.
#[derive(Clone, Debug)]
struct Class {
    leaves: Range<usize>,
    windows: usize,
    /// Blocks of centres.
    centres: Range<usize>,
    /// Bound on the error of a projection, metres.
    error: f32,
    bounds: Bounds,
}

/// Bounds that hold for all windows of a class.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    /// [`CentredWindow::scale`].
    pub(super) scale: f32,
    /// Greatest squared length, and greatest length before a window is centred, metres.
    pub(super) norm: f32,
    pub(super) uncentred_length: f32,
}

/// Conversion between a computed D and distances of integers, with error bounds, for a query in a class.
#[derive(Clone, Copy, Debug)]
pub(super) struct Margins {
    /// Bound on the error of a distance, in integers.
    slack: f32,
    /// Bound on the rounding error of a computed D, m².
    rounding: f32,
}

impl Margins {
    /// Distance in integers beyond which no window has a computed D of at most `threshold`.
    fn limit(self, threshold: f32) -> f32 {
        (threshold + self.rounding).sqrt() * PER_METRE + self.slack
    }

    /// Squared distances above which [`Block::squared_distances`] excludes windows, because their computed D exceeds
    /// `threshold`.
    pub(super) fn squared_limits(self, threshold: f32) -> [FloatLane; QUADS] {
        [[self.squared_limit(threshold); 4]; QUADS]
    }

    /// One of these limits.
    pub(super) fn squared_limit(self, threshold: f32) -> f32 {
        let limit = self.limit(threshold);
        limit * limit + ERROR
    }

    /// Bound on the rounding error of a computed D, m².
    pub(super) fn rounding(self) -> f32 {
        self.rounding
    }

    /// A lower bound of the computed D of windows at this distance (in integers) or farther.
    fn lower_bound(self, distance: f32) -> f32 {
        let metres = positive(distance - self.slack) / PER_METRE;
        metres * metres - self.rounding
    }
}

impl Leaves {
    /// Creates an empty structure with capacity for this number of leaves and classes.
    pub(super) fn new(subspace: Subspace, leaves: usize, classes: usize) -> Self {
        Self {
            subspace,
            blocks: Vec::with_capacity(leaves),
            radii: Vec::with_capacity(leaves),
            centres: Vec::with_capacity(leaves / BLOCK + classes),
            middles: Vec::new(),
            classes: Vec::new(),
        }
    }

    /// Memory of this number of leaves in this number of classes, bytes.
    pub(super) fn bytes(leaves: u64, classes: u64) -> u64 {
        let blocks = leaves.saturating_add(leaves / BLOCK as u64).saturating_add(classes);
        blocks.saturating_mul(size_of::<Block>() as u64).saturating_add(leaves.saturating_mul(4))
    }

    pub(super) fn subspace(&self) -> &Subspace {
        &self.subspace
    }

    /// Quantised coordinates of a window.
    pub(super) fn point(&self, window: &CentredWindow) -> Point {
        quantise(&self.subspace.project(window))
    }

    /// Adds leaves to the next class from the quantised coordinates of its windows. Every call but the last must fill
    /// whole leaves.
    pub(super) fn add_leaves(&mut self, points: &[Point]) {
        for members in points.chunks(BLOCK) {
            let (centre, block) = (centre(members), Block::new(members));
            let greatest = block.squared_distances(&Probe::new(&centre));
            let greatest = greatest.0.as_flattened()[..members.len()].iter().copied().fold(0.0, f32::max);
            self.radii.push((greatest + ERROR).sqrt());
            self.blocks.push(block);
            self.middles.push(centre);
        }
    }

    /// Ends a class of this number of windows, all of which have been added.
    pub(super) fn end_class(&mut self, windows: usize, bounds: Bounds) {
        let (leaves, centres) = (self.blocks.len() - self.middles.len(), self.centres.len());
        self.centres.extend(self.middles.chunks(BLOCK).map(Block::new));
        self.middles.clear();
        let (leaves, centres) = (leaves..self.blocks.len(), centres..self.centres.len());
        let error = self.subspace.greatest_error(bounds.norm, bounds.scale);
        self.classes.push(Class { leaves, windows, centres, error, bounds });
    }

    /// Quantised coordinates of a window of a leaf.
    pub(super) fn point_in(&self, leaf: usize, i: usize) -> Point {
        self.blocks[leaf].point(i)
    }

    /// Leaves of a class.
    pub(super) fn of_class(&self, class: usize) -> Range<usize> {
        self.classes[class].leaves.clone()
    }

    /// A window's point in the subspace, and a bound on its error in metres.
    pub(super) fn probe(&self, window: &CentredWindow) -> (Probe, f32) {
        let projection = self.subspace.project(window);
        (Probe::new(&quantise(&projection)), projection.error)
    }

    /// Margins for a window whose point has this error bound.
    pub(super) fn margins(&self, class: usize, window: &CentredWindow, error: f32) -> Margins {
        let class = &self.classes[class];
        Margins {
            slack: 2.0 * QUANTISATION + PER_METRE * (class.error + error),
            rounding: product_rounding(window.frames) * window.norm.sqrt() * class.bounds.uncentred_length
                + NORM_ROUNDING * (window.norm + class.bounds.norm),
        }
    }

    /// Finds the leaves of a class that may contain a window with a computed D of at most `threshold`, each with a
    /// lower bound of the D of its windows.
    pub(super) fn candidates(
        &self,
        class: usize,
        probe: &Probe,
        margins: Margins,
        threshold: f32,
        out: &mut Vec<(f32, usize)>,
    ) {
        for (first, squared_distances, mut bits) in self.leaves_within(class, probe, margins.limit(threshold)) {
            while bits != 0 {
                let i = bits.trailing_zeros() as usize;
                bits &= bits - 1;
                let distance = positive(squared_distances.0[i / 4][i % 4] - ERROR).sqrt() - self.radii[first + i];
                out.push((margins.lower_bound(distance), first + i));
            }
        }
    }

    /// Leaves of a class, sixteen at a time: the index of the first, the squared distances of their centres and, as
    /// bits, whether each may contain a window at a distance of at most `limit` in integers.
    fn leaves_within(
        &self,
        class: usize,
        probe: &Probe,
        limit: f32,
    ) -> impl Iterator<Item = (usize, SquaredDistances, u32)> {
        let class = &self.classes[class];
        class.leaves.clone().step_by(BLOCK).zip(&self.centres[class.centres.clone()]).map(move |(first, centres)| {
            let leaves = first..class.leaves.end.min(first + BLOCK);
            let mut limits = [[0.0; 4]; QUADS];
            for (l, r) in limits.as_flattened_mut().iter_mut().zip(&self.radii[leaves.clone()]) {
                *l = (limit + r) * (limit + r) + ERROR;
            }
            let squared_distances = centres.squared_distances(probe);
            (first, squared_distances, squared_distances.within(&limits) & ((1 << leaves.len()) - 1))
        })
    }

    /// Squared distance to the nearest centre of a class's leaves, m²; infinite without leaves.
    pub(super) fn nearest_centre(&self, class: usize, probe: &Probe) -> f32 {
        let Class { leaves, centres, .. } = &self.classes[class];
        let blocks = self.centres[centres.clone()].iter();
        let distances = blocks.flat_map(|block| block.squared_distances(probe).0).flatten().take(leaves.len());
        distances.fold(f32::INFINITY, f32::min) / (PER_METRE * PER_METRE)
    }

    /// Returns whether the mean of the `k` smallest computed D of a class certainly exceeds `mean`.
    ///
    /// If n of a class's windows have a D of at most t, k − n of its k nearest have a greater one. Summed over levels
    /// of t, each multiplied by its distance from the level below, this is a lower bound of the sum of their D.
    pub(super) fn mean_exceeds(&self, class: usize, probe: &Probe, margins: Margins, k: usize, mean: f32) -> bool {
        let nearest = k.min(self.classes[class].windows) as f32;
        let squares = LEVELS.map(|level| margins.squared_limits(level * mean));
        let mut counts = [0; LEVELS.len()];
        let exceeds = |counts: &[u32; LEVELS.len()]| {
            let (mut sum, mut below) = (0.0, 0.0);
            for (level, count) in LEVELS.iter().zip(counts) {
                sum += (level - below) * positive(nearest - *count as f32);
                below = *level;
            }
            sum > nearest
        };
        for (first, _, mut bits) in self.leaves_within(class, probe, margins.limit(LEVELS[LEVELS.len() - 1] * mean)) {
            while bits != 0 {
                let leaf = first + bits.trailing_zeros() as usize;
                bits &= bits - 1;
                let squared_distances = self.blocks[leaf].squared_distances(probe);
                for (count, limit) in counts.iter_mut().zip(&squares) {
                    *count += squared_distances.within(limit).count_ones();
                }
                if !exceeds(&counts) {
                    return false;
                }
            }
        }
        exceeds(&counts)
    }

    /// Squared distances of the windows of a leaf, in integers.
    #[inline]
    pub(super) fn squared_distances(&self, leaf: usize, probe: &Probe) -> SquaredDistances {
        self.blocks[leaf].squared_distances(probe)
    }

    /// Windows of a leaf that may have a computed D of at most the threshold of these limits, as bits.
    #[inline]
    pub(super) fn windows_within(&self, leaf: usize, probe: &Probe, limits: &[FloatLane; QUADS]) -> u32 {
        self.blocks[leaf].squared_distances(probe).within(limits)
    }
}

/// Mean of points, after all are given the phase of the first.
fn centre(members: &[Point]) -> Point {
    let mut sums = [0.0_f32; COORDINATES];
    for point in members {
        let [re, im] = complex_product(point, &members[0]).map(|v| v as f32);
        let size = (re * re + im * im).sqrt();
        let [cos, sin] = if size > 0.0 { [re / size, im / size] } else { [1.0, 0.0] };
        for (sum, v) in sums[..REAL].iter_mut().zip(point) {
            *sum += f32::from(*v);
        }
        for (sum, v) in sums[REAL..].chunks_exact_mut(2).zip(point[REAL..].chunks_exact(2)) {
            let [x, y] = [v[0], v[1]].map(f32::from);
            sum[0] += cos * x + sin * y;
            sum[1] += cos * y - sin * x;
        }
    }
    sums.map(|sum| (sum / members.len() as f32) as i16)
}
