//! Subspace identification of linear time-invariant systems from recordings of their inputs and outputs
//! (Van Overschee and De Moor, "Subspace Identification for Linear Systems", 1996).
//!
//! xₜ₊₁ = A xₜ + B uₜ,  yₜ = C xₜ + D uₜ + e. With i lags, the past wₜ = [uₜ₋ᵢ, yₜ₋ᵢ, …, uₜ₋₁, yₜ₋₁] and the future
//! inputs predict the future outputs by least squares. The part Γ xₜ = L wₜ that comes from the past has rank n, and
//! its leading directions (weighted as in MOESP, by the past that the future inputs do not explain) give the states as
//! xₜ = T wₜ. Regressing xₜ₊₁ on xₜ and uₜ gives A and B. Since the system runs in open loop, without y, C, D and the
//! offset are fitted to the states of a simulation, which after some time do not depend on the initial state.
//!
//! All steps except the last need only the lagged products of the recordings: a block Hankel Gram matrix whose blocks
//! follow from their upper left neighbours.

use super::products::{dot, product};
use nalgebra::{Cholesky, DMatrix, DVector, Schur, SymmetricEigen};
use strut_core::math::float_funcs::double;

/// Greatest spectral radius of A: a time constant of about 1 s at 60 Hz.
const MAX_RADIUS: f64 = 0.985;
/// Ridge of Gram matrices, as a share of their mean diagonal: for periodic motion the lags are nearly collinear.
const RIDGE: f64 = 1e-5;
/// Added to each diagonal entry of the regression of C and D, as a share of itself: inputs may be collinear.
const OUTPUT_RIDGE: f64 = 1e-7;

/// A sequence of consecutive frames.
#[derive(Clone, Debug)]
pub(super) struct Recording {
    /// uₜ, frames in sequence.
    pub(super) inputs: Vec<f64>,
    /// yₜ, frames in sequence.
    pub(super) outputs: Vec<f64>,
}

/// Numbers of inputs m and outputs l, order n of the state, and lags i.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Shape {
    pub(super) inputs: usize,
    pub(super) outputs: usize,
    pub(super) order: usize,
    pub(super) lags: usize,
}

/// A stable linear system; matrices are stored by rows.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct StateSpace {
    order: usize,
    /// [A B], n rows.
    transition: Vec<f64>,
    /// [C D offset], l rows.
    output: Vec<f64>,
    /// (I − A)⁻¹ B, n rows: the steady state per unit of constant input.
    rest: Vec<f64>,
}

impl StateSpace {
    /// Identifies a system of this shape. If recordings are too short or not exciting enough the order is lower, down
    /// to a static map; without any frame the output is zero.
    pub(super) fn identify(recordings: &[Recording], shape: Shape) -> Self {
        let none = || (DMatrix::zeros(0, 0), DMatrix::zeros(0, shape.inputs));
        let (a, b) = dynamics(recordings, shape).unwrap_or_else(none);
        let order = a.nrows();
        let rest = match order {
            0 => None,
            _ => (DMatrix::identity(order, order) - &a).lu().solve(&b),
        };
        let rest = rest.unwrap_or_else(|| DMatrix::zeros(order, shape.inputs));
        let mut system = Self {
            order,
            transition: by_rows(&DMatrix::from_fn(order, order + shape.inputs, |i, j| {
                if j < order { a[(i, j)] } else { b[(i, j - order)] }
            })),
            output: vec![0.0; shape.outputs * (order + shape.inputs + 1)],
            rest: by_rows(&rest),
        };
        system.fit_output(recordings, shape);
        system
    }

    /// Dimension of the state; [`StateSpace::step`] needs twice as many values of memory.
    pub(super) fn order(&self) -> usize {
        self.order
    }

    /// Sets the state to the steady state of the constant input `u`.
    pub(super) fn rest(&self, state: &mut [f64], u: &[f64]) {
        for (x, row) in state.iter_mut().zip(self.rest.chunks_exact(u.len())) {
            *x = dot(row, u);
        }
    }

