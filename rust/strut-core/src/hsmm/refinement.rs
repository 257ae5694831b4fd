//! Refinement of means by the minimum generation error criterion (`docs/methods/hsmm.md` §6d).
//!
//! Maximum-likelihood trajectories move less than the recordings that the means were measured on. But each degree of freedom
//! of a trajectory is linear in its 30 means, so least squares finds better ones.

use super::mlpg::{Banded, FrameState, Term};
use super::model::{SIDES, STATES, Stream, StyleMeans};
use super::statistics::{Sample, SharedVariances, states, states_of};
use crate::kinematics::rotation_row::ROTATION_DIMS;
use crate::math::linear::solve_positive_definite;

/// Number of means of one degree of freedom.
const MEANS: usize = SIDES * STATES * Stream::ALL.len();
/// Ridge towards the original means. With less, the means of states that last a frame or two overshoot to compensate for
/// their neighbours, which fails in mixtures, whose states have other durations.
const RIDGE: f64 = 3.0;
/// Rounds of alignment and refinement.
const ROUNDS: usize = 3;

/// A run of consecutive steps: its first frame, and the state of every frame from there.
pub struct Chain {
    /// First frame.
    pub begin: usize,
    /// State of each frame.
    pub states: Vec<FrameState>,
}

/// Aligns a sample's steps to their most likely states; consecutive steps form a chain.
pub fn chains(sample: &Sample, means: &StyleMeans, shared: &SharedVariances) -> Vec<Chain> {
    let sides = states_of(means, shared);
    let mut chains: Vec<Chain> = Vec::new();
    for step in &sample.steps {
        let side = step.side as usize;
        let Some((durations, _)) = sides[side].align(&sample.observations[step.frames.clone()]) else { continue };
        if chains.last().is_none_or(|chain| chain.begin + chain.states.len() != step.frames.start) {
            chains.push(Chain { begin: step.frames.start, states: Vec::new() });
        }
        let states = durations.iter().enumerate().flat_map(|(state, &d)| std::iter::repeat_n((side, state), d));
        if let Some(chain) = chains.last_mut() {
            chain.states.extend(states);
        }
    }
    chains
}

/// Returns the refined means of a style from its samples.
pub(super) fn refine(samples: &[&Sample], means: &StyleMeans, shared: &SharedVariances) -> StyleMeans {
    (0..ROUNDS).fold(means.clone(), |refined, _| refine_aligned(samples, &refined, means, shared))
}

/// Refines `means` for steps that are aligned by the previously refined means.
fn refine_aligned(
    samples: &[&Sample],
    aligned: &StyleMeans,
    means: &StyleMeans,
    shared: &SharedVariances,
) -> StyleMeans {
    let chains: Vec<(&Sample, Chain)> =
        samples.iter().flat_map(|s| chains(s, aligned, shared).into_iter().map(move |chain| (*s, chain))).collect();
    let index = |side: usize, state: usize, part: Stream| (side * STATES + state) * Stream::ALL.len() + part as usize;
    let mut refined = means.clone();
    let mut system = Banded::default();
    for d in 0..ROTATION_DIMS {
        let (mut matrix, mut right) = ([0.0; MEANS * MEANS], [0.0; MEANS]);
        let variance = |side: usize, state: usize, part: Stream| shared.variances[side][state][part as usize][d];
        let weight = |side: usize, state: usize, part: Stream| 1.0 / variance(side, state, part);
        for (sample, chain) in &chains {
            system.weigh(&chain.states, weight);
            let columns: Vec<Vec<f64>> = (0..MEANS)
                .map(|i| {
                    let unit = |side: usize, state: usize, part: Stream| Term {
                        mean: f64::from(u8::from(index(side, state, part) == i)),
                        weight: weight(side, state, part),
                    };
                    system.through_weighed(&chain.states, unit).to_vec()
                })
                .collect();
            let recorded = &sample.rows[chain.begin..];
            for (i, a) in columns.iter().enumerate() {
                for (j, b) in columns.iter().enumerate().take(i + 1) {
                    let product: f64 = a.iter().zip(b).map(|(a, b)| a * b).sum();
                    matrix[i * MEANS + j] += product;
                    if j < i {
                        matrix[j * MEANS + i] += product;
                    }
                }
                right[i] += a.iter().zip(recorded).map(|(a, row)| a * row[d]).sum::<f64>();
            }
        }
        let poses = states().map(|(side, state)| variance(side, state, Stream::Static)).sum::<f64>();
        let mean_variance = poses / (SIDES * STATES) as f64;
        for part in Stream::ALL {
            for (side, state) in states() {
                let (i, hold) = (index(side, state, part), RIDGE * mean_variance / variance(side, state, part));
                matrix[i * MEANS + i] += hold;
                right[i] += hold * means.means[side][state][part as usize][d];
            }
        }
        if solve_positive_definite(&mut matrix, &mut right).is_none() {
            continue;
        }
        for part in Stream::ALL {
            for (side, state) in states() {
                refined.means[side][state][part as usize][d] = right[index(side, state, part)];
            }
        }
    }
    refined
}
