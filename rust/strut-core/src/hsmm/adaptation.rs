//! A style as a change of the model of all styles: a linear transform for every joint, then the mean between that and what
//! its own steps say (`docs/methods/hsmm.md` §6c).

use super::model::{SIDES, STATES, Stream, StyleMeans};
use super::statistics::{Sample, SharedVariances, Statistics, states};
use crate::humanoid::JOINTS;
use crate::math::linear::solve_positive_definite;

/// Rounds of alignment and estimation, of either method.
const ROUNDS: usize = 3;
/// How much the transform holds to none, and its shift.
const RIDGE: [f64; 4] = [10.0, 10.0, 10.0, 10.0 * 1e-6];
/// Frames, and steps, that the transformed model counts as against the style's own; and frames where there are many steps.
const FRAMES: f64 = 1.0;
const FRAMES_OF_MANY: f64 = 5.0;
const STEPS: f64 = 2.0;
/// Steps that are many.
const MANY_STEPS: f64 = 100.0;

/// The means of a style with these samples, all of which are of the style.
pub(super) fn adapt(samples: &[&Sample], all: &StyleMeans, shared: &SharedVariances) -> StyleMeans {
    let mut means = all.clone();
    for _ in 0..ROUNDS {
        means = transformed(all, shared, &Statistics::aligned(samples, Some((&means, shared))));
    }
    let before = means.clone();
    for _ in 0..ROUNDS {
        means = mean_with_own(&before, &Statistics::aligned(samples, Some((&means, shared))));
    }
    means
}

/// One 3 × 4 transform for every joint and all its states: pose and shift, and velocity and acceleration without the shift.
fn transformed(all: &StyleMeans, shared: &SharedVariances, sums: &Statistics) -> StyleMeans {
    let mut means = all.clone();
    for joint in 0..JOINTS {
        let dims = 3 * joint..3 * joint + 3;
        let regressors = |part: Stream, side: usize, state: usize| {
            let mean = &all.means[side][state][part as usize][dims.clone()];
            [mean[0], mean[1], mean[2], f64::from(u8::from(part == Stream::Static))]
        };
        let rows: [[f64; 4]; 3] = std::array::from_fn(|row| {
            let d = dims.start + row;
            let mut matrix = [0.0; 16];
            let mut right = [0.0; 4];
            for i in 0..4 {
                matrix[5 * i] = RIDGE[i];
            }
            right[row] = RIDGE[row];
            for part in Stream::ALL {
                for (side, state) in states() {
                    let z = regressors(part, side, state);
                    let weight = 1.0 / shared.variances[side][state][part as usize][d];
                    for i in 0..4 {
                        for j in 0..4 {
                            matrix[4 * i + j] += weight * sums.frames[side][state] * z[i] * z[j];
                        }
                        right[i] += weight * z[i] * sums.values[side][state][part as usize][d];
                    }
                }
            }
            match solve_positive_definite(&mut matrix, &mut right) {
                Some(()) => right,
                // No transform: the row of the identity.
                None => std::array::from_fn(|i| f64::from(u8::from(i == row))),
            }
        });
        for part in Stream::ALL {
            for (side, state) in states() {
                let z = regressors(part, side, state);
                let out = &mut means.means[side][state][part as usize][dims.clone()];
                for (out, row) in out.iter_mut().zip(&rows) {
                    *out = row.iter().zip(&z).map(|(a, b)| a * b).sum();
                }
            }
        }
    }
    let total =
        |durations: &dyn Fn(usize, usize) -> f64| states().map(|(side, state)| durations(side, state)).sum::<f64>();
    let own = total(&|side, state| sums.durations[side][state]);
    let expected = total(&|side, state| sums.steps[side] * all.durations[side][state]);
    let factor = if expected > 0.0 { own / expected } else { 1.0 };
    for duration in means.durations.as_flattened_mut() {
        *duration *= factor;
    }
    means
}

/// Maximum a posteriori: what was known before counts like a few frames.
fn mean_with_own(before: &StyleMeans, sums: &Statistics) -> StyleMeans {
    let mut means = before.clone();
    let steps: f64 = sums.steps.iter().sum();
    let prior = if steps >= MANY_STEPS { FRAMES_OF_MANY } else { FRAMES };
    for side in 0..SIDES {
        for state in 0..STATES {
            let frames = prior + sums.frames[side][state];
            let values = sums.values[side][state].as_flattened();
            for (mean, sum) in means.means[side][state].as_flattened_mut().iter_mut().zip(values) {
                *mean = (prior * *mean + sum) / frames;
            }
            let duration = &mut means.durations[side][state];
            *duration = (STEPS * *duration + sums.durations[side][state]) / (STEPS + sums.steps[side]);
        }
    }
    means
}