    /// yₜ for the state and input at t.
    pub(super) fn output(&self, state: &[f64], u: &[f64], y: &mut [f64]) {
        let n = self.order;
        for (y, row) in y.iter_mut().zip(self.output.chunks_exact(n + u.len() + 1)) {
            *y = dot(&row[..n], state) + dot(&row[n..n + u.len()], u) + row[n + u.len()];
        }
    }

    /// Advances by one frame. `memory` contains the state and space for another.
    pub(super) fn step(&self, memory: &mut [f64], u: &[f64]) {
        let n = self.order;
        let (state, next) = memory.split_at_mut(n);
        for (x, row) in next.iter_mut().zip(self.transition.chunks_exact(n + u.len())) {
            *x = dot(&row[..n], state) + dot(&row[n..], u);
        }
        state.copy_from_slice(&next[..n]);
    }

    /// Fits C, D and the offset to the states that result from the recordings' inputs. A recording starts in the steady
    /// state of its first input. Its first frames are ignored, unless few would be left.
    fn fit_output(&mut self, recordings: &[Recording], shape: Shape) {
        let Shape { inputs: m, outputs: l, lags, .. } = shape;
        let width = self.order + m + 1;
        let mut gram = DMatrix::<f64>::zeros(width, width);
        let mut right = DMatrix::<f64>::zeros(width, l);
        let mut memory = vec![0.0; 2 * self.order];
        let mut regressors = vec![1.0; width];
        let mut count = 0.0;
        for r in recordings {
            let skip = if r.inputs.len() > 3 * lags * m { lags } else { 0 };
            self.rest(&mut memory, &r.inputs[..m]);
            for (t, (u, y)) in r.inputs.chunks_exact(m).zip(r.outputs.chunks_exact(l)).enumerate() {
                if t < skip {
                    self.step(&mut memory, u);
                    continue;
                }
                regressors[..self.order].copy_from_slice(&memory[..self.order]);
                regressors[self.order..width - 1].copy_from_slice(u);
                count += 1.0;
                for (j, &v) in regressors.iter().enumerate() {
                    let column = &mut gram.as_mut_slice()[j * width..(j + 1) * width];
                    column[j..].iter_mut().zip(&regressors[j..]).for_each(|(sum, w)| *sum += v * w);
                }
                for (sums, y) in right.as_mut_slice().chunks_exact_mut(width).zip(y) {
                    sums.iter_mut().zip(&regressors).for_each(|(sum, v)| *sum += v * y);
                }
                self.step(&mut memory, u);
            }
        }
        gram.fill_upper_triangle_with_lower_triangle();
        // Relative to the size of each regressor: states may be much smaller than inputs.
        for i in 0..width {
            gram[(i, i)] += OUTPUT_RIDGE * gram[(i, i)] + f64::MIN_POSITIVE.max(1e-12 * count);
        }
        if let Some(cholesky) = Cholesky::new(gram) {
            self.output = by_rows(&cholesky.solve(&right).transpose());
        }
    }
}

fn by_rows(matrix: &DMatrix<f64>) -> Vec<f64> {
    matrix.transpose().as_slice().to_vec()
}

/// Series of all components of all recordings, `[recording][component][frame]`, minus the components' means.
fn centred(recordings: &[Recording], shape: Shape) -> Vec<Vec<Vec<f64>>> {
    let Shape { inputs: m, outputs: l, .. } = shape;
    let series = |r: &Recording, c: usize| -> Vec<f64> {
        if c < m {
            r.inputs.iter().skip(c).step_by(m).copied().collect()
        } else {
            r.outputs.iter().skip(c - m).step_by(l).copied().collect()
        }
    };
    let mut all: Vec<Vec<Vec<f64>>> = recordings.iter().map(|r| (0..m + l).map(|c| series(r, c)).collect()).collect();
    let frames = all.iter().map(|r| r[0].len()).sum::<usize>().max(1) as f64;
    for c in 0..m + l {
        let mean = all.iter().flat_map(|r| &r[c]).sum::<f64>() / frames;
        for v in all.iter_mut().flat_map(|r| &mut r[c]) {
            *v -= mean;
        }
    }
    all
}

