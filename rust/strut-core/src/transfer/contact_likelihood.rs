//! Likelihood that each foot of the input is planted (`docs/methods/mar.md` §11): a vote of the nearest frames by the
//! lower-body metric, weighted by the similarity of their feet's heights and speeds to the input's.

use crate::catalogue::Catalogue;
use crate::kinematics::WorldPose;
use crate::math::gaussian;
use crate::math::lanes::Lane;
use crate::search::{FEET_ROLES, Feet, Index, Neighbour};

/// Number of neighbours that vote, by the lower-body metric.
pub(super) const VOTERS: usize = 40;

/// Standard deviation of the smoothing, in frames.
const SIGMA_FRAMES: f32 = 2.0;
/// Number of frames before and after that the smoothing uses (3σ).
const REACH: usize = 6;

/// A foot becomes planted at this likelihood …
const PLANT: f32 = 0.6;
/// … and is released below this one.
const RELEASE: f32 = 0.4;

/// Scales of differences from the input: of a point's height, metres, and of its speed, m/s. Contacts are labelled by
/// height and speed (§3), so that neighbours with similar feet are the best predictors: on held-out walks 99.3 % of the
/// votes are right; with weights by the distance of the legs it is 98.2 %.
const SAME_HEIGHT: f32 = 0.01;
const SAME_SPEED: f32 = 0.15;
/// Added to the sum of squared differences, in those units. Neighbours nearer than this have about equal weight.
const SAME: f32 = 0.05;

/// Heights and speeds of the four of [`FEET_ROLES`] in the frame before the last.
#[derive(Clone, Copy, Debug)]
struct FeetState {
    heights: Lane,
    speeds: Lane,
}

impl FeetState {
    /// From positions in three successive frames.
    fn new([oldest, middle, newest]: &[Feet; 3], rate_hz: f32) -> Self {
        let [x, y, z] = std::array::from_fn(|c| Lane::of(&newest[c], 0) - Lane::of(&oldest[c], 0));
        let lengths = (x * x + y * y + z * z).map(f32::sqrt);
        Self { heights: Lane::of(&middle[1], 0), speeds: lengths * Lane::splat(0.5) * Lane::splat(rate_hz) }
    }

    /// State at the row before this one, from rows `row` − 2 to `row` of its clip. Before the clip, and before the
    /// input, the feet are assumed at rest.
    fn of_row(index: &Index, row: usize, rate_hz: f32) -> Self {
        Self::new(&index.last_feet(row), rate_hz)
    }

    /// Sums of squared differences of the left and the right foot.
    fn differences(&self, to: &Self) -> [f32; 2] {
        let heights = (self.heights - to.heights) / Lane::splat(SAME_HEIGHT);
        let speeds = (self.speeds - to.speeds) / Lane::splat(SAME_SPEED);
        let [h, s] = [heights * heights, speeds * speeds].map(Lane::to_array);
        [0, 1].map(|side| h[side] + h[side + 2] + s[side] + s[side + 2])
    }
}

/// The input's feet in the last three frames.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct RecentFeet {
    /// Oldest first; `None` before the first frame.
    frames: Option<[Feet; 3]>,
}

impl RecentFeet {
    /// Adds a frame. Before the first one the feet are assumed at rest.
    pub(super) fn push(&mut self, world: &WorldPose) {
        let points = FEET_ROLES.map(|role| world.positions[role.index()]);
        let now = [points.map(|p| p.x), points.map(|p| p.y), points.map(|p| p.z)];
        self.frames = Some(self.frames.map_or([now; 3], |[_, b, c]| [b, c, now]));
    }
}

/// Weighted shares of the neighbours in whose frames the feet are planted, [left, right].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Votes {
    /// For the last frame.
    pub(super) now: [f32; 2],
    /// For the frame before the last. It is more often right, because the next frame is known.
    pub(super) before: [f32; 2],
}

