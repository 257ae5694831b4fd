//! Gaussian process regression with inducing points (subset of regressors; Quiñonero-Candela and Rasmussen,
//! "A Unifying View of Sparse Approximate Gaussian Process Regression", 2005, §5).
//!
//! With the kernel k(a, b) = exp(−|a − b|² / 2ℓ²), noise σ² relative to the signal, Z the inducing points and X the
//! samples, the mean at a is k(a, Z) w with `(σ² K_ZZ + K_ZX K_XZ) w = K_ZX Y`. Far from all points it approaches zero,
//! the mean of the prior.

use super::products::dot;
use nalgebra::{Cholesky, DMatrix};
use strut_core::math::float_funcs::double::exp;

/// Added to the diagonal of `K_ZZ`, which would be singular for points that are close together.
const JITTER: f64 = 1e-6;

/// Number of samples whose products are summed at a time: their kernel values stay in the cache.
const BLOCK: usize = 512;

/// Hyperparameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Kernel {
    /// ℓ, in units of the inputs.
    pub(super) length: f64,
    /// σ², as a share of the signal's variance.
    pub(super) noise: f64,
}

impl Kernel {
    fn value(&self, a: &[f64], b: &[f64]) -> f64 {
        let squared: f64 = a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum();
        exp(-0.5 * squared / (self.length * self.length))
    }
}

/// Part of a process that depends on the samples' inputs only.
#[derive(Clone, Debug)]
pub(super) struct Basis {
    kernel: Kernel,
    width: usize,
    /// Z, the points in sequence.
    points: Vec<f64>,
    /// `K_ZX`: a row for each point.
    values: Vec<f64>,
    cholesky: Cholesky<f64, nalgebra::Dyn>,
}

impl Basis {
    /// Creates the basis for samples of `width` numbers each, stored in sequence in `inputs`, and inducing points in
    /// the same form; `None` if there is no point or a value is not finite.
    pub(super) fn new(kernel: Kernel, width: usize, inputs: &[f64], points: Vec<f64>) -> Option<Self> {
        let point = |i: usize| &points[i * width..(i + 1) * width];
        let count = points.len() / width;
        if count == 0 {
            return None;
        }
        let values: Vec<f64> =
            (0..count).flat_map(|i| inputs.chunks_exact(width).map(move |x| kernel.value(point(i), x))).collect();
        let samples = inputs.len() / width;
        let mut gram = products(&values, &values, samples, true);
        for j in 0..count {
            for i in j..count {
                gram[(i, j)] += kernel.noise * kernel.value(point(i), point(j));
            }
            gram[(j, j)] += JITTER * kernel.noise.max(JITTER) * samples.max(1) as f64;
        }
        gram.fill_upper_triangle_with_lower_triangle();
        Some(Self { kernel, width, values, cholesky: Cholesky::new(gram)?, points })
    }

    /// Fits the process to outputs: `outputs[j]` contains output j of every sample.
    pub(super) fn fit(&self, outputs: &[Vec<f64>]) -> Process {
        let samples = outputs.first().map_or(0, Vec::len);
        let flat: Vec<f64> = outputs.iter().flatten().copied().collect();
        let weights = self.cholesky.solve(&products(&self.values, &flat, samples, false));
        Process {
            kernel: self.kernel,
            width: self.width,
            points: self.points.clone(),
            outputs: outputs.len(),
            weights: weights.transpose().as_slice().to_vec(),
        }
    }
}

/// Matrix of aᵢ · bⱼ for rows of `length` numbers; with `lower` only for i ≥ j.
fn products(a: &[f64], b: &[f64], length: usize, lower: bool) -> DMatrix<f64> {
    let (rows, columns) = (a.len() / length.max(1), b.len() / length.max(1));
    let mut out = DMatrix::zeros(rows, columns);
    for begin in (0..length).step_by(BLOCK) {
        let end = (begin + BLOCK).min(length);
        let part = |row: usize| row * length + begin..row * length + end;
        for j in 0..columns {
            let column = &b[part(j)];
            for i in if lower { j } else { 0 }..rows {
                out[(i, j)] += dot(&a[part(i)], column);
            }
        }
    }
    out
}

