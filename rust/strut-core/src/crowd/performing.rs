//! An agent that performs a motion, which is transformed over the ground.

use super::agent::Agent;
use super::errand::{Errand, Ground, Start};
use super::grid::Others;
use super::steering::{self, AgentState, FORESEEN, OVERLAPPING, SteeringInput, facing};
use crate::hsmm::MAX_TURN;
use crate::humanoid::{Pose, Proportions};
use crate::kinematics::{Soles, WorldPose, world_from_local};
use crate::math::float_funcs::{half_life_share, sin_cos};
use crate::math::{Quat, Vec2, Vec3};
use crate::pose_vector::Placement;
use crate::transfer::{Performer, Predictions};
use std::f32::consts::PI;
use std::sync::Arc;

/// Ticks per second of performers.
pub const TICK_HZ: f32 = 30.0;

/// Half-life with which weights approach those of a place, seconds: styles change within a step, without a jump.
const HALF_LIFE_SECS: f32 = 0.15;
/// Weights nearer than this to those of the place are set to them.
const NEAR: f32 = 1e-4;
/// How far ahead of the performer the field is evaluated, seconds.
const LOOK_AHEAD_SECS: f32 = 0.3;
/// A step ends after this many ticks even if no foot is put down, as in a spin of a dance: one second.
const LONGEST_STEP: u32 = TICK_HZ as u32;
/// A performer that travels this far in a step, metres, turns as much as a foot can. With less distance it turns less, and
/// below the least distance it does not turn.
const FULL_STEP: f32 = 0.4;
const LEAST_STEP: f32 = 0.04;
/// Turn rate on the planted foot, rad/s.
const TURN_RATE: f32 = 0.9;

/// Planar transform from the performed motion to the ground: a rotation about +Y, then a translation.
#[derive(Clone, Copy, Debug)]
struct GroundTransform {
    /// Radians to the left.
    angle: f32,
    by: Vec2,
}

impl GroundTransform {
    /// Rotates the transform further about a place of the ground.
    fn turned(self, angle: f32, about: Vec2) -> Self {
        Self { angle: self.angle + angle, by: about + rotated(self.by - about, angle) }
    }

    fn pose(&self, own: &Pose) -> Pose {
        let mut pose = *own;
        let at = rotated(Vec2::new(own.root.x, own.root.z), self.angle) + self.by;
        pose.root = Vec3::new(at.x, own.root.y, at.y);
        pose.rotations[0] = Quat::from_rotation_y(self.angle) * own.rotations[0];
        pose
    }
}

/// Rotates a place [x, z] to the left about the origin.
fn rotated(at: Vec2, angle: f32) -> Vec2 {
    let (sin, cos) = sin_cos(angle);
    Vec2::new(cos * at.x + sin * at.y, cos * at.y - sin * at.x)
}

/// The motion that the agents of a crowd perform.
#[derive(Clone, Debug)]
pub struct PerformedMotion {
    pub(super) predictions: Arc<Predictions>,
    soles: Soles,
}

impl PerformedMotion {
    pub(super) fn new(predictions: Arc<Predictions>) -> Self {
        Self { soles: Soles::new(predictions.proportions()), predictions }
    }
}

/// An agent that performs a motion.
#[derive(Clone, Debug)]
pub struct Performing {
    performer: Performer,
    /// Its own time, seconds, and the pose of the frame before the one that is due then or later.
    now_secs: f64,
    before: Pose,
    placed: GroundTransform,
    pose: Pose,
    world: WorldPose,
    start: Start,
    errand: Errand,
    /// The foot that was put down last, the ticks since then, and the place where that was.
    foot: Option<usize>,
    ticks: u32,
    from: Vec2,
    /// Remaining turn of this step, radians.
    turn: f32,
    /// Velocity over the last step, m/s along x and z.
    velocity: Vec2,
    /// Weights of the place.
    wanted: Vec<f32>,
}

impl Agent for Performing {
    type Shared = PerformedMotion;

    fn styles(motion: &Self::Shared) -> usize {
        motion.predictions.styles()
    }

    fn proportions(motion: &Self::Shared) -> &Proportions {
        motion.predictions.proportions()
    }

    /// The agent begins at a random frame of the input.
    fn new(motion: &Self::Shared, seed: u32, index: usize, ground: &Ground, weights: &mut [f32]) -> Self {
        let predictions = &motion.predictions;
        let mut start = Start::new(seed, index);
        let heading = start.heading();
        let placement = Placement { x: start.at.x, z: start.at.y, heading };
        let errand = Errand::new(&mut start.random);
        let mut performer = Performer::new(Arc::clone(predictions), Some(placement));
        performer.begin_at(start.random.below(predictions.period()));
        ground.field.write_weights(start.at, weights);
        // A field's weights are always valid for a performer.
        let _ = performer.set_styles(weights);
        let pose = performer.advance().pose;
        Self {
            world: world_from_local(predictions.proportions(), &pose),
            performer,
            now_secs: 0.0,
            before: pose,
            placed: GroundTransform { angle: 0.0, by: Vec2::ZERO },
            pose,
            from: start.at,
            start,
            errand,
            foot: None,
            ticks: 0,
            turn: 0.0,
            velocity: Vec2::ZERO,
            wanted: weights.to_vec(),
        }
    }

