//! Exact nearest-neighbour search for the row whose features are nearest to a query: bounding boxes around successive
//! rows exclude most rows.

use super::features::{FEATURES, Features, TRAJECTORY_AT};

/// Number of rows in a small and in a large box: successive rows are near each other.
const SMALL: usize = 16;
const LARGE: usize = 64;
/// Number of partial sums of a distance, added at the end: they fill the SIMD lanes of a register.
const SUMS: usize = 4;

/// Result of a search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Match {
    /// The row.
    pub(super) row: usize,
    /// Squared distance of its features, plus the extra cost.
    pub(super) cost: f32,
}

/// The minimum and maximum of every feature over some rows.
#[derive(Clone, Debug)]
struct Bounds {
    low: Features,
    high: Features,
}

/// Rows with their bounding boxes.
#[derive(Clone, Debug)]
pub(super) struct Matching {
    rows: Vec<Features>,
    small: Vec<Bounds>,
    large: Vec<Bounds>,
}

impl Matching {
    /// Builds the boxes of these rows.
    pub(super) fn new(rows: Vec<Features>) -> Self {
        let boxes = |size: usize| rows.chunks(size).map(Bounds::of).collect();
        Self { small: boxes(SMALL), large: boxes(LARGE), rows }
    }

    /// The features of a row.
    pub(super) fn row(&self, row: usize) -> &Features {
        &self.rows[row]
    }

    /// Returns the row of the least cost, `extra` included, which is at least 0, or `None` for a row that is not
    /// allowed. The first of several equal rows is returned; `None` if no row is allowed.
    pub(super) fn nearest(&self, query: &Features, extra: impl Fn(usize) -> Option<f32>) -> Option<Match> {
        let mut best: Option<Match> = None;
        for (l, large) in self.large.iter().enumerate() {
            if !large.may_beat(best, query) {
                continue;
            }
            let small = LARGE / SMALL * l..(LARGE / SMALL * (l + 1)).min(self.small.len());
            for s in small {
                if !self.small[s].may_beat(best, query) {
                    continue;
                }
                for row in SMALL * s..(SMALL * (s + 1)).min(self.rows.len()) {
                    let cost = self.cost_of(query, row);
                    if best.is_some_and(|best| cost >= best.cost) {
                        continue;
                    }
                    let Some(cost) = extra(row).map(|extra| cost + extra) else { continue };
                    if best.is_none_or(|best| cost < best.cost) {
                        best = Some(Match { row, cost });
                    }
                }
            }
        }
        best
    }

    /// The cost of a row for a query.
    pub(super) fn cost_of(&self, query: &Features, row: usize) -> f32 {
        let features = &self.rows[row];
        squared(|i| query[i] - features[i])
    }

    /// Squared distance of the bodies of two rows; their trajectories are ignored.
    pub(super) fn body_distance(&self, row: usize, other: usize) -> f32 {
        let (a, b) = (&self.rows[row][..TRAJECTORY_AT], &self.rows[other][..TRAJECTORY_AT]);
        a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum()
    }
}

impl Bounds {
    fn of(rows: &[Features]) -> Self {
        let least = |i: usize| rows.iter().map(|row| row[i]).fold(f32::INFINITY, f32::min);
        let greatest = |i: usize| rows.iter().map(|row| row[i]).fold(f32::NEG_INFINITY, f32::max);
        Self { low: std::array::from_fn(least), high: std::array::from_fn(greatest) }
    }

    /// Whether a row of the box may cost less than the best row found. Differences, squares and sums are rounded
    /// monotonically and in the same order as a row's, so the bound holds bit for bit.
    fn may_beat(&self, best: Option<Match>, query: &Features) -> bool {
        let Some(best) = best else { return true };
        let outside = squared(|i| {
            let (below, above) = (self.low[i] - query[i], query[i] - self.high[i]);
            // Compiles to a select instruction; `f32::max` would test for NaN.
            let gap = if below > above { below } else { above };
            if gap > 0.0 { gap } else { 0.0 }
        });
        outside < best.cost
    }
}

/// The sum of the squares of all feature differences.
#[inline]
fn squared(difference: impl Fn(usize) -> f32) -> f32 {
    let mut sums = [0.0; SUMS];
    for first in (0..FEATURES).step_by(SUMS) {
        for (lane, sum) in sums.iter_mut().enumerate() {
            let d = difference(first + lane);
            *sum += d * d;
        }
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::SplitMix64;
    use proptest::prelude::*;

    /// Rows of a random walk: like motion, each is near the one before.
    fn wander(n: usize, seed: u64) -> Vec<Features> {
        let mut random = SplitMix64::new(seed);
        let mut next = || random.share() - 0.5;
        let mut row = [0.0; FEATURES];
        (0..n)
            .map(|_| {
                row = std::array::from_fn(|i| row[i] + 0.3 * next());
                row
            })
            .collect()
    }

    fn by_brute_force(of: &Matching, query: &Features, extra: impl Fn(usize) -> Option<f32>) -> Option<Match> {
        let costs = |row: usize| Some(Match { row, cost: of.cost_of(query, row) + extra(row)? });
        let all = (0..of.rows.len()).filter_map(costs);
        all.reduce(|best, other| if other.cost < best.cost { other } else { best })
    }

    proptest! {
        #[test]
        fn finds_what_a_look_at_every_row_finds(
            n in 1_usize..700, seed: u64, at in 0_usize..700, skipped in 0_usize..80,
        ) {
            let rows = wander(n, seed);
            let of = Matching::new(rows.clone());
            let query = rows[at % n].map(|v| v + 0.01);
            let dearer = |row: usize| if row % 90 < 40 { 0.7 } else { 0.0 };
            let extra = |row: usize| (row.abs_diff(at % n) >= skipped).then(|| dearer(row));
            prop_assert_eq!(of.nearest(&query, extra), by_brute_force(&of, &query, extra));
        }
    }

    #[test]
    fn takes_the_first_of_several() {
        let of = Matching::new(vec![[1.0; FEATURES]; 200]);
        assert_eq!(
            of.nearest(&[0.0; FEATURES], |row| (row >= 70).then_some(0.0)),
            Some(Match { row: 70, cost: FEATURES as f32 })
        );
    }

    #[test]
    fn finds_nothing_where_nothing_is_allowed() {
        let of = Matching::new(wander(100, 1));
        assert_eq!(of.nearest(&[0.0; FEATURES], |_| None), None);
    }
}