/// A trained process.
#[derive(Clone, Debug)]
pub(super) struct Process {
    kernel: Kernel,
    width: usize,
    points: Vec<f64>,
    outputs: usize,
    /// Weights of each point for the outputs.
    weights: Vec<f64>,
}

impl Process {
    /// Writes the mean of every output at an input.
    pub(super) fn mean(&self, input: &[f64], out: &mut [f64]) {
        out.fill(0.0);
        for (point, weights) in self.points.chunks_exact(self.width).zip(self.weights.chunks_exact(self.outputs)) {
            let k = self.kernel.value(point, input);
            out.iter_mut().zip(weights).for_each(|(o, w)| *o += k * w);
        }
    }
}

/// Indices of at most `count` samples, each the farthest from those before it, starting with the sample nearest to the
/// mean: they cover the samples evenly.
pub(super) fn farthest_points(inputs: &[f64], width: usize, count: usize) -> Vec<usize> {
    let samples = inputs.len() / width;
    let squared = |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum() };
    let mut mean = vec![0.0; width];
    for x in inputs.chunks_exact(width) {
        mean.iter_mut().zip(x).for_each(|(m, v)| *m += v / samples as f64);
    }
    let first = (0..samples)
        .map(|i| (squared(&inputs[i * width..(i + 1) * width], &mean), i))
        .reduce(|a, b| if b.0 < a.0 { b } else { a });
    let mut chosen = Vec::with_capacity(count);
    let mut nearest = vec![f64::INFINITY; samples];
    let mut next = first.map(|(_, i)| i);
    while let Some(index) = next.filter(|_| chosen.len() < count) {
        chosen.push(index);
        let point = &inputs[index * width..(index + 1) * width];
        let mut farthest = (0.0, None);
        for (i, (d, x)) in nearest.iter_mut().zip(inputs.chunks_exact(width)).enumerate() {
            *d = d.min(squared(point, x));
            if *d > farthest.0 {
                farthest = (*d, Some(i));
            }
        }
        next = farthest.1;
    }
    chosen
}

#[cfg(test)]
mod tests {
    use super::*;
    use strut_core::math::float_funcs::double;

    const KERNEL: Kernel = Kernel { length: 0.5, noise: 1e-6 };

    fn wave(x: f64) -> f64 {
        double::sin(2.0 * x) + 0.3 * x
    }

    fn trained(points: Vec<f64>) -> Process {
        let inputs: Vec<f64> = (0..60).map(|i| 0.1 * f64::from(i)).collect();
        let outputs = vec![inputs.iter().map(|x| wave(*x)).collect(), inputs.iter().map(|x| -wave(*x)).collect()];
        Basis::new(KERNEL, 1, &inputs, points).unwrap().fit(&outputs)
    }

    #[test]
    fn training_points_are_interpolated_and_far_away_the_prior_remains() {
        let mut out = [0.0; 2];
        let process = trained((0..30).map(|i| 0.2 * f64::from(i)).collect());
        for i in 0..60 {
            let x = 0.1 * f64::from(i);
            process.mean(&[x], &mut out);
            assert!((out[0] - wave(x)).abs() < 0.01 && (out[1] + wave(x)).abs() < 0.01, "{x}: {out:?}");
        }
        for x in [-50.0, 50.0] {
            process.mean(&[x], &mut out);
            assert_eq!(out, [0.0, 0.0]);
        }
    }

    #[test]
    fn equal_points_do_no_harm() {
        let mut out = [0.0; 2];
        trained(vec![1.0; 20]).mean(&[1.0], &mut out);
        assert!(out[0].is_finite() && out[0].abs() < 3.0, "{out:?}");
    }

    #[test]
    fn farthest_points_cover_the_samples() {
        let inputs: Vec<f64> = (0..101).map(|i| 0.01 * f64::from(i)).collect();
        let chosen = farthest_points(&inputs, 1, 5);
        assert_eq!(&chosen[..3], &[50, 0, 100]);
        assert_eq!(chosen.len(), 5);
        assert_eq!(farthest_points(&[2.0; 9], 3, 5), [0], "equal samples are one point");
        assert!(farthest_points(&[], 3, 5).is_empty());
    }
}