    fn tick(&mut self, motion: &Self::Shared, ground: &Ground, others: &mut Others, weights: &mut [f32]) {
        let proportions = motion.predictions.proportions();
        self.style(ground, weights);
        self.perform();
        let planted = self.performer.frame().planted;
        self.begin_step(planted, ground, others);
        self.placed.by += steering::aside(&self.state(), others.within(OVERLAPPING));
        self.pose_on_ground(proportions);
        self.turn_on(planted, &motion.soles, proportions);
    }

    /// The direction of motion is that of the last step, whatever the heading.
    fn state(&self) -> AgentState {
        let speed = self.velocity.length();
        let ahead = facing(self.performer.heading() + self.placed.angle);
        let facing = if speed > 0.0 { self.velocity / speed } else { ahead };
        AgentState { at: self.at(), facing, speed }
    }

    fn pose(&self) -> &Pose {
        &self.pose
    }

    fn world(&self) -> WorldPose {
        self.world
    }
}

impl Performing {
    /// Which feet are held in place, left and right.
    #[cfg(test)]
    fn planted(&self) -> [bool; 2] {
        self.performer.frame().planted
    }

    fn at(&self) -> Vec2 {
        Vec2::new(self.pose.root.x, self.pose.root.z)
    }

    /// Moves the weights towards those of the place ahead.
    fn style(&mut self, ground: &Ground, weights: &mut [f32]) {
        ground.field.write_weights(self.at() + LOOK_AHEAD_SECS * self.velocity, &mut self.wanted);
        if *weights == *self.wanted {
            return;
        }
        let share = half_life_share(1.0 / TICK_HZ, HALF_LIFE_SECS);
        for (weight, wanted) in weights.iter_mut().zip(&self.wanted) {
            let off = wanted - *weight;
            *weight = if off.abs() < NEAR { *wanted } else { *weight + share * off };
        }
        let _ = self.performer.set_styles(weights);
    }

    /// Advances the performer's time; the present pose lies between two frames, whose durations depend on the style.
    fn perform(&mut self) {
        self.now_secs += f64::from(1.0 / TICK_HZ);
        while self.performer.frame().time_out_secs < self.now_secs {
            self.before = self.performer.frame().pose;
            self.performer.advance();
        }
    }

    fn pose_on_ground(&mut self, proportions: &Proportions) {
        let frame = self.performer.frame();
        let ahead = ((frame.time_out_secs - self.now_secs) / f64::from(frame.dt_secs)) as f32;
        let own = self.before.lerp(&frame.pose, (1.0 - ahead).clamp(0.0, 1.0));
        self.pose = self.placed.pose(&own);
        self.world = world_from_local(proportions, &self.pose);
    }

    /// Chooses the next turn when a foot is put down.
    fn begin_step(&mut self, planted: [bool; 2], ground: &Ground, others: &mut Others) {
        self.ticks += 1;
        let foot = match planted {
            [true, false] => Some(0),
            [false, true] => Some(1),
            _ => self.foot,
        };
        if foot == self.foot && self.ticks < LONGEST_STEP {
            return;
        }
        let at = self.at();
        let way = at - self.from;
        self.velocity = way * (TICK_HZ / self.ticks as f32);
        (self.foot, self.ticks, self.from, self.turn) = (foot, 0, at, 0.0);
        let me = self.state();
        let (wander, target) = self.errand.next(at, me.facing, ground, &mut self.start.random);
        let length = way.length();
        if length > LEAST_STEP {
            // A smaller turn on a short step needs as wide a circle as a full turn on a full step.
            let planned = length.max(FULL_STEP);
            let input = SteeringInput { wander, target, length: planned, stood: 0.0, radius: ground.radius };
            self.turn = steering::turn(&me, &input, others.within(FORESEEN)) * (length / FULL_STEP).min(1.0);
        }
    }

    /// Turns by a part of the remaining turn about the planted foot, or about the hips in flight. With both feet planted it
    /// waits, as one of them would slide.
    fn turn_on(&mut self, planted: [bool; 2], soles: &Soles, proportions: &Proportions) {
        let most = TURN_RATE / TICK_HZ;
        let angle = self.turn.clamp(-most, most);
        if angle == 0.0 || planted == [true; 2] {
            return;
        }
        let about = match planted.iter().position(|planted| *planted) {
            Some(side) => soles.of(&self.world, side).pivot(),
            None => self.pose.root,
        };
        self.turn -= angle;
        self.placed = self.placed.turned(angle, Vec2::new(about.x, about.z));
        if self.placed.angle.abs() > PI {
            self.placed.angle -= self.placed.angle.signum() * 2.0 * PI;
        }
        self.velocity = rotated(self.velocity, angle);
        self.pose_on_ground(proportions);
    }
}

const _: () = assert!(TURN_RATE > MAX_TURN, "a step takes less than a second");

#[cfg(test)]
mod tests;
