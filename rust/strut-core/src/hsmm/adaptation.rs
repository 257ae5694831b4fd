//! Adaptation of the model of all styles to one style: a linear transform for every joint, then the maximum a posteriori mean
//! with the style's own steps (`docs/methods/hsmm.md` §6c).

use super::model::{SIDES, STATES, Stream, StyleMeans};
use super::statistics::{Sample, SharedVariances, Statistics, states};
use crate::humanoid::JOINTS;
use crate::math::linear::solve_positive_definite;

/// Rounds of alignment and estimation in each of the two stages.
const ROUNDS: usize = 3;
/// Ridge of the transform towards the identity, and of its shift towards zero.
const RIDGE: [f64; 4] = [10.0, 10.0, 10.0, 10.0 * 1e-6];
/// Weight of the transformed model relative to the style's own statistics, in frames and in steps; and in frames if there are
/// many steps.
const FRAMES: f64 = 1.0;
const FRAMES_OF_MANY: f64 = 5.0;
const STEPS: f64 = 2.0;
/// Least number of steps that counts as many.
const MANY_STEPS: f64 = 100.0;

/// Returns the means of a style from its samples.
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

/// Estimates a 3 × 4 transform for every joint and all its states: poses are transformed and shifted, velocities and
/// accelerations only transformed.
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
                // Singular: the row of the identity.
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

/// Maximum a posteriori: the prior counts as a few frames.
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
