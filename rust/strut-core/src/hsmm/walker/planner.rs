//! Planning of the coming steps: mixed means and state durations.

use super::durations::{Durations, STATE_FRAMES, lasting};
use super::runtime_model::{PADDED, RuntimeWalkModel, StateMeans, swing};
use crate::hsmm::model::{SIDES, STATES, Side};
use crate::math::random::SplitMix64;
use std::sync::Arc;

/// Look-ahead of the synthesis, frames: with them the trajectory is within 0.1° of that of the whole walk on average.
pub const HORIZON: usize = 20;
/// Steps that may begin within the horizon, and the one before.
const PLANNED: usize = HORIZON / STATES + 2;
/// Steps that starting and stopping take.
const STARTING_STEPS: f32 = 2.0;
/// How much longer or shorter a step may be, as a share, to come nearer to the beat.
const CATCHING_UP: f64 = 0.15;

/// Weights of the styles, for the steps of either foot.
#[derive(Clone, Debug)]
pub(super) struct Weights(pub(super) [Vec<f32>; SIDES]);

/// A change of style that is spread over steps.
#[derive(Clone, Debug)]
pub(super) struct Transition {
    /// The first step that is in between.
    pub(super) first: u64,
    /// Steps in between.
    pub(super) steps: u32,
    pub(super) to: Weights,
}

impl Transition {
    /// Progress of the transition in the middle of a state, 0 to 1. With one share a state instead of one a step the joints'
    /// greatest acceleration is lower, by a fifth where it is highest.
    fn share(&self, step: u64, state: usize) -> f32 {
        let Some(steps) = step.checked_sub(self.first) else { return 0.0 };
        if steps >= u64::from(self.steps) {
            return 1.0;
        }
        (steps as f32 + (state as f32 + 0.5) / STATES as f32) / self.steps as f32
    }
}

/// Walking that begins or ends.
#[derive(Clone, Copy, Debug)]
pub(super) struct Start {
    /// The step that it begins with.
    pub(super) first: u64,
    /// How much of walking there was then, and will be: 0 is standing, 1 walking.
    pub(super) from: f32,
    pub(super) to: f32,
}

impl Start {
    /// How much of walking there is in a state.
    pub(super) fn share(&self, step: u64, state: usize) -> f32 {
        let Some(steps) = step.checked_sub(self.first) else { return self.from };
        let share = (steps as f32 + (state as f32 + 0.5) / STATES as f32) / STARTING_STEPS;
        self.from + share.min(1.0) * (self.to - self.from)
    }
}

/// Steps that all last as long.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tempo {
    /// Frames of a step.
    pub(super) frames: f32,
    /// A frame at which a step is to end, if it matters: so are all others then.
    pub(super) beat: Option<f64>,
}

impl Tempo {
    /// Frames of a step that begins at a frame: on the beat, or somewhat nearer to it than the step before.
    fn of_step(&self, begin: f64) -> f32 {
        let frames = f64::from(self.frames);
        let Some(beat) = self.beat else { return self.frames };
        let late = (begin - beat) / frames;
        let catching_up = late.round() - late;
        (frames * (1.0 + catching_up.clamp(-CATCHING_UP, CATCHING_UP))) as f32
    }
}

/// A step to come, or the current one, in its style.
#[derive(Clone, Debug)]
pub(super) struct PlannedStep {
    number: u64,
    pub(super) means: [StateMeans; STATES],
    pub(super) durations: Durations,
    /// How long the step should get, metres.
    pub(super) length: f32,
}

/// Plans the coming steps from the controls.
#[derive(Clone, Debug)]
pub(super) struct Planner {
    runtime: Arc<RuntimeWalkModel>,
    pub(super) weights: Weights,
    /// In the order of their first steps.
    pub(super) transitions: Vec<Transition>,
    /// Seed for sampled durations; `None` uses the means.
    pub(super) seed: Option<u32>,
    pub(super) tempo: Option<Tempo>,
    /// Length of steps as a share of the style's.
    pub(super) stride: f32,
    /// The share of their swing by which the legs make steps as long as that within the limits ([`super::step_length`]).
    pub(super) swing: f32,
    pub(super) start: Start,
    /// Whether durations are limited to the range of the recorded walks.
    pub(super) limits: bool,
    /// A ring: the step of number n is in slot n mod the length.
    steps: Vec<PlannedStep>,
}