/// A and B, or `None` if the recordings do not determine them.
fn dynamics(recordings: &[Recording], shape: Shape) -> Option<(DMatrix<f64>, DMatrix<f64>)> {
    let Shape { inputs: m, outputs: l, lags, .. } = shape;
    let p = m + l;
    let mut gram = hankel_gram(&centred(recordings, shape), lags)?;
    let ridge = RIDGE * gram.diagonal().mean();
    for i in 0..gram.nrows() {
        gram[(i, i)] += ridge;
    }
    let past: Vec<usize> = (0..lags * p).collect();
    let past_next: Vec<usize> = past.iter().map(|i| i + p).collect();
    let now: Vec<usize> = (lags * p..lags * p + m).collect();
    let future = |component: std::ops::Range<usize>| -> Vec<usize> {
        (lags..2 * lags).flat_map(|k| component.clone().map(move |c| k * p + c)).collect()
    };
    let (future_inputs, future_outputs) = (future(0..m), future(m..p));
    let known: Vec<usize> = past.iter().chain(&future_inputs).copied().collect();
    let block = |rows: &[usize], columns: &[usize]| gram.select_rows(rows).select_columns(columns);

    // Γ xₜ = L wₜ.
    let coefficients = Cholesky::new(block(&known, &known))?.solve(&block(&known, &future_outputs));
    let from_past = coefficients.rows(0, past.len()).transpose();
    let explained = Cholesky::new(block(&future_inputs, &future_inputs))?.solve(&block(&future_inputs, &past));
    let unexplained = block(&past, &past) - product(&block(&past, &future_inputs), &explained);
    let eigen = SymmetricEigen::new(product(&product(&from_past, &unexplained), &from_past.transpose()));
    let mut leading: Vec<usize> = (0..eigen.eigenvalues.len()).collect();
    leading.sort_by(|&a, &b| eigen.eigenvalues[b].total_cmp(&eigen.eigenvalues[a]).then(a.cmp(&b)));
    let least = 1e-12 * eigen.eigenvalues[leading[0]];
    leading.retain(|&i| eigen.eigenvalues[i] > least.max(f64::MIN_POSITIVE));
    leading.truncate(shape.order);
    let mut directions = eigen.eigenvectors.select_columns(&leading);
    for (mut column, &i) in directions.column_iter_mut().zip(&leading) {
        column /= eigen.eigenvalues[i].sqrt();
    }
    let state_from_past = product(&directions.transpose(), &from_past);

    // xₜ₊₁ on xₜ and uₜ.
    let n = leading.len();
    let states = |rows: &[usize], columns: &[usize]| product(&state_from_past, &block(rows, columns));
    let transposed = state_from_past.transpose();
    let mut of_state = DMatrix::zeros(n + m, n + m);
    of_state.view_mut((0, 0), (n, n)).copy_from(&product(&states(&past, &past), &transposed));
    of_state.view_mut((0, n), (n, m)).copy_from(&states(&past, &now));
    of_state.view_mut((n, 0), (m, n)).copy_from(&states(&past, &now).transpose());
    of_state.view_mut((n, n), (m, m)).copy_from(&block(&now, &now));
    let mut next = DMatrix::zeros(n + m, n);
    next.view_mut((0, 0), (n, n)).copy_from(&product(&states(&past_next, &past), &transposed).transpose());
    next.view_mut((n, 0), (m, n)).copy_from(&states(&past_next, &now).transpose());
    let transition = Cholesky::new(of_state)?.solve(&next).transpose();
    let a = stabilised(transition.columns(0, n).into_owned())?;
    let b = transition.columns(n, m).into_owned();
    (a.iter().chain(b.iter()).all(|v| v.is_finite())).then_some((a, b))
}

/// A, scaled to a spectral radius of at most [`MAX_RADIUS`].
fn stabilised(a: DMatrix<f64>) -> Option<DMatrix<f64>> {
    if a.is_empty() {
        return Some(a);
    }
    let eigenvalues: DVector<_> = Schur::try_new(a.clone(), f64::EPSILON, 10_000)?.complex_eigenvalues();
    let radius = eigenvalues.iter().map(|z| double::hypot(z.re, z.im)).fold(0.0, f64::max);
    Some(if radius > MAX_RADIUS { a * (MAX_RADIUS / radius) } else { a })
}

