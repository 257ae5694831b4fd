//! Smooth functions of the gait phase, which repeats every stride.

use crate::smoothing::gaussian_smoothed;
use strut_core::math::interpolation::{hermite_weights, monotone_slope};

/// Samples of a tabulated cycle.
const SAMPLES: usize = 256;

/// A function of phase with period 1, tabulated and interpolated by a uniform cubic B-spline, so that
/// value, slope and curvature are continuous.
#[derive(Clone, Debug)]
pub(crate) struct PeriodicCurve {
    samples: Vec<f32>,
}

impl PeriodicCurve {
    /// Curve through `knots` (phase in [0, 1) ascending, value): shape-preserving cubic interpolation (Fritsch and
    /// Butland 1984), so that the curve is flat between two equal knots, then smoothed by a Gaussian of standard
    /// deviation `softness` cycles, which rounds its corners.
    pub(crate) fn through(knots: &[(f32, f32)], softness: f32) -> Self {
        let sharp: Vec<f32> = (0..SAMPLES).map(|i| interpolate(knots, i as f32 / SAMPLES as f32)).collect();
        let at = |i: isize| sharp[i.rem_euclid(SAMPLES as isize) as usize];
        Self { samples: gaussian_smoothed(SAMPLES, softness * SAMPLES as f32, at) }
    }

    /// Value at a phase, taken modulo 1.
    pub(crate) fn at(&self, phase: f32) -> f32 {
        let x = (phase - phase.floor()) * SAMPLES as f32;
        let i = x as usize;
        let s = |k: usize| self.samples[(i + SAMPLES + k - 1) % SAMPLES];
        b_spline([s(0), s(1), s(2), s(3)], x - i as f32)
    }
}

/// Uniform cubic B-spline with four control values, `t` in [0, 1] between the middle two.
pub(crate) fn b_spline(c: [f32; 4], t: f32) -> f32 {
    let u = 1.0 - t;
    let (t2, u2) = (t * t, u * u);
    (c[0] * u2 * u + c[1] * (4.0 - 6.0 * t2 + 3.0 * t2 * t) + c[2] * (4.0 - 6.0 * u2 + 3.0 * u2 * u) + c[3] * t2 * t)
        / 6.0
}

fn interpolate(knots: &[(f32, f32)], phase: f32) -> f32 {
    let n = knots.len();
    // Knot `i` of the periodically repeated list; the index may be one period out of range on either side.
    let knot = |i: usize| {
        let (turns, i) = (i / n, i % n);
        (knots[i].0 + turns as f32 - 1.0, knots[i].1)
    };
    let next = (n..2 * n).find(|&i| knot(i).0 > phase).unwrap_or(2 * n);
    let [a, b, c, d] = [next - 2, next - 1, next, next + 1].map(knot);
    let secant = |p: (f32, f32), q: (f32, f32)| (q.1 - p.1) / (q.0 - p.0);
    let middle = secant(b, c);
    let (m0, m1) = (monotone_slope(secant(a, b), middle), monotone_slope(middle, secant(c, d)));
    let h = c.0 - b.0;
    let [from, leaving, to, arriving] = hermite_weights((phase - b.0) / h);
    b.1 * from + m0 * h * leaving + c.1 * to + m1 * h * arriving
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_curve_passes_near_its_knots_and_stays_flat_between_equal_ones() {
        let knots = [(0.0, 20.0), (0.1, 0.0), (0.35, 0.0), (0.6, -60.0), (0.9, 15.0)];
        let curve = PeriodicCurve::through(&knots, 0.008);
        for (phase, value) in knots {
            assert!((curve.at(phase) - value).abs() < 2.0, "{phase}: {}", curve.at(phase));
        }
        assert!((0..=10).all(|i| curve.at(0.15 + 0.015 * i as f32).abs() < 1e-3));
        assert_eq!(curve.at(0.25), curve.at(1.25));
        assert_eq!(curve.at(0.25), curve.at(-0.75));
    }

    #[test]
    fn smoothing_keeps_the_mean() {
        let knots = [(0.0, 1.0), (0.5, 3.0)];
        let mean = |c: &PeriodicCurve| (0..SAMPLES).map(|i| c.at(i as f32 / SAMPLES as f32)).sum::<f32>() / 256.0;
        assert!((mean(&PeriodicCurve::through(&knots, 0.1)) - 2.0).abs() < 1e-3);
    }
}