impl Planner {
    /// Of steps as the average of all styles has them.
    pub(super) fn new(runtime: Arc<RuntimeWalkModel>) -> Self {
        let none = Weights([(); SIDES].map(|()| vec![0.0; runtime.styles.len()]));
        let step =
            PlannedStep { number: u64::MAX, means: runtime.average.means[0], durations: [0.0; STATES], length: 0.0 };
        Self {
            weights: none,
            transitions: Vec::new(),
            seed: None,
            tempo: None,
            stride: 1.0,
            swing: 1.0,
            start: Start { first: 0, from: 1.0, to: 1.0 },
            limits: true,
            steps: vec![step; PLANNED],
            runtime,
        }
    }

    /// A step that was planned.
    pub(super) fn step(&self, number: u64) -> &PlannedStep {
        &self.steps[slot_of(number)]
    }

    /// Discards the plan, after a control has changed.
    pub(super) fn forget(&mut self) {
        self.steps.iter_mut().for_each(|step| step.number = u64::MAX);
    }

    /// Transitions that are over at a step become the style that all begins with.
    pub(super) fn forget_transitions_before(&mut self, step: u64) {
        let over = self.transitions.iter().take_while(|t| t.share(step, 0) >= 1.0).count();
        if over > 0 {
            self.weights.clone_from(&self.transitions[over - 1].to);
            self.transitions.drain(..over);
        }
    }

    /// Mixes the means of a step that begins at a frame, if it is not planned yet.
    pub(super) fn plan(&mut self, number: u64, begin: f64) {
        if self.step(number).number == number {
            return;
        }
        let side = side_of(number) as usize;
        let runtime = &*self.runtime;
        let weight = |style: usize, state: usize| {
            self.transitions.iter().fold(self.weights.0[side][style], |from, t| {
                let share = t.share(number, state);
                if share <= 0.0 { from } else { (1.0 - share) * from + share * t.to.0[side][style] }
            })
        };
        let step = &mut self.steps[slot_of(number)];
        step.number = number;
        step.length = 0.0;
        let legs = if self.limits { self.stride * self.swing } else { self.stride };
        for (state, means) in step.means.iter_mut().enumerate() {
            *means = [[0.0; PADDED]; 3];
            let mixed = runtime.mixed(|style| weight(style, state));
            let mut standing = [0.0; PADDED];
            for (weight, runtime_style) in mixed.clone() {
                let sums = means.as_flattened_mut().iter_mut();
                sums.zip(runtime_style.means[side][state].as_flattened()).for_each(|(sum, v)| *sum += weight * v);
                standing.iter_mut().zip(runtime_style.standing).for_each(|(sum, v)| *sum += weight * v);
                let length =
                    weight * self.stride * runtime_style.step_length + self.stride * runtime_style.bend(weight);
                step.length += length / STATES as f32;
            }
            let walking = self.start.share(number, state);
            if walking < 1.0 || legs != 1.0 {
                swing(means, &standing, walking, legs);
            }
            step.durations[state] = runtime.durations_of(mixed, side, self.limits)[state];
        }
        let variances = &runtime.duration_variances[side];
        if let Some(seed) = self.seed {
            for (state, duration) in step.durations.iter_mut().enumerate() {
                *duration += variances[state].sqrt() * normal(seed, number, state);
            }
        }
        let [least, greatest] = STATE_FRAMES;
        step.durations = step.durations.map(|d| d.clamp(least, greatest));
        if let Some(tempo) = self.tempo {
            step.durations = lasting(&step.durations, tempo.of_step(begin), &[STATE_FRAMES; STATES], variances);
        }
    }
}

/// The foot that swings in a step.
pub(in crate::hsmm) fn side_of(step: u64) -> Side {
    if step.is_multiple_of(2) { Side::Left } else { Side::Right }
}

/// Where a step is planned.
fn slot_of(step: u64) -> usize {
    (step % PLANNED as u64) as usize
}

/// A number of a normal distribution that is always the same for a state of a step: the sum of twelve even ones.
fn normal(seed: u32, step: u64, state: usize) -> f32 {
    let mut random = SplitMix64::new(u64::from(seed) << 32 ^ (step * STATES as u64 + state as u64));
    (0..12).map(|_| random.share()).sum::<f32>() - 6.0
}
