//! Cubic curves through values at knots (`docs/methods/somn.md` §8).

use crate::math::interpolation::hermite_weights;

/// Interpolation between values.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Interpolation {
    /// Catmull-Rom: the slope at a knot is that between its neighbours.
    #[default]
    CatmullRom,
    /// Fritsch and Carlson, "Monotone Piecewise Cubic Interpolation", 1980: each piece stays between its two end values.
    Monotone,
}

/// A curve of `N` numbers from its first to its last knot.
#[derive(Clone, Debug)]
pub(super) struct Spline<const N: usize> {
    knots: Vec<f64>,
    values: Vec<[f64; N]>,
    slopes: Vec<[f64; N]>,
}

impl<const N: usize> Spline<N> {
    /// Creates a curve through values at ascending knots; there is at least one.
    pub(super) fn new(knots: &[f64], values: Vec<[f64; N]>, interpolation: Interpolation) -> Self {
        let last = knots.len() - 1;
        let between = |a: usize, b: usize, d: usize| (values[b][d] - values[a][d]) / (knots[b] - knots[a]);
        let slope = |k: usize, d: usize| match (k, interpolation) {
            _ if last == 0 => 0.0,
            (0, _) => between(0, 1, d),
            (k, _) if k == last => between(k - 1, k, d),
            (k, Interpolation::CatmullRom) => between(k - 1, k + 1, d),
            (k, Interpolation::Monotone) => {
                let [before, after] = [between(k - 1, k, d), between(k, k + 1, d)];
                if before * after <= 0.0 {
                    return 0.0;
                }
                let [a, b] = [knots[k] - knots[k - 1], knots[k + 1] - knots[k]];
                let [first, second] = [2.0 * b + a, b + 2.0 * a];
                (first + second) / (first / before + second / after)
            }
        };
        let slopes = (0..knots.len()).map(|k| std::array::from_fn(|d| slope(k, d))).collect();
        Self { knots: knots.to_vec(), values, slopes }
    }

    /// The numbers at a time, clamped to the ends.
    pub(super) fn at(&self, time: f64) -> [f64; N] {
        let next = self.knots.partition_point(|knot| *knot <= time);
        if next == 0 || next == self.knots.len() {
            return self.values[next.saturating_sub(1)];
        }
        let (a, b) = (next - 1, next);
        let length = self.knots[b] - self.knots[a];
        let t = (time - self.knots[a]) / length;
        let [from, leaving, to, arriving] = hermite_weights(t);
        let [leaving, arriving] = [leaving * length, arriving * length];
        std::array::from_fn(|d| {
            from * self.values[a][d]
                + to * self.values[b][d]
                + leaving * self.slopes[a][d]
                + arriving * self.slopes[b][d]
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn knots(steps: &[f64]) -> Vec<f64> {
        steps.iter().scan(0.0, |at, step| Some(std::mem::replace(at, *at + step))).collect()
    }

    proptest! {
        #[test]
        fn curves_go_through_their_values_without_a_corner(
            points in prop::collection::vec((0.1f64..2.0, -5.0f64..5.0), 1..8), monotone: bool,
        ) {
            let interpolation = if monotone { Interpolation::Monotone } else { Interpolation::CatmullRom };
            let knots = knots(&points.iter().map(|p| p.0).collect::<Vec<_>>());
            let spline = Spline::new(&knots, points.iter().map(|p| [p.1]).collect(), interpolation);
            for (knot, point) in knots.iter().zip(&points) {
                prop_assert!((spline.at(*knot)[0] - point.1).abs() < 1e-9);
            }
            for knot in knots.iter().skip(1).take(knots.len().saturating_sub(2)) {
                let slope = |from: f64| (spline.at(knot + from + 1e-6)[0] - spline.at(knot + from)[0]) / 1e-6;
                prop_assert!((slope(0.0) - slope(-1e-6)).abs() < 0.02);
            }
            prop_assert_eq!(spline.at(-1.0)[0], points[0].1);
            prop_assert_eq!(spline.at(100.0)[0], points[points.len() - 1].1);
        }

        #[test]
        fn monotone_curves_stay_between_their_values(points in prop::collection::vec((0.1f64..2.0, -5.0f64..5.0), 2..8)) {
            let knots = knots(&points.iter().map(|p| p.0).collect::<Vec<_>>());
            let spline = Spline::new(&knots, points.iter().map(|p| [p.1]).collect(), Interpolation::Monotone);
            for (k, pair) in points.windows(2).enumerate() {
                for i in 0..=20 {
                    let value = spline.at(knots[k] + (knots[k + 1] - knots[k]) * f64::from(i) / 20.0)[0];
                    prop_assert!(value >= pair[0].1.min(pair[1].1) - 1e-9 && value <= pair[0].1.max(pair[1].1) + 1e-9);
                }
            }
        }
    }

    #[test]
    fn catmull_and_rom_follow_a_parabola() {
        let knots = [0.0, 1.0, 2.0, 3.0];
        let spline = Spline::new(&knots, knots.map(|t| [t * t]).to_vec(), Interpolation::CatmullRom);
        assert!((spline.at(1.5)[0] - 2.25).abs() < 1e-12);
    }
}