/// Σ sₜ sₜᵀ over all windows sₜ = [uₜ, yₜ, uₜ₊₁, yₜ₊₁, …] of 2·`lags` frames of some recordings, given the series of
/// their components; `None` if there are fewer windows than numbers in a window.
fn hankel_gram(recordings: &[Vec<Vec<f64>>], lags: usize) -> Option<DMatrix<f64>> {
    let p = recordings.first()?.len();
    let length = 2 * lags;
    let mut gram = DMatrix::<f64>::zeros(length * p, length * p);
    let mut count = 0;
    for series in recordings {
        let frames = series[0].len();
        if frames < length {
            continue;
        }
        let windows = frames + 1 - length;
        count += windows;
        // Products for one lag at a time: first between the first frames of the windows and those `lag` later; then
        // between the second frames and those `lag` later, by subtracting the first window's product and adding that of
        // a window after the last; and so on.
        for lag in 0..length {
            for (i, x) in series.iter().enumerate() {
                for (j, y) in series.iter().enumerate() {
                    let mut sum = dot(&x[..windows], &y[lag..lag + windows]);
                    for first in 0..length - lag {
                        gram[((first + lag) * p + j, first * p + i)] += sum;
                        if first + lag + 1 < length {
                            let (begin, end) = (first, first + windows);
                            sum += x[end] * y[end + lag] - x[begin] * y[begin + lag];
                        }
                    }
                }
            }
        }
    }
    gram.fill_upper_triangle_with_lower_triangle();
    (count > length * p).then_some(gram)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixtures::noise;

    /// Inputs that start at zero.
    fn from_rest(seed: u32, frames: usize) -> Vec<f64> {
        std::iter::once(0.0).chain(noise(seed)).take(frames).collect()
    }

    /// A damped oscillation (eigenvalues 0.8 ± 0.4i) and a slow decay, with one output, initially at rest.
    fn planted(inputs: &[f64]) -> Vec<f64> {
        let mut x = [0.0; 3];
        inputs
            .iter()
            .map(|u| {
                let y = x[0] - 0.5 * x[1] + 0.3 * x[2] + 0.7 * u;
                x = [0.8 * x[0] - 0.4 * x[1] + u, 0.4 * x[0] + 0.8 * x[1], 0.95 * x[2] + 0.2 * u];
                y
            })
            .collect()
    }

    fn impulse_response(system: &StateSpace, frames: usize) -> Vec<f64> {
        let mut memory = vec![0.0; 2 * system.order()];
        let (mut still, mut y) = ([0.0], [0.0]);
        system.output(&memory, &[0.0], &mut still);
        let respond = |t: usize| {
            let u = [if t == 0 { 1.0 } else { 0.0 }];
            system.output(&memory, &u, &mut y);
            system.step(&mut memory, &u);
            y[0] - still[0]
        };
        (0..frames).map(respond).collect()
    }

    const SHAPE: Shape = Shape { inputs: 1, outputs: 1, order: 3, lags: 8 };

    #[test]
    fn the_impulse_response_of_a_planted_system_is_recovered() {
        let expected = planted(&std::iter::once(1.0).chain([0.0; 39]).collect::<Vec<_>>());
        let recordings: Vec<Recording> = [3, 4]
            .map(|seed| {
                let inputs = from_rest(seed, 600);
                let errors = noise(seed + 10);
                let outputs = planted(&inputs).iter().zip(errors).map(|(y, e)| y + 0.02 * e + 0.4).collect();
                Recording { inputs, outputs }
            })
            .into();
        let system = StateSpace::identify(&recordings, SHAPE);
        assert_eq!(system.order(), 3);
        let mut y = [0.0];
        system.output(&[0.0; 3], &[0.0], &mut y);
        assert!((y[0] - 0.4).abs() < 0.01, "{y:?}");
        for (t, (y, e)) in impulse_response(&system, 40).iter().zip(&expected).enumerate() {
            assert!((y - e).abs() < 0.02, "frame {t}: {y} for {e}");
        }
    }

    /// Two inputs act crosswise on two outputs, each with its own decay.
    #[test]
    fn systems_with_several_inputs_and_outputs_are_recovered() {
        let (u, v) = (from_rest(5, 800), from_rest(6, 800));
        let mut x = [0.0; 2];
        let mut r = Recording { inputs: Vec::new(), outputs: Vec::new() };
        for (u, v) in u.into_iter().zip(v) {
            r.inputs.extend([u, v]);
            r.outputs.extend([x[0] + 0.2 * v, x[1] - 0.5 * x[0]]);
            x = [0.9 * x[0] + v, 0.6 * x[1] + u];
        }
        let shape = Shape { inputs: 2, outputs: 2, order: 2, lags: 5 };
        let system = StateSpace::identify(std::slice::from_ref(&r), shape);
        let mut memory = vec![0.0; 4];
        let mut y = [0.0; 2];
        for (t, (u, e)) in r.inputs.chunks_exact(2).zip(r.outputs.chunks_exact(2)).enumerate() {
            system.output(&memory, u, &mut y);
            system.step(&mut memory, u);
            assert!(t < 100 || (y[0] - e[0]).abs().max((y[1] - e[1]).abs()) < 3e-3, "frame {t}: {y:?} for {e:?}");
        }
    }

    #[test]
    fn an_unstable_system_is_made_stable() {
        let inputs: Vec<f64> = noise(7).take(300).collect();
        let mut x = 0.0;
        let outputs = inputs
            .iter()
            .map(|u| {
                let y = x;
                x = 1.02 * x + u;
                y
            })
            .collect();
        let system = StateSpace::identify(&[Recording { inputs, outputs }], Shape { order: 1, ..SHAPE });
        let response = impulse_response(&system, 400);
        assert!(response[399].abs() < 0.01 * response[1].abs(), "{} {}", response[1], response[399]);
    }

    #[test]
    fn a_constant_input_keeps_the_state_at_rest() {
        let inputs: Vec<f64> = noise(8).take(400).collect();
        let system = StateSpace::identify(&[Recording { outputs: planted(&inputs), inputs }], SHAPE);
        let mut memory = [0.0; 6];
        system.rest(&mut memory, &[0.8]);
        let before = memory;
        system.step(&mut memory, &[0.8]);
        assert!(before.iter().zip(memory).take(3).all(|(a, b)| (a - b).abs() < 1e-9));
    }

    #[test]
    fn too_little_for_dynamics_gives_a_static_map() {
        let inputs: Vec<f64> = noise(9).take(12).collect();
        let outputs = inputs.iter().map(|u| 2.0 * u + 1.0).collect();
        let system = StateSpace::identify(&[Recording { inputs, outputs }], SHAPE);
        assert_eq!(system.order(), 0);
        let mut y = [0.0];
        system.output(&[], &[0.5], &mut y);
        assert!((y[0] - 2.0).abs() < 1e-5, "{y:?}");
        system.step(&mut [], &[0.5]);
        let nothing = StateSpace::identify(&[], SHAPE);
        nothing.output(&[], &[0.5], &mut y);
        assert_eq!(y, [0.0]);
    }

    #[test]
    fn lagged_products_are_those_of_all_windows() {
        let recordings: Vec<Recording> = [(11, 40), (12, 55)]
            .map(|(seed, frames)| Recording {
                inputs: noise(seed).take(2 * frames).collect(),
                outputs: noise(seed + 5).take(frames).collect(),
            })
            .into();
        let shape = Shape { inputs: 2, outputs: 1, order: 1, lags: 3 };
        let series = centred(&recordings, shape);
        let gram = hankel_gram(&series, 3).unwrap();
        let mut expected = DMatrix::<f64>::zeros(18, 18);
        for r in &series {
            let frames: Vec<[f64; 3]> = (0..r[0].len()).map(|t| [r[0][t], r[1][t], r[2][t]]).collect();
            for window in frames.windows(6) {
                let s = DVector::from_iterator(18, window.iter().flatten().copied());
                expected += &s * s.transpose();
            }
        }
        assert!((gram - expected).abs().max() < 1e-10);
    }
}
