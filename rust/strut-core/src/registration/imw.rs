//! Iterative motion warping (Hsu, Pulli, Popović 2005, §3): alternates between a time warp and a slowly varying change
//! of every degree of freedom's scale and offset, so that the time warp need not explain differences of style.
//!
//! E(α, β, w) = ‖α·a + β − b∘w‖² + λ‖Dα‖² + λ‖Dβ‖² + μ‖α − 1‖² + μ‖β‖², with D the difference of successive frames. For
//! fixed w it is a banded least-squares problem for every degree of freedom (here: for every principal feature); for
//! fixed α and β, [`Dtw`] finds w.

use super::dtw::Dtw;
use super::features::{DIMS, Feature, squared_distance};
use super::warp::{Ends, Warp};

/// Scale and offset are smooth over about this time, seconds.
const SMOOTHNESS_SECS: f32 = 0.25;
/// Weight of the terms that pull the scale to 1 and the offset to 0. Without them frames without motion are ill-posed.
const PULL: f32 = 0.1;
/// Greatest number of iterations; most segments converge after three or four.
const ITERATIONS: usize = 6;

/// Iterative motion warping of feature sequences.
#[derive(Clone, Debug)]
pub(super) struct Imw {
    smoothness: f32,
    moved: Vec<Feature>,
}

impl Imw {
    pub(super) fn new(rate_hz: f32) -> Self {
        let frames = SMOOTHNESS_SECS * rate_hz;
        Self { smoothness: frames * frames, moved: Vec::new() }
    }

    /// Warp from a to b; `None` if the slope limit allows no warp. Its cost is the remaining squared distance per frame
    /// after the change of scale and offset.
    pub(super) fn warp(&mut self, dtw: &mut Dtw, a: &[Feature], b: &[Feature], ends: Ends) -> Option<Warp> {
        self.moved.clear();
        self.moved.extend_from_slice(a);
        let mut best: Option<Warp> = None;
        for _ in 0..ITERATIONS {
            let moved = &self.moved;
            let warp = dtw.warp(a.len(), b.len(), ends, |i, j| squared_distance(&moved[i], &b[j]))?;
            let settled = best.as_ref().is_some_and(|b| b.at == warp.at);
            self.fit(a, b, &warp);
            best = Some(warp);
            if settled {
                break;
            }
        }
        best
    }

    /// Sets `moved` to α·a + β with the scales and offsets that best fit b under a warp.
    fn fit(&mut self, a: &[Feature], b: &[Feature], warp: &Warp) {
        let affine = self.affine(a, b, warp);
        for (moved, (x, [scale, offset])) in self.moved.iter_mut().zip(a.iter().zip(affine)) {
            *moved = std::array::from_fn(|d| scale[d] * x[d] + offset[d]);
        }
    }

    /// Scales α and offsets β for every frame of a that best fit b under a warp.
    pub(super) fn affine(&self, a: &[Feature], b: &[Feature], warp: &Warp) -> Vec<[Feature; 2]> {
        let mut affine = vec![[[0.0; DIMS]; 2]; a.len()];
        let mut x = vec![0.0; a.len()];
        let mut y = vec![0.0; a.len()];
        let last = (b.len() - 1) as f32;
        for d in 0..DIMS {
            for (i, &at) in warp.at.iter().enumerate() {
                x[i] = a[i][d];
                y[i] = if (0.0..=last).contains(&at) {
                    let (j, next) = (at as usize, at.ceil() as usize);
                    b[j][d] + (b[next][d] - b[j][d]) * (at - j as f32)
                } else {
                    // A skipped frame has no counterpart to fit.
                    x[i]
                };
            }
            for (frame, [scale, offset]) in affine.iter_mut().zip(smooth_affine_fit(&x, &y, self.smoothness, PULL)) {
                (frame[0][d], frame[1][d]) = (scale, offset);
            }
        }
        affine
    }
}

