//! Global autoregression: the regression of [`strut_core::transfer`]'s mixture, fitted once to all pairs instead of to the
//! neighbours of every frame. Xia et al. 2015, §7 show that it is too stiff for heterogeneous motion.
//!
//! yₜ = a xₜ₋₁ + b yₜ₋₁ + c xₜ + d for each degree of freedom, by ridge λ·N on standardised variables with |b| ≤ 0.9.
//! All input frames have the same duration, so the same regression of log durations reduces to their mean, and the
//! output has a constant tempo.

use super::pairs::Pairs;
use strut_core::math::float_funcs::exp;
use strut_core::pose_vector::{DOFS, PoseRow, ROW};
use strut_core::transfer::MAX_FEEDBACK;
use strut_core::transfer::{PredictedFrame, Predictor, PredictorInput};

/// Global autoregression.
#[derive(Clone, Debug)]
pub(super) struct GlobalAr {
    /// [a, b, c, d] of each degree of freedom.
    coefficients: Vec<[f64; 4]>,
    step_secs: f32,
}

impl GlobalAr {
    /// Fits all pairs; `lambda` is the ridge as a share of their number, in units of the database's variances.
    pub(super) fn train(pairs: &Pairs<'_>, lambda: f64) -> Self {
        let (x, y) = (&pairs.inputs, &pairs.targets);
        let sigma = pairs.catalogue.sigma();
        let coefficients = (0..DOFS)
            .map(|d| {
                let samples = pairs.rows().map(|t| {
                    let [x0, y0, x1, y1] = [x[t - 1][d], y[t - 1][d], x[t][d], y[t][d]].map(f64::from);
                    ([x0, y0, x1], y1)
                });
                fit(samples, lambda * f64::from(sigma[d]) * f64::from(sigma[d]))
            })
            .collect();
        let count = pairs.rows().count().max(1) as f64;
        let log_duration = pairs.rows().map(|t| pairs.log_duration(t)).sum::<f64>() / count;
        Self { coefficients, step_secs: exp(log_duration as f32) / pairs.catalogue.rate_hz }
    }
}

/// Computes the [a, b, c, d] that minimise Σ (a u₀ + b u₁ + c u₂ + d − y)² + `ridge`·N·(a² + b² + c²) subject to |b| ≤
/// [`MAX_FEEDBACK`]. Zero without samples.
fn fit(samples: impl Iterator<Item = ([f64; 3], f64)> + Clone, ridge: f64) -> [f64; 4] {
    let mut mean = [0.0; 4];
    let mut n = 0.0;
    for (u, y) in samples.clone() {
        n += 1.0;
        mean.iter_mut().zip([u[0], u[1], u[2], y]).for_each(|(m, v)| *m += v);
    }
    if n == 0.0 {
        return [0.0; 4];
    }
    for m in &mut mean {
        *m /= n;
    }
    // Products of the centred [xₜ₋₁, yₜ₋₁, xₜ, yₜ].
    let mut s = [[0.0; 4]; 4];
    for (u, y) in samples {
        let v = [u[0] - mean[0], u[1] - mean[1], u[2] - mean[2], y - mean[3]];
        for i in 0..4 {
            for j in 0..4 {
                s[i][j] += v[i] * v[j];
            }
        }
    }
    for (i, row) in s.iter_mut().enumerate().take(3) {
        row[i] += (ridge * n).max(f64::MIN_POSITIVE);
    }
    // As in the local regression: b first (by the Schur complement of the input's part), limited, then the others.
    let determinant = s[0][0] * s[2][2] - s[0][2] * s[0][2];
    let solve = |p: f64, c: f64| ((s[2][2] * p - s[0][2] * c) / determinant, (s[0][0] * c - s[0][2] * p) / determinant);
    let (p, c) = solve(s[0][1], s[2][1]);
    let schur = s[1][1] - (s[0][1] * p + s[2][1] * c);
    let limit = f64::from(MAX_FEEDBACK);
    let b = ((s[1][3] - (s[0][3] * p + s[2][3] * c)) / schur).clamp(-limit, limit);
    let (a, c) = solve(s[0][3] - b * s[0][1], s[2][3] - b * s[2][1]);
    [a, b, c, mean[3] - a * mean[0] - b * mean[1] - c * mean[2]]
}

impl Predictor for GlobalAr {
    fn memory_len(&self) -> usize {
        0
    }

    fn start(&self, _memory: &mut [f64], _past: &[PoseRow]) {}

    fn predict(&self, _memory: &mut [f64], now: PredictorInput<'_>) -> PredictedFrame {
        let mut output = [0.0; ROW];
        for (d, [a, b, c, offset]) in self.coefficients.iter().enumerate() {
            let [x0, y0, x1] = [now.previous_input[d], now.previous_output[d], now.input[d]].map(f64::from);
            output[d] = (a * x0 + b * y0 + c * x1 + offset) as f32;
        }
        PredictedFrame { output, step_secs: self.step_secs }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixtures::noise;
    use proptest::prelude::*;

    /// Samples of yₜ = a xₜ₋₁ + b yₜ₋₁ + c xₜ + d on random x.
    fn planted(seed: u32, [a, b, c, d]: [f64; 4]) -> Vec<([f64; 3], f64)> {
        let x: Vec<f64> = noise(seed).take(300).collect();
        let mut y = 0.3;
        x.windows(2)
            .map(|x| {
                let before = y;
                y = a * x[0] + b * before + c * x[1] + d;
                ([x[0], before, x[1]], y)
            })
            .collect()
    }

    proptest! {
        #[test]
        fn planted_coefficients_are_recovered(
            seed in 0u32..1 << 30, a in -0.5f64..0.5, b in -0.85f64..0.85, c in -1.0f64..1.0, d in -1.0f64..1.0,
        ) {
            let found = fit(planted(seed, [a, b, c, d]).into_iter(), 1e-12);
            for (f, e) in found.iter().zip([a, b, c, d]) {
                prop_assert!((f - e).abs() < 1e-6, "{found:?}");
            }
        }
    }

    #[test]
    fn feedback_is_limited_and_nothing_gives_nothing() {
        let [_, b, ..] = fit(planted(3, [0.2, 0.97, 0.4, 0.0]).into_iter(), 1e-12);
        assert_eq!(b, f64::from(MAX_FEEDBACK));
        assert_eq!(fit(std::iter::empty(), 0.1), [0.0; 4]);
    }
}
