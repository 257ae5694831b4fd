//! How likely each foot of the input is planted (specification, §11).

use crate::database::Database;
use crate::math::float_funcs::exp;
use crate::search::Neighbour;

/// Neighbours that vote, by the lower-body metric.
pub(super) const VOTERS: usize = 40;

/// Standard deviation of the smoothing, in frames.
const SIGMA_FRAMES: f32 = 2.0;
/// Frames on either side that the smoothing reaches (3σ).
const REACH: usize = 6;

/// A foot stands from this likelihood on …
const PLANT: f32 = 0.6;
/// … until it falls below this one.
const RELEASE: f32 = 0.4;

/// Distances below this count as equal, (1 mm).
const SAME: f32 = 1e-3;

/// Inverse-distance mean of the neighbours' contact labels [left, right]; 0 without neighbours.
pub(super) fn vote(db: &Database, neighbours: &[Neighbour]) -> [f32; 2] {
    let mut sum = [0.0; 2];
    let mut weights = 0.0;
    for n in neighbours {
        let w = 1.0 / (n.distance.sqrt() + SAME);
        weights += w;
        for (s, c) in sum.iter_mut().zip(db.contact[n.row as usize]) {
            *s += w * f32::from(c);
        }
    }
    sum.map(|s| if weights > 0.0 { s / weights } else { 0.0 })
}

/// Whether a foot stands, given whether it did and its likelihood now.
pub(super) fn stands(stood: bool, likelihood: f32) -> bool {
    likelihood >= if stood { RELEASE } else { PLANT }
}

fn kernel() -> [f32; REACH + 1] {
    std::array::from_fn(|i| exp(-0.5 * (i * i) as f32 / (SIGMA_FRAMES * SIGMA_FRAMES)))
}

/// Gaussian smoothing that looks back only, so that it adds no latency.
#[derive(Clone, Debug)]
pub(super) struct CausalSmoother {
    kernel: [f32; REACH + 1],
    /// Newest first.
    past: [[f32; 2]; REACH + 1],
    filled: usize,
}

impl Default for CausalSmoother {
    fn default() -> Self {
        Self { kernel: kernel(), past: [[0.0; 2]; REACH + 1], filled: 0 }
    }
}

impl CausalSmoother {
    /// The smoothed likelihoods after a further frame.
    pub(super) fn push(&mut self, votes: [f32; 2]) -> [f32; 2] {
        self.past.rotate_right(1);
        self.past[0] = votes;
        self.filled = (self.filled + 1).min(REACH + 1);
        weighted(self.kernel.iter().zip(&self.past).take(self.filled))
    }
}

/// Gaussian smoothing of a whole clip that looks both ways.
pub(super) fn smoothed(votes: &[[f32; 2]]) -> Vec<[f32; 2]> {
    let kernel = kernel();
    (0..votes.len())
        .map(|i| {
            let reach = i.saturating_sub(REACH)..(i + REACH + 1).min(votes.len());
            weighted(reach.map(|j| (&kernel[i.abs_diff(j)], &votes[j])))
        })
        .collect()
}

fn weighted<'a>(terms: impl Iterator<Item = (&'a f32, &'a [f32; 2])>) -> [f32; 2] {
    let (mut sum, mut weights) = ([0.0; 2], 0.0);
    for (w, v) in terms {
        weights += w;
        for (s, v) in sum.iter_mut().zip(v) {
            *s += w * v;
        }
    }
    sum.map(|s| s / weights)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constants_are_kept_and_edges_softened() {
        let mut causal = CausalSmoother::default();
        for _ in 0..10 {
            assert_eq!(causal.push([1.0, 0.0]), [1.0, 0.0]);
        }
        let after_lift = causal.push([0.0, 0.0])[0];
        assert!(after_lift > 0.5 && after_lift < 1.0);
        let step: Vec<[f32; 2]> = (0..20).map(|i| [if i < 10 { 1.0 } else { 0.0 }, 1.0]).collect();
        let out = smoothed(&step);
        assert!((out[9][0] + out[10][0] - 1.0).abs() < 1e-5, "symmetric about the edge");
        assert!(out.iter().all(|v| v[1] == 1.0));
    }
}