/// Computes the [scale, offset] of every frame that minimise Σ (αᵢxᵢ + βᵢ − yᵢ)² + λ Σ ((αᵢ₊₁ − αᵢ)² + (βᵢ₊₁ − βᵢ)²) +
/// μ Σ ((αᵢ − 1)² + βᵢ²), for μ > 0.
///
/// The normal equations are block tridiagonal with 2 × 2 blocks; the off-diagonal blocks are −λ·1.
pub(super) fn smooth_affine_fit(x: &[f32], y: &[f32], lambda: f32, mu: f32) -> Vec<[f32; 2]> {
    let n = x.len();
    // Forward elimination: afterwards block i contains D⁻¹ and the reduced right-hand side.
    let mut inverse: Vec<[f32; 3]> = Vec::with_capacity(n);
    let mut rhs: Vec<[f32; 2]> = Vec::with_capacity(n);
    for i in 0..n {
        let neighbours = (usize::from(i > 0) + usize::from(i + 1 < n)) as f32;
        let diagonal = lambda * neighbours + mu;
        let [mut p, mut q, mut r] = [x[i] * x[i] + diagonal, x[i], 1.0 + diagonal];
        let [mut u, mut v] = [x[i] * y[i] + mu, y[i]];
        if let (Some(d), Some(b)) = (inverse.last(), rhs.last()) {
            p -= lambda * lambda * d[0];
            q -= lambda * lambda * d[1];
            r -= lambda * lambda * d[2];
            u += lambda * (d[0] * b[0] + d[1] * b[1]);
            v += lambda * (d[1] * b[0] + d[2] * b[1]);
        }
        let determinant = p * r - q * q;
        inverse.push([r / determinant, -q / determinant, p / determinant]);
        rhs.push([u, v]);
    }
    let mut solution = vec![[1.0, 0.0]; n];
    let mut after = [0.0, 0.0];
    for i in (0..n).rev() {
        let (d, b) = (inverse[i], rhs[i]);
        let [u, v] = if i + 1 < n { [b[0] + lambda * after[0], b[1] + lambda * after[1]] } else { b };
        after = [d[0] * u + d[1] * v, d[1] * u + d[2] * v];
        solution[i] = after;
    }
    solution
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::float_funcs::{cos, sin};
    use proptest::prelude::*;

    #[test]
    fn a_constant_scale_and_offset_are_found() {
        let x: Vec<f32> = (0..80).map(|i| 3.0 * sin(i as f32 * 0.2)).collect();
        let y: Vec<f32> = x.iter().map(|x| 1.6 * x - 0.7).collect();
        for [scale, offset] in smooth_affine_fit(&x, &y, 225.0, 1e-4) {
            assert!((scale - 1.6).abs() < 0.01 && (offset + 0.7).abs() < 0.01, "{scale} {offset}");
        }
    }

    /// The gradient of the objective vanishes at the solution.
    #[test]
    fn the_fit_is_a_minimum() {
        let x: Vec<f32> = (0..20).map(|i| sin(i as f32) * 2.0).collect();
        let y: Vec<f32> = (0..20).map(|i| cos(i as f32 * 0.7)).collect();
        let (lambda, mu) = (3.0, 0.1);
        let s = smooth_affine_fit(&x, &y, lambda, mu);
        for i in 0..20 {
            let residual = s[i][0] * x[i] + s[i][1] - y[i];
            let bend = |k: usize| {
                let mut sum = 0.0;
                if i > 0 {
                    sum += s[i][k] - s[i - 1][k];
                }
                if i + 1 < 20 {
                    sum += s[i][k] - s[i + 1][k];
                }
                lambda * sum
            };
            let gradient = [residual * x[i] + bend(0) + mu * (s[i][0] - 1.0), residual + bend(1) + mu * s[i][1]];
            assert!(gradient.iter().all(|g| g.abs() < 1e-4), "frame {i}: {gradient:?}");
        }
    }

    #[test]
    fn a_planted_warp_under_another_scale_and_offset_is_recovered() {
        let rate = 60.0;
        let point = |t: f32, scale: f32, offset: f32| -> Feature {
            std::array::from_fn(|d| match d {
                0 => scale * 3.0 * sin(t) + offset,
                1 => scale * 3.0 * cos(2.0 * t) - offset,
                2 => 3.0 * sin(t + 1.0) + offset,
                _ => 0.0,
            })
        };
        let (n, m) = (60_usize, 72_usize);
        let planted = |i: f32| {
            let t = i / (n - 1) as f32;
            (t + 0.08 * sin(t * std::f32::consts::TAU)) * (m - 1) as f32
        };
        let time = |j: f32| 6.0 * j / (m - 1) as f32;
        let b: Vec<Feature> = (0..m).map(|j| point(time(j as f32), 1.7, 1.5)).collect();
        let a: Vec<Feature> = (0..n).map(|i| point(time(planted(i as f32)), 1.0, 0.0)).collect();
        let error = |warp: &Warp| -> f32 {
            warp.at.iter().enumerate().map(|(i, at)| (at - planted(i as f32)).abs()).sum::<f32>() / n as f32
        };
        let mut dtw = Dtw::default();
        let plain = dtw.warp(n, m, Ends::default(), |i, j| squared_distance(&a[i], &b[j])).unwrap();
        let iterative = Imw::new(rate).warp(&mut dtw, &a, &b, Ends::default()).unwrap();
        assert!(error(&iterative) < 1.2, "{}", error(&iterative));
        assert!(error(&iterative) < 0.7 * error(&plain), "{} against {}", error(&iterative), error(&plain));
        assert!(iterative.at.windows(2).all(|w| w[1] > w[0]));
    }

    proptest! {
        /// A scale and an offset that increase and decrease over the motion, in addition to a smooth warp. Iterative
        /// motion warping finds the warp to a frame and a half on average. If scale and offset are weak, DTW is as
        /// good, and the loss is at most a quarter of a frame.
        #[test]
        fn any_planted_warp_under_smooth_scale_and_offset_is_recovered(
            bend in -0.07f32..0.07, gain in 1.3f32..1.8, offset in 0.8f32..1.6, seed in 0.0f32..6.0,
        ) {
            let (n, m) = (70_usize, 80_usize);
            let planted = |i: usize| {
                let t = i as f32 / (n - 1) as f32;
                (t + bend * sin(t * std::f32::consts::TAU)) * (m - 1) as f32
            };
            let feature = |at: f32, styled: bool| -> Feature {
                let part = at / (m - 1) as f32;
                let swell = if styled { 0.6 + 0.4 * sin(3.0 * part) } else { 0.0 };
                std::array::from_fn(|d| {
                    let k = d as f32;
                    let plain = if d < 12 { 2.0 * sin(7.0 * part * (1.0 + k % 2.0) + k + seed) } else { 0.0 };
                    let side = if d % 2 == 0 { 1.0 } else { -1.0 };
                    if d < 12 { plain * (1.0 + (gain - 1.0) * swell) + side * offset * swell } else { plain }
                })
            };
            let a: Vec<Feature> = (0..n).map(|i| feature(planted(i), false)).collect();
            let b: Vec<Feature> = (0..m).map(|j| feature(j as f32, true)).collect();
            let error = |warp: &Warp| -> f32 {
                warp.at.iter().enumerate().map(|(i, at)| (at - planted(i)).abs()).sum::<f32>() / n as f32
            };
            let mut dtw = Dtw::default();
            let plain = dtw.warp(n, m, Ends::default(), |i, j| squared_distance(&a[i], &b[j])).unwrap();
            let iterative = Imw::new(60.0).warp(&mut dtw, &a, &b, Ends::default()).unwrap();
            let (with, without) = (error(&iterative), error(&plain));
            prop_assert!(with <= 1.5, "{with} frames, {without} by DTW");
            prop_assert!(with <= without + 0.25, "{with} frames, {without} by DTW");
        }
    }
}
