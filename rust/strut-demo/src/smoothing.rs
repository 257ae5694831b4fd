//! Gaussian smoothing of sampled curves.

use strut_core::math::gaussian;

/// `count` samples smoothed by a Gaussian with a standard deviation in samples, at least 0.1. `at` also returns the
/// samples before the first and after the last.
pub(crate) fn gaussian_smoothed(count: usize, sigma: f32, at: impl Fn(isize) -> f32) -> Vec<f32> {
    let radius = (3.0 * sigma) as usize + 1;
    let weights: Vec<f32> = (0..=radius).map(|k| gaussian::weight(k as f32, sigma.max(0.1))).collect();
    let total = weights[0] + 2.0 * weights[1..].iter().sum::<f32>();
    (0..count as isize)
        .map(|i| {
            let pair = |k: usize| at(i + k as isize) + at(i - k as isize);
            (weights[0] * at(i) + (1..=radius).map(|k| weights[k] * pair(k)).sum::<f32>()) / total
        })
        .collect()
}
