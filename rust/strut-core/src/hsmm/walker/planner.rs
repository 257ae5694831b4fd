//! The steps to come, as they are wanted: styles mixed, and states that last as long as they shall.

use super::HORIZON;
use super::durations::{Durations, STATE_FRAMES, lasting};
use super::voice::{PADDED, StateMeans, WalkVoices, swing};
use crate::hsmm::model::{SIDES, STATES, Side};
use std::sync::Arc;

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
    /// How far a state is on the way, by its middle. The specification has one share a step; with one a state the joints'
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
}

/// Plans steps by what is wanted of them.
#[derive(Clone, Debug)]
pub(super) struct Planner {
    voices: Arc<WalkVoices>,
    pub(super) weights: Weights,
    /// In the order of their first steps.
    pub(super) transitions: Vec<Transition>,
    /// What the durations of states are drawn by; without it they are the means.
    pub(super) seed: Option<u32>,
    pub(super) tempo: Option<Tempo>,
    /// Length of steps as a share of the style's.
    pub(super) stride: f32,
    pub(super) start: Start,
    /// Whether durations are held within what recorded walkers keep to.
    pub(super) limits: bool,
    /// A ring: the step of number n is in slot n mod the length.
    steps: Vec<PlannedStep>,
}

impl Planner {
    /// Of steps as the average of all styles has them.
    pub(super) fn new(voices: Arc<WalkVoices>) -> Self {
        let none = Weights([(); SIDES].map(|()| vec![0.0; voices.styles.len()]));
        let step = PlannedStep { number: u64::MAX, means: voices.average.means[0], durations: [0.0; STATES] };
        Self {
            weights: none,
            transitions: Vec::new(),
            seed: None,
            tempo: None,
            stride: 1.0,
            start: Start { first: 0, from: 1.0, to: 1.0 },
            limits: true,
            steps: vec![step; PLANNED],
            voices,
        }
    }

    /// A step that was planned.
    pub(super) fn step(&self, number: u64) -> &PlannedStep {
        &self.steps[slot_of(number)]
    }

    /// Forgets what is planned: something else is wanted.
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
        let voices = &*self.voices;
        let weight = |style: usize, state: usize| {
            self.transitions.iter().fold(self.weights.0[side][style], |from, t| {
                let share = t.share(number, state);
                if share <= 0.0 { from } else { (1.0 - share) * from + share * t.to.0[side][style] }
            })
        };
        let step = &mut self.steps[slot_of(number)];
        step.number = number;
        for (state, means) in step.means.iter_mut().enumerate() {
            *means = [[0.0; PADDED]; 3];
            let mixed = voices.mixed(|style| weight(style, state));
            let mut standing = [0.0; PADDED];
            for (weight, voice) in mixed.clone() {
                let sums = means.as_flattened_mut().iter_mut();
                sums.zip(voice.means[side][state].as_flattened()).for_each(|(sum, v)| *sum += weight * v);
                standing.iter_mut().zip(voice.standing).for_each(|(sum, v)| *sum += weight * v);
            }
            let walking = self.start.share(number, state);
            if walking < 1.0 || self.stride != 1.0 {
                swing(means, &standing, walking, self.stride);
            }
            step.durations[state] = voices.durations_of(mixed, side, self.limits)[state];
        }
        let variances = &voices.duration_variances[side];
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
pub(super) fn side_of(step: u64) -> Side {
    if step.is_multiple_of(2) { Side::Left } else { Side::Right }
}

/// Where a step is planned.
fn slot_of(step: u64) -> usize {
    (step % PLANNED as u64) as usize
}

/// A number of a normal distribution that is always the same for a state of a step: the sum of twelve even ones.
fn normal(seed: u32, step: u64, state: usize) -> f32 {
    let mut bits = u64::from(seed) << 32 ^ (step * STATES as u64 + state as u64);
    let even = (0..12).map(|_| {
        // SplitMix64.
        bits = bits.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = bits;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 40) as f32 / (1 << 24) as f32
    });
    even.sum::<f32>() - 6.0
}
