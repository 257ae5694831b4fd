//! Alignment of a step's frames to states: Viterbi recursion over durations (`docs/methods/hsmm.md` §5).

use super::model::{Observation, STATES};
use crate::math::float_funcs::double;
use std::f64::consts::TAU;

/// One side's states, prepared for comparison with frames.
#[derive(Clone, Debug)]
pub struct States<'a> {
    means: &'a [Observation; STATES],
    inverse_variances: [Observation; STATES],
    /// Logarithms of the Gaussians' normalisation factors.
    constants: [f64; STATES],
    durations: [f64; STATES],
    duration_variances: [f64; STATES],
}

impl<'a> States<'a> {
    pub(super) fn new(
        means: &'a [Observation; STATES],
        variances: &[Observation; STATES],
        durations: [f64; STATES],
        duration_variances: [f64; STATES],
    ) -> Self {
        let constant =
            |state: &Observation| -0.5 * state.as_flattened().iter().map(|v| double::ln(TAU * v)).sum::<f64>();
        Self {
            means,
            inverse_variances: variances.map(|state| state.map(|row| row.map(|v| 1.0 / v))),
            constants: std::array::from_fn(|s| constant(&variances[s])),
            durations,
            duration_variances,
        }
    }

    /// Log-likelihood of an observation in a state.
    fn of_frame(&self, state: usize, observation: &Observation) -> f64 {
        let means = self.means[state].as_flattened();
        let inverses = self.inverse_variances[state].as_flattened();
        let terms = observation.as_flattened().iter().zip(means).zip(inverses);
        self.constants[state] - 0.5 * terms.map(|((o, m), i)| (o - m) * (o - m) * i).sum::<f64>()
    }

    /// Log-likelihood of a state's duration in frames.
    fn of_duration(&self, state: usize, frames: usize) -> f64 {
        let (distance, variance) = (frames as f64 - self.durations[state], self.duration_variances[state]);
        -0.5 * (double::ln(TAU * variance) + distance * distance / variance)
    }

    /// Returns the most likely durations of the states of a step, and the log-likelihood of the step; `None` if it has fewer
    /// frames than there are states.
    pub fn align(&self, step: &[Observation]) -> Option<([usize; STATES], f64)> {
        let frames = step.len();
        if frames < STATES {
            return None;
        }
        // For every state, the cumulative log-likelihoods of the frames.
        let cumulative: Vec<Vec<f64>> = (0..STATES)
            .map(|state| {
                let mut sum = 0.0;
                let sums = step.iter().map(|observation| {
                    sum += self.of_frame(state, observation);
                    sum
                });
                std::iter::once(0.0).chain(sums).collect()
            })
            .collect();
        // Best log-likelihood of the states so far for each end frame, and the duration of the last state.
        let mut best = vec![f64::NEG_INFINITY; frames + 1];
        best[0] = 0.0;
        let mut chosen = Vec::with_capacity(STATES);
        for (state, sums) in cumulative.iter().enumerate() {
            let mut next = vec![(f64::NEG_INFINITY, 0); frames + 1];
            for (end, next) in next.iter_mut().enumerate() {
                for duration in 1..=end {
                    let begin = end - duration;
                    let found = best[begin] + self.of_duration(state, duration) + sums[end] - sums[begin];
                    if found > next.0 {
                        *next = (found, duration);
                    }
                }
            }
            best = next.iter().map(|n| n.0).collect();
            chosen.push(next.into_iter().map(|n| n.1).collect::<Vec<usize>>());
        }
        let mut durations = [0; STATES];
        let mut end = frames;
        for (state, chosen) in chosen.iter().enumerate().rev() {
            durations[state] = chosen[end];
            end -= chosen[end];
        }
        best[frames].is_finite().then_some((durations, best[frames]))
    }
}

/// Equal durations of a step's states, for the first round. `None` if there are fewer frames than states.
pub(super) fn equal_split(frames: usize) -> Option<[usize; STATES]> {
    let border = |state: usize| state * frames / STATES;
    (frames >= STATES).then(|| std::array::from_fn(|state| border(state + 1) - border(state)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kinematics::rotation_row::ROTATION_DIMS;
    use proptest::prelude::*;

    fn observation(value: f64) -> Observation {
        [[value; ROTATION_DIMS], [0.0; ROTATION_DIMS], [0.0; ROTATION_DIMS]]
    }

    proptest! {
        #[test]
        fn no_other_durations_are_likelier(values in prop::collection::vec(0.0f64..5.0, 8), spread in 0.5f64..3.0) {
            let step: Vec<Observation> = values.iter().map(|v| observation(*v)).collect();
            let means: [Observation; STATES] = std::array::from_fn(|s| observation(s as f64));
            let states = States::new(&means, &[[[40.0; ROTATION_DIMS]; 3]; STATES], [1.6; STATES], [spread; STATES]);
            let (found, likelihood) = states.align(&step).unwrap();
            prop_assert_eq!(found.iter().sum::<usize>(), 8);
            let score = |durations: &[usize; STATES]| {
                let mut at = 0;
                durations.iter().enumerate().map(|(s, &d)| {
                    let frames: f64 = step[at..at + d].iter().map(|o| states.of_frame(s, o)).sum();
                    at += d;
                    frames + states.of_duration(s, d)
                }).sum::<f64>()
            };
            prop_assert!((score(&found) - likelihood).abs() < 1e-6);
            for a in 1..5 { for b in 1..5 { for c in 1..5 { for d in 1..5 {
                if a + b + c + d < 8 {
                    prop_assert!(score(&[a, b, c, d, 8 - a - b - c - d]) <= likelihood + 1e-6);
                }
            }}}}
        }
    }

    #[test]
    fn steps_that_are_too_short_have_no_states() {
        assert_eq!(equal_split(4), None);
        assert_eq!(equal_split(12), Some([2, 2, 3, 2, 3]));
    }
}
