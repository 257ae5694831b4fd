//! Dynamic time warping with limited slope (`docs/methods/mar.md` §4; Sakoe and Chiba 1978).
//!
//! Steps (1, 1), (1, s) and (s, 1) with s ≤ 3; the cost of a step is that of all cells that it crosses. The warp is the
//! piecewise linear function through the ends of the steps. Frames at the ends may be skipped without cost
//! ([`Ends::open_begin`], [`Ends::open_end`]) or at a cost ([`Ends::skip`]).

use super::warp::{Ends, Warp};

/// Greatest slope: one frame of a sequence corresponds to at most this many of the other.
pub(super) const MAX_SLOPE: usize = 3;
/// At most this part (a quarter) of the shorter sequence may be skipped at either end.
const SKIPPED_PART: usize = 4;

/// Cost of a cell that no warp reaches.
const UNREACHED: f32 = f32::INFINITY;
/// Steps by which a cell is reached.
const START: u8 = 0;
const DIAGONAL: u8 = 1;
/// `ALONG_A + s`: s frames of a for one of b. `ALONG_B + s`: one frame of a for s of b.
const ALONG_A: u8 = 2;
const ALONG_B: u8 = 8;

/// Dynamic time warping; the tables are reused.
#[derive(Clone, Debug, Default)]
pub(super) struct Dtw {
    local: Vec<f32>,
    total: Vec<f32>,
    step: Vec<u8>,
}

impl Dtw {
    /// Computes the warp of least cost from `n` frames of a to `m` frames of b, where `distance(i, j)` is the cost of
    /// matching frame i of a with frame j of b; not smoothed. `None` if the slope limit allows no warp.
    ///
    /// The warp's cost is that of its path, including skipped frames, divided by `n`.
    pub(super) fn warp(
        &mut self,
        n: usize,
        m: usize,
        ends: Ends,
        distance: impl Fn(usize, usize) -> f32,
    ) -> Option<Warp> {
        if n == 0 || m == 0 {
            return None;
        }
        // Frames of a are skipped by matching them with virtual frames beyond b's ends, each at the cost of a skip.
        // Frames of b are skipped by starting after them or ending before them.
        let (skip, beyond) = ends.skip.map_or((0.0, 0), |cost| (cost, n.min(m) / SKIPPED_PART));
        let skipped = |passed: usize, open: usize| skip * passed.saturating_sub(open.saturating_add(beyond)) as f32;
        let real = beyond..beyond + m;
        let m = m + 2 * beyond;
        let last_begin = ends.open_begin.saturating_add(2 * beyond).min(m - 1);
        let first_end = (m - 1).saturating_sub(ends.open_end.saturating_add(2 * beyond));
        self.local.clear();
        self.local.resize(n * m, UNREACHED);
        self.total.clear();
        self.total.resize(n * m, UNREACHED);
        self.step.clear();
        self.step.resize(n * m, START);
        for i in 0..n {
            let nodes = reachable(i, n, m, last_begin, first_end);
            // Steps also cross cells in which no step may end.
            for j in nodes.start.saturating_sub(MAX_SLOPE - 1)..(nodes.end + MAX_SLOPE - 1).min(m) {
                self.local[i * m + j] = if real.contains(&j) { distance(i, j - beyond) } else { skip };
            }
            for j in nodes {
                let start = if i == 0 && j <= last_begin { skipped(j, ends.open_begin) } else { UNREACHED };
                self.relax(i, j, m, start);
            }
        }
        let last_row = &self.total[(n - 1) * m..];
        let ends_at = |j: usize| (last_row[j] + skipped(m - 1 - j, ends.open_end), j);
        let (cost, end) = (first_end..m).map(ends_at).min_by(|a, b| a.0.total_cmp(&b.0))?;
        cost.is_finite().then(|| {
            let at = self.trace(n, m, end).into_iter().map(|at| at - beyond as f32);
            Warp { at: at.collect(), cost: cost / n as f32 }
        })
    }

    /// Finds the best step into cell (i, j), or starts there at a cost. Equal costs prefer the diagonal, then short steps.
    fn relax(&mut self, i: usize, j: usize, m: usize, start: f32) {
        let here = i * m + j;
        let local = self.local[here];
        let (mut best, mut step) = (start, START);
        if i > 0 && j > 0 {
            let mut consider = |before: f32, by: u8| {
                if before < best {
                    (best, step) = (before, by);
                }
            };
            consider(self.total[here - m - 1], DIAGONAL);
            let mut crossed = 0.0;
            for s in 2..=MAX_SLOPE.min(i) {
                crossed += self.local[here - (s - 1) * m];
                consider(self.total[here - s * m - 1] + crossed, ALONG_A + s as u8);
            }
            crossed = 0.0;
            for s in 2..=MAX_SLOPE.min(j) {
                crossed += self.local[here - (s - 1)];
                consider(self.total[here - m - s] + crossed, ALONG_B + s as u8);
            }
        }
        self.total[here] = best + local;
        self.step[here] = step;
    }