/// Weights of a neighbour's vote for the left and the right foot.
#[derive(Clone, Copy, Debug)]
pub(super) struct ContactVote {
    pub(super) row: usize,
    pub(super) weights: [f32; 2],
}

/// Votes of the neighbours; empty before the first frame of the input.
pub(super) fn contact_votes<'a>(
    catalogue: &'a Catalogue,
    neighbours: &'a [Neighbour],
    feet: &RecentFeet,
) -> impl Iterator<Item = ContactVote> + 'a {
    let (index, rate_hz) = (catalogue.index(), catalogue.rate_hz);
    let input = feet.frames.map(|frames| FeetState::new(&frames, rate_hz));
    neighbours.iter().zip(std::iter::repeat(input)).filter_map(move |(n, input)| {
        let row = n.row as usize;
        let differences = FeetState::of_row(index, row, rate_hz).differences(&input?);
        Some(ContactVote { row, weights: differences.map(|difference| 1.0 / (difference + SAME)) })
    })
}

/// Result of the vote; 0 without neighbours.
pub(super) fn vote(catalogue: &Catalogue, neighbours: &[Neighbour], feet: &RecentFeet) -> Votes {
    let (mut votes, mut sums) = (Votes::default(), [0.0_f32; 2]);
    for ContactVote { row, weights } in contact_votes(catalogue, neighbours, feet) {
        for (side, weight) in weights.into_iter().enumerate() {
            sums[side] += weight;
            votes.now[side] += weight * f32::from(catalogue.contact(row)[side]);
            votes.before[side] += weight * f32::from(catalogue.contact(row - 1)[side]);
        }
    }
    let share = |votes: [f32; 2]| std::array::from_fn(|side| votes[side] / sums[side].max(f32::MIN_POSITIVE));
    Votes { now: share(votes.now), before: share(votes.before) }
}

/// Returns whether a foot is planted, from whether it was planted before and its likelihood now.
pub(super) fn stands(stood: bool, likelihood: f32) -> bool {
    likelihood >= if stood { RELEASE } else { PLANT }
}

fn kernel() -> [f32; REACH + 1] {
    std::array::from_fn(|i| gaussian::weight(i as f32, SIGMA_FRAMES))
}

/// Gaussian smoothing that uses past frames only, so that it adds no latency.
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
    /// Adds a frame and returns the smoothed likelihoods.
    pub(super) fn push(&mut self, votes: [f32; 2]) -> [f32; 2] {
        self.past.rotate_right(1);
        self.past[0] = votes;
        self.filled = (self.filled + 1).min(REACH + 1);
        weighted(self.kernel.iter().zip(&self.past).take(self.filled))
    }
}

/// Gaussian smoothing of a whole clip that uses past and future frames.
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
    use crate::fixtures::{NEUTRAL, walk};
    use crate::kinematics::world_from_local;

    #[test]
    fn frames_of_the_database_are_recognised() {
        let db = crate::fixtures::database();
        let (proportions, catalogue) = (db.proportions, Catalogue::new(db));
        let walk = walk(&NEUTRAL, 120, 0.0);
        let mut feet = RecentFeet::default();
        // Row i of the first clip is frame i of this walk; neighbours half a cycle away have the opposite contacts.
        for (i, pose) in walk.poses.iter().enumerate() {
            feet.push(&world_from_local(&proportions, pose));
            if i < 40 {
                continue;
            }
            let rows = [i, i - 1, i - 32, i - 33, i - 34, i - 35];
            let voters = rows.map(|row| Neighbour { distance: 1e-3, row: row as u32 });
            let votes = vote(&catalogue, &voters, &feet);
            for side in 0..2 {
                assert_eq!(votes.now[side] > 0.5, walk.contact[i][side] == 1, "frame {i}: {votes:?}");
                assert_eq!(votes.before[side] > 0.5, walk.contact[i - 1][side] == 1, "frame {i}: {votes:?}");
            }
        }
        assert_eq!(vote(&catalogue, &[], &feet), Votes::default());
    }

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
