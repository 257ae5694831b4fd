//! Context clustering of steps: a decision tree by minimum description length (`docs/methods/hsmm.md` §7).

use super::shared_of;
use std::f64::consts::TAU;
use strut_core::hsmm::Track;
use strut_core::hsmm::parts::{Sample, Statistics, Stream, states, states_of};
use strut_core::hsmm::{ROTATION_DIMS, RotationRow};
use strut_core::hsmm::{SIDES, STATES, WalkModel};
use strut_core::math::float_funcs::double;

/// Position of a step in its clip: first, second, last but one, last, or another.
const POSITIONS: usize = 5;
const CONTEXTS: usize = SIDES * POSITIONS;

/// A question about a context: its text, and the positions for which it is true; empty for the question about the side.
const QUESTIONS: [(&str, &[usize]); 8] = [
    ("a left step?", &[]),
    ("the first?", &[0]),
    ("the second?", &[1]),
    ("the last but one?", &[2]),
    ("the last?", &[3]),
    ("the first or the second?", &[0, 1]),
    ("the last or the last but one?", &[2, 3]),
    ("near an end?", &[0, 1, 2, 3]),
];

/// A question that splits contexts.
#[derive(Clone, Debug)]
pub struct Split {
    /// Text of the question.
    pub question: &'static str,
    /// Increase of the frames' log-likelihood by two models instead of one.
    pub gain: f64,
}

/// The result of context clustering.
#[derive(Clone, Debug)]
pub struct ContextTree {
    /// Splits in the order of growth.
    pub splits: Vec<Split>,
    /// The greatest gain of a question below the cost of a split.
    pub rejected: f64,
    /// Description length of a split: half the parameters that it adds, times the logarithm of the number of frames, twice.
    pub cost: f64,
}

impl ContextTree {
    /// Grows the tree on walks with the indices of their styles. With `style_free`, a style's mean pose is subtracted from
    /// its frames.
    pub fn grow(model: &WalkModel, walks: &[(usize, &Track)], style_free: bool) -> Self {
        let shared = shared_of(model);
        let mut sums: Vec<Statistics> = (0..POSITIONS).map(|_| Statistics::zero()).collect();
        for &(style, track) in walks {
            let sample = Sample::new(style, track, &model.reference);
            let states = states_of(&model.means[style], &shared);
            let offset = if style_free { mean_pose(model, style) } else { [0.0; ROTATION_DIMS] };
            for (i, step) in sample.steps.iter().enumerate() {
                let from_end = sample.steps.len() - 1 - i;
                let position = match (i, from_end) {
                    (0, _) => 0,
                    (1, _) => 1,
                    (_, 1) => 2,
                    (_, 0) => 3,
                    _ => 4,
                };
                let side = step.side as usize;
                let mut frames = sample.observations[step.frames.clone()].to_vec();
                let Some((durations, _)) = states[side].align(&frames) else { continue };
                for frame in &mut frames {
                    frame[Stream::Static as usize].iter_mut().zip(&offset).for_each(|(x, offset)| *x -= offset);
                }
                sums[position].add(side, &frames, &durations);
            }
        }
        let frames: f64 = sums.iter().flat_map(|s| s.frames.as_flattened()).sum();
        let cost = (STATES * 3 * ROTATION_DIMS) as f64 * double::ln(frames.max(1.0));
        let mut tree = Self { splits: Vec::new(), rejected: 0.0, cost };
        tree.part(&sums, [true; CONTEXTS]);
        tree
    }

    /// Splits contexts by the question of the greatest gain, if it exceeds the cost.
    fn part(&mut self, sums: &[Statistics], contexts: [bool; CONTEXTS]) {
        let whole = likelihood(sums, &contexts);
        let parts = QUESTIONS.iter().filter_map(|&(question, positions)| {
            let yes =
                |i: usize| if positions.is_empty() { i < POSITIONS } else { positions.contains(&(i % POSITIONS)) };
            let part = |wanted: bool| std::array::from_fn(|i| contexts[i] && yes(i) == wanted);
            let [a, b]: [[bool; CONTEXTS]; 2] = [part(true), part(false)];
            let gain = likelihood(sums, &a) + likelihood(sums, &b) - whole;
            (a.contains(&true) && b.contains(&true)).then_some((Split { question, gain }, a, b))
        });
        let Some((split, a, b)) = parts.max_by(|x, y| x.0.gain.total_cmp(&y.0.gain)) else { return };
        if split.gain <= self.cost {
            self.rejected = self.rejected.max(split.gain);
            return;
        }
        self.splits.push(split);
        self.part(sums, a);
        self.part(sums, b);
    }
}

/// Log-likelihood of the frames of some contexts under one common model.
fn likelihood(sums: &[Statistics], contexts: &[bool; CONTEXTS]) -> f64 {
    (0..STATES)
        .map(|state| {
            let of = || (0..CONTEXTS).filter(|&i| contexts[i]).map(|i| (&sums[i % POSITIONS], i / POSITIONS));
            let frames: f64 = of().map(|(sums, side)| sums.frames[side][state]).sum();
            let dims = (0..3 * ROTATION_DIMS).map(|d| {
                let sum: f64 = of().map(|(sums, side)| sums.values[side][state].as_flattened()[d]).sum();
                let squares: f64 = of().map(|(sums, side)| sums.squares[side][state].as_flattened()[d]).sum();
                let variance = (squares / frames - (sum / frames) * (sum / frames)).max(1e-9);
                double::ln(TAU * variance) + 1.0
            });
            if frames > 0.0 { -0.5 * frames * dims.sum::<f64>() } else { 0.0 }
        })
        .sum()
}

/// The mean of a style's states.
fn mean_pose(model: &WalkModel, style: usize) -> RotationRow {
    let pose = Stream::Static as usize;
    let count = (SIDES * STATES) as f64;
    std::array::from_fn(|d| states().map(|(side, state)| model.means[style].means[side][state][pose][d] / count).sum())
}
