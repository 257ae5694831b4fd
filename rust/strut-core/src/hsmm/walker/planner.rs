//! Planning of the next steps: mixed means and state durations.

use super::durations::{Durations, STATE_FRAMES, lasting};
use super::runtime_model::{PADDED, RuntimeWalkModel, StateMeans, swing};
use crate::hsmm::model::{SIDES, STATES, Side};
use crate::math::random::SplitMix64;
use std::sync::Arc;

/// Look-ahead of the synthesis, frames: the trajectory is then within 0.1° of that of the whole walk on average.
pub const HORIZON: usize = 20;
/// Number of steps that may begin within the horizon, and the one before.
const PLANNED: usize = HORIZON / STATES + 2;
/// Number of steps in which walking starts or stops.
const STARTING_STEPS: f32 = 2.0;
/// Greatest change of a step's duration for catching up with the beat, as a share.
const CATCHING_UP: f64 = 0.15;

/// Weights of the styles for the steps of either foot.
#[derive(Clone, Debug)]
pub(super) struct Weights(pub(super) [Vec<f32>; SIDES]);

/// A change of style over several steps.
#[derive(Clone, Debug)]
pub(super) struct Transition {
    /// The first intermediate step.
    pub(super) first: u64,
    /// Number of intermediate steps.
    pub(super) steps: u32,
    pub(super) to: Weights,
}

impl Transition {
    /// Progress of the transition in the middle of a state, 0 to 1. One value per state instead of one per step lowers the
    /// joints' greatest acceleration, by a fifth where it is highest.
    fn share(&self, step: u64, state: usize) -> f32 {
        let Some(steps) = step.checked_sub(self.first) else { return 0.0 };
        if steps >= u64::from(self.steps) {
            return 1.0;
        }
        (steps as f32 + (state as f32 + 0.5) / STATES as f32) / self.steps as f32
    }
}

/// Starting or stopping of the walk.
#[derive(Clone, Copy, Debug)]
pub(super) struct Start {
    /// The first step of the change.
    pub(super) first: u64,
    /// Initial and final share of walking: 0 is standing, 1 walking.
    pub(super) from: f32,
    pub(super) to: f32,
}

impl Start {
    /// Share of walking in a state.
    pub(super) fn share(&self, step: u64, state: usize) -> f32 {
        let Some(steps) = step.checked_sub(self.first) else { return self.from };
        let share = (steps as f32 + (state as f32 + 0.5) / STATES as f32) / STARTING_STEPS;
        self.from + share.min(1.0) * (self.to - self.from)
    }
}

/// A constant duration of steps.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tempo {
    /// Frames of a step.
    pub(super) frames: f32,
    /// A frame at which a step must end, and all others in phase with it; `None` if the phase is free.
    pub(super) beat: Option<f64>,
}

impl Tempo {
    /// Duration of a step that begins at a frame: it ends on the beat, or nearer to it than the step before.
    fn of_step(&self, begin: f64) -> f32 {
        let frames = f64::from(self.frames);
        let Some(beat) = self.beat else { return self.frames };
        let late = (begin - beat) / frames;
        let catching_up = late.round() - late;
        (frames * (1.0 + catching_up.clamp(-CATCHING_UP, CATCHING_UP))) as f32
    }
}

/// A future step, or the current one, in its style.
#[derive(Clone, Debug)]
pub(super) struct PlannedStep {
    number: u64,
    pub(super) means: [StateMeans; STATES],
    pub(super) durations: Durations,
    /// Target length of the step, metres.
    pub(super) length: f32,
}

/// Plans the next steps from the controls.
#[derive(Clone, Debug)]
pub(super) struct Planner {
    runtime: Arc<RuntimeWalkModel>,
    pub(super) weights: Weights,
    /// Sorted by their first steps.
    pub(super) transitions: Vec<Transition>,
    /// Seed for sampled durations; `None` uses the means.
    pub(super) seed: Option<u32>,
    pub(super) tempo: Option<Tempo>,
    /// Length of steps as a share of the style's.
    pub(super) stride: f32,
    /// Correction factor of the legs' swing for the target step length ([`super::step_length`]); used with the limits.
    pub(super) swing: f32,
    pub(super) start: Start,
    /// Whether durations are limited to the range of the recorded walks.
    pub(super) limits: bool,
    /// Ring buffer: step n is in slot n mod the length.
    steps: Vec<PlannedStep>,
}

impl Planner {
    /// Creates a planner of steps in the average of all styles.
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

    /// Returns a planned step.
    pub(super) fn step(&self, number: u64) -> &PlannedStep {
        &self.steps[slot_of(number)]
    }

    /// Discards the plan after a change of a control.
    pub(super) fn forget(&mut self) {
        self.steps.iter_mut().for_each(|step| step.number = u64::MAX);
    }

    /// Makes transitions that are completed at a step the initial weights.
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

/// Slot of a step in the ring.
fn slot_of(step: u64) -> usize {
    (step % PLANNED as u64) as usize
}

/// An approximately normal number that is a function of the seed, the step and the state: the sum of twelve uniform ones.
fn normal(seed: u32, step: u64, state: usize) -> f32 {
    let mut random = SplitMix64::new(u64::from(seed) << 32 ^ (step * STATES as u64 + state as u64));
    (0..12).map(|_| random.share()).sum::<f32>() - 6.0
}