    /// Frame of b for every frame of a along the best path to (n − 1, end).
    fn trace(&self, n: usize, m: usize, end: usize) -> Vec<f32> {
        let mut at = vec![0.0; n];
        let (mut i, mut j) = (n - 1, end);
        loop {
            at[i] = j as f32;
            match self.step[i * m + j] {
                START => return at,
                DIAGONAL => (i, j) = (i - 1, j - 1),
                along_a if along_a < ALONG_B => {
                    let s = usize::from(along_a - ALONG_A);
                    for k in 1..s {
                        at[i - k] = j as f32 - k as f32 / s as f32;
                    }
                    (i, j) = (i - s, j - 1);
                }
                along_b => (i, j) = (i - 1, j - usize::from(along_b - ALONG_B)),
            }
        }
    }
}

/// Frames of b that frame i of a can reach within the slope limit, in a warp that starts at `last_begin` at the latest
/// and ends at `first_end` at the earliest.
fn reachable(i: usize, n: usize, m: usize, last_begin: usize, first_end: usize) -> std::ops::Range<usize> {
    let left = n - 1 - i;
    let low = i.div_ceil(MAX_SLOPE).max(first_end.saturating_sub(left * MAX_SLOPE));
    let high = (last_begin + i * MAX_SLOPE + 1).min(m.saturating_sub(left.div_ceil(MAX_SLOPE)));
    low..high.max(low)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::float_funcs::{cos, sin};
    use proptest::prelude::*;

    /// Two periods of a closed curve whose points are all different within a period.
    fn curve(t: f32) -> [f32; 2] {
        [sin(t) + 0.4 * cos(2.0 * t), cos(t) - 0.3 * sin(3.0 * t)]
    }

    fn distance(a: [f32; 2], b: [f32; 2]) -> f32 {
        (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1])
    }

    const CLOSED: Ends = Ends { open_begin: 0, open_end: 0, skip: None };

    #[test]
    fn a_planted_warp_is_recovered_to_a_frame() {
        let (n, m) = (60_usize, 75_usize);
        // Frame of b that corresponds to frame i of a: slope between 0.6 and 2.
        let planted = |i: f32| {
            let t = i / (n - 1) as f32;
            (t + 0.09 * sin(t * std::f32::consts::TAU)) * (m - 1) as f32
        };
        let b: Vec<[f32; 2]> = (0..m).map(|j| curve(6.0 * j as f32 / (m - 1) as f32)).collect();
        let a: Vec<[f32; 2]> = (0..n).map(|i| curve(6.0 * planted(i as f32) / (m - 1) as f32)).collect();
        let warp = Dtw::default().warp(n, m, CLOSED, |i, j| distance(a[i], b[j])).unwrap();
        for (i, at) in warp.at.iter().enumerate() {
            assert!((at - planted(i as f32)).abs() <= 1.0, "frame {i}: {at} for {}", planted(i as f32));
        }
    }

    #[test]
    fn open_ends_find_a_piece_in_the_whole() {
        let b: Vec<[f32; 2]> = (0..100).map(|j| curve(j as f32 * 0.06)).collect();
        let a: Vec<[f32; 2]> = b[37..70].to_vec();
        let open = Ends { open_begin: Ends::OPEN, open_end: Ends::OPEN, skip: None };
        let warp = Dtw::default().warp(a.len(), b.len(), open, |i, j| distance(a[i], b[j])).unwrap();
        assert_eq!((warp.at[0], warp.at[32], warp.cost), (37.0, 69.0, 0.0));
        let begin = Ends { open_begin: Ends::OPEN, open_end: 0, skip: None };
        let warp = Dtw::default().warp(a.len(), 70, begin, |i, j| distance(a[i], b[j])).unwrap();
        assert_eq!(warp.at[0], 37.0);
    }

    #[test]
    fn ends_are_skipped_where_that_costs_less_than_to_warp_them() {
        let b: Vec<[f32; 2]> = (0..60).map(|j| curve(j as f32 * 0.1)).collect();
        let a: Vec<[f32; 2]> = b[9..52].to_vec();
        let warp = |a: &[[f32; 2]], b: &[[f32; 2]], cost: f32| {
            let ends = Ends { skip: Some(cost), ..CLOSED };
            Dtw::default().warp(a.len(), b.len(), ends, |i, j| distance(a[i], b[j])).unwrap()
        };
        // Nine and eight frames of b, then of a, have no counterpart.
        let (short, long) = (warp(&a, &b, 1e-4), warp(&b, &a, 1e-4));
        assert_eq!((short.at[0], short.at[42]), (9.0, 51.0));
        assert_eq!((long.at[9], long.at[51]), (0.0, 42.0));
        assert!(long.at[8] < 0.0 && long.at[52] > 42.0);
        assert!((short.cost - 0.0017 / 43.0).abs() < 1e-6 && (long.cost - 0.0017 / 60.0).abs() < 1e-6);
        let met = warp(&a, &b, 1e3);
        assert_eq!((met.at[0], met.at[42]), (0.0, 59.0));
        assert_eq!(warp(&b[..20], &b[..20], 0.0).at[10], 10.0, "half is compared in any case");
    }

    #[test]
    fn beyond_the_slope_limit_there_is_no_warp() {
        let warp = |n, m| Dtw::default().warp(n, m, CLOSED, |_, _| 1.0);
        assert!(warp(10, 28).is_some() && warp(28, 10).is_some());
        assert!(warp(10, 29).is_none() && warp(29, 10).is_none());
        assert!(warp(0, 3).is_none() && warp(3, 0).is_none());
        assert_eq!(warp(1, 1).unwrap().at, [0.0]);
    }

    #[test]
    fn every_crossed_cell_is_charged() {
        // Constant cost: 10 → 19 frames needs one more cell than the diagonal for each frame gained.
        let warp = Dtw::default().warp(10, 19, CLOSED, |_, _| 1.0).unwrap();
        assert!((warp.cost - 1.9).abs() < 1e-6, "{}", warp.cost);
    }

    proptest! {
        #[test]
        fn warps_keep_the_ends_and_the_slope_limit(
            a in prop::collection::vec(-1.0f32..1.0, 2..40),
            b in prop::collection::vec(-1.0f32..1.0, 2..40),
        ) {
            let warp = Dtw::default().warp(a.len(), b.len(), CLOSED, |i, j| (a[i] - b[j]) * (a[i] - b[j]));
            let feasible = (b.len() - 1) <= 3 * (a.len() - 1) && (a.len() - 1) <= 3 * (b.len() - 1);
            prop_assert_eq!(warp.is_some(), feasible);
            if let Some(warp) = warp {
                prop_assert_eq!((warp.at[0], warp.at[a.len() - 1]), (0.0, (b.len() - 1) as f32));
                for (x, y) in warp.at.iter().zip(&warp.at[1..]) {
                    prop_assert!(y - x > 0.33 && y - x <= 3.0, "{:?}", warp.at);
                }
            }
        }

        /// Twelve joints that swing differently, under a smooth warp of slope 0.5 to 2.
        #[test]
        fn any_planted_smooth_warp_of_many_joints_is_recovered(
            bend in -0.07f32..0.07, second in -0.015f32..0.015, stretch in 0.8f32..1.25, seed in 0.0f32..6.0,
        ) {
            let n = 80_usize;
            let m = (n as f32 * stretch) as usize;
            let joint = |t: f32, j: usize| {
                let k = j as f32;
                sin(t * (1.0 + k % 3.0) + k + seed) + 0.4 * cos(2.0 * t + 0.7 * k)
            };
            let planted = |i: usize| {
                let t = i as f32 / (n - 1) as f32;
                let turn = std::f32::consts::TAU * t;
                (t + bend * sin(turn) + second * sin(2.0 * turn)) * (m - 1) as f32
            };
            let point = |at: f32| -> Vec<f32> { (0..12).map(|j| joint(7.0 * at / (m - 1) as f32, j)).collect() };
            let a: Vec<Vec<f32>> = (0..n).map(|i| point(planted(i))).collect();
            let b: Vec<Vec<f32>> = (0..m).map(|j| point(j as f32)).collect();
            let apart = |i: usize, j: usize| a[i].iter().zip(&b[j]).map(|(x, y)| (x - y) * (x - y)).sum::<f32>();
            let warp = Dtw::default().warp(n, m, CLOSED, apart).unwrap().smoothed(1.8);
            for (i, at) in warp.at.iter().enumerate() {
                prop_assert!((at - planted(i)).abs() <= 1.5, "frame {}: {} for {}", i, at, planted(i));
            }
        }
    }
}
