//! An agent that walks, with its own goal and random state.

use super::agent::Agent;
use super::errand::{Errand, Ground, Start};
use super::grid::Others;
use super::steering::{self, AgentState, FORESEEN, OVERLAPPING, Pace, SteeringInput, facing};
use crate::hsmm::{RATE_HZ, RuntimeWalkModel, STRIDE, Walker};
use crate::humanoid::{Pose, Proportions};
use crate::kinematics::WorldPose;
use crate::math::random::SplitMix64;
use crate::math::{Vec2, Vec3};
use std::sync::Arc;

/// Frames of a cycle; each agent begins at a random one.
const CYCLE: usize = 32;

/// How far ahead of the agent the field is evaluated for a step, seconds.
const LOOK_AHEAD_SECS: f32 = 0.3;
/// Initial length of a step, metres, and the least that is accepted as a measured one.
const STEP_LENGTH: f32 = 0.7;
const LEAST_STEP_LENGTH: f32 = 0.3;
/// Initial speed, m/s.
const SPEED: f32 = 1.2;

/// An agent that walks by the model of walk styles.
#[derive(Clone, Debug)]
pub struct Walking {
    pub(super) walker: Walker,
    random: SplitMix64,
    errand: Errand,
    pace: Pace,
    /// Time that the agent has been standing: a random share per step.
    stood: f32,
    /// The step that was steered last, the place where it began, and the frames since then.
    step: u64,
    from: Vec2,
    frames: u32,
    /// Length and speed of the last step that was walked, metres and m/s.
    length: f32,
    cruise: f32,
    /// Speed of the last step, m/s.
    speed: f32,
}

impl Agent for Walking {
    type Shared = Arc<RuntimeWalkModel>;

    fn styles(model: &Self::Shared) -> usize {
        model.styles()
    }

    fn proportions(model: &Self::Shared) -> &Proportions {
        model.proportions()
    }

    fn new(model: &Self::Shared, seed: u32, index: usize, ground: &Ground, weights: &mut [f32]) -> Self {
        let mut start = Start::new(seed, index);
        let at = start.at;
        let mut walker = Walker::new(Arc::clone(model));
        walker.set_variation(Some(start.random.next_u64() as u32));
        ground.field.write_weights(at, weights);
        // A field's weights are always valid for a walker.
        let _ = walker.set_styles(weights);
        walker.reset(Vec3::new(at.x, 0.0, at.y), start.heading());
        let mut random = start.random;
        (0..=random.below(CYCLE)).for_each(|_| _ = walker.advance());
        let mut agent = Self {
            step: walker.next_step(),
            walker,
            errand: Errand::new(&mut random),
            random,
            pace: Pace::Walks,
            stood: 0.0,
            from: at,
            frames: 0,
            length: STEP_LENGTH,
            cruise: SPEED,
            speed: SPEED,
        };
        agent.from = agent.state().at;
        agent
    }

    fn state(&self) -> AgentState {
        let root = self.walker.pose().root;
        AgentState { at: Vec2::new(root.x, root.z), facing: facing(self.walker.heading()), speed: self.speed }
    }

    fn tick(&mut self, _: &Self::Shared, ground: &Ground, others: &mut Others, weights: &mut [f32]) {
        self.frames += 1;
        if self.walker.next_step() != self.step {
            // Uses the walking speed: with its own speed, a standing agent would never find a free path.
            let me = AgentState { speed: self.cruise, ..self.state() };
            self.begin_step(&me, ground, others, weights);
        }
        self.walker.shift(steering::aside(&self.state(), others.within(OVERLAPPING)));
        self.walker.advance();
    }

    fn pose(&self) -> &Pose {
        self.walker.pose()
    }

    fn world(&self) -> WorldPose {
        self.walker.world()
    }
}

impl Walking {
    /// Chooses turn and pace, and takes the styles of the place where the step leads.
    fn begin_step(&mut self, me: &AgentState, ground: &Ground, others: &mut Others, weights: &mut [f32]) {
        let length = me.at.distance(self.from);
        self.speed = length * RATE_HZ / self.frames as f32;
        if self.pace == Pace::Walks && length > LEAST_STEP_LENGTH {
            (self.length, self.cruise) = (length, self.speed);
        }
        (self.step, self.from, self.frames) = (self.walker.next_step(), me.at, 0);
        let (wander, target) = self.errand.next(me.at, me.facing, ground, &mut self.random);
        let input = SteeringInput { wander, target, length: self.length, stood: self.stood, radius: ground.radius };
        let (turn, pace) = steering::step(me, &input, others.within(FORESEEN));
        self.walker.set_turn(turn);
        self.set_pace(pace);
        if ground.field.write_weights(me.at + LOOK_AHEAD_SECS * self.speed * me.facing, weights) {
            let _ = self.walker.set_styles(weights);
        }
    }

    /// Sets the pace. Standing times grow randomly: otherwise two agents would start again at the same time.
    fn set_pace(&mut self, pace: Pace) {
        self.stood = if pace == Pace::Stands { self.stood + self.random.share() } else { 0.0 };
        if pace != self.pace {
            self.walker.set_stride(if pace == Pace::Walks { 1.0 } else { STRIDE[0] });
            self.walker.set_walking(pace != Pace::Stands);
            self.pace = pace;
        }
    }
}
