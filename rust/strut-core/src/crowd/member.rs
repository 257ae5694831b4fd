//! One of the crowd: a walker with a mind of its own.

use super::field::Field;
use super::route::Route;
use super::steering::{self, Figure, Intention, Pace, facing};
use crate::hsmm::{RATE_HZ, RuntimeWalkModel, STRIDE, Walker};
use crate::math::random::SplitMix64;
use crate::math::{Vec2, Vec3};
use std::f32::consts::{PI, TAU};
use std::sync::Arc;

/// Ground for everybody, m².
pub(super) const ROOM: f32 = 4.0;
/// The same where they begin: away from the edge.
const STARTING_ROOM: f32 = 3.0;
/// The golden angle, radians: places along a spiral by it are evenly spread (Vogel, "A better way to construct the sunflower
/// head", 1979).
const GOLDEN_ANGLE: f32 = 2.399_963_2;
/// How far from there somebody begins at most along either axis, metres.
const SCATTER: f32 = 0.3;
/// Farther from the middle everybody begins on a way back, metres.
const HOME: f32 = 4.0;
/// Frames of a cycle, within which somebody begins.
const CYCLE: usize = 32;

/// Share of a wandering turn that remains a step later, and the greatest that is added, radians.
const WANDER_REMAINS: f32 = 0.8;
const WANDER: f32 = 0.16;
/// Goals are so far from the middle, in radii of the ground: ways between places all over it would lead through the middle more
/// often than not.
const GOALS: [f32; 2] = [0.6, 1.0];
/// A goal is reached within this, metres, and given up after so many steps: who turns as much as a foot can may walk round it.
const REACHED: f32 = 2.5;
const PATIENCE: u32 = 40;
/// How far ahead the field is looked at for a step, seconds.
const LOOK_AHEAD_SECS: f32 = 0.3;
/// Length of a step before one was walked, metres, and the least that is taken for one.
const STEP_LENGTH: f32 = 0.7;
const LEAST_STEP_LENGTH: f32 = 0.3;
/// Speed before a step was walked, m/s.
const SPEED: f32 = 1.2;

/// What there is beside the others.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ground<'a> {
    pub(super) radius: f32,
    pub(super) count: usize,
    pub(super) field: &'a Field,
    pub(super) route: &'a Route,
}

/// One of the crowd.
#[derive(Clone, Debug)]
pub(super) struct Member {
    pub(super) walker: Walker,
    random: SplitMix64,
    /// Turn of a step by which they wander, radians.
    wander: f32,
    /// Where they go, in radii of the ground from its middle, and the steps that they have gone there.
    goal: Vec2,
    gone: u32,
    /// Where they walk beside a route, 0 to 1.
    lane: f32,
    pace: Pace,
    /// Steps that they have stood.
    stood: f32,
    /// The step that was steered last, where it began, and the frames since then.
    step: u64,
    from: Vec2,
    frames: u32,
    /// Length of a step and speed of the last one that was walked, metres and m/s.
    length: f32,
    cruise: f32,
    /// Speed of the last step, m/s.
    speed: f32,
}

impl Member {
    /// Number `index` of the crowd of a seed; writes the weights that they walk with.
    pub(super) fn new(
        model: &Arc<RuntimeWalkModel>,
        seed: u32,
        index: usize,
        field: &Field,
        weights: &mut [f32],
    ) -> Self {
        let mut random = SplitMix64::new(u64::from(seed) << 32 ^ index as u64);
        let turned = TAU * SplitMix64::new(u64::from(seed)).share();
        let from_middle = (STARTING_ROOM / PI * (index as f32 + 0.5)).sqrt();
        let scatter = [(); 2].map(|()| SCATTER * (2.0 * random.share() - 1.0));
        let at = from_middle * facing(turned + index as f32 * GOLDEN_ANGLE) + Vec2::from(scatter);
        let mut walker = Walker::new(Arc::clone(model));
        walker.set_variation(Some(random.next_u64() as u32));
        field.write_weights(at, weights);
        // A field's weights are within those of a walker.
        let _ = walker.set_styles(weights);
        let heading = PI * (2.0 * random.share() - 1.0);
        let leaves = facing(heading).dot(at) > 0.0 && from_middle > HOME;
        walker.reset(Vec3::new(at.x, 0.0, at.y), if leaves { heading + PI } else { heading });
        (0..=random.below(CYCLE)).for_each(|_| _ = walker.advance());
        let mut member = Self {
            step: walker.next_step(),
            walker,
            lane: random.share(),
            goal: goal(&mut random),
            gone: 0,
            random,
            wander: 0.0,
            pace: Pace::Walks,
            stood: 0.0,
            from: at,
            frames: 0,
            length: STEP_LENGTH,
            cruise: SPEED,
            speed: SPEED,
        };
        member.from = member.figure().at;
        member
    }

    /// As others see them.
    pub(super) fn figure(&self) -> Figure {
        let root = self.walker.pose().root;
        Figure { at: Vec2::new(root.x, root.z), facing: facing(self.walker.heading()), speed: self.speed }
    }

    /// Goes on by a frame among others; changes the weights that they walk with.
    pub(super) fn tick(&mut self, ground: &Ground, others: &[Figure], weights: &mut [f32]) {
        self.frames += 1;
        if self.walker.next_step() != self.step {
            // As if nothing held them up: else whoever stands would never see that the way is free.
            let me = Figure { speed: self.cruise, ..self.figure() };
            self.begin_step(&me, ground, others, weights);
        }
        self.walker.shift(steering::aside(&self.figure(), others));
        self.walker.advance();
    }

    /// Turns, and takes the styles of where the step leads.
    fn begin_step(&mut self, me: &Figure, ground: &Ground, others: &[Figure], weights: &mut [f32]) {
        let length = me.at.distance(self.from);
        self.speed = length * RATE_HZ / self.frames as f32;
        if self.pace == Pace::Walks && length > LEAST_STEP_LENGTH {
            (self.length, self.cruise) = (length, self.speed);
        }
        (self.step, self.from, self.frames) = (self.walker.next_step(), me.at, 0);
        self.wander = WANDER_REMAINS * self.wander + WANDER * (2.0 * self.random.share() - 1.0);
        self.gone += 1;
        if self.gone > PATIENCE || me.at.distance(ground.radius * self.goal) < REACHED {
            (self.goal, self.gone) = (goal(&mut self.random), 0);
        }
        let on_route = ground.route.target(me.at, me.facing, self.lane, ground.count);
        let intention = Intention {
            wander: self.wander,
            target: on_route.unwrap_or(ground.radius * self.goal),
            length: self.length,
            stood: self.stood,
            radius: ground.radius,
        };
        let (turn, pace) = steering::step(me, &intention, others);
        self.walker.set_turn(turn);
        self.set_pace(pace);
        if ground.field.write_weights(me.at + LOOK_AHEAD_SECS * self.speed * me.facing, weights) {
            let _ = self.walker.set_styles(weights);
        }
    }

    /// Walks on with a pace. How long somebody stands at most is drawn by lot: else two would go on at the same time.
    fn set_pace(&mut self, pace: Pace) {
        self.stood = if pace == Pace::Stands { self.stood + self.random.share() } else { 0.0 };
        if pace != self.pace {
            self.walker.set_stride(if pace == Pace::Walks { 1.0 } else { STRIDE[0] });
            self.walker.set_walking(pace != Pace::Stands);
            self.pace = pace;
        }
    }
}

/// A place to go to, evenly distributed over a ring, in radii of the ground from its middle.
fn goal(random: &mut SplitMix64) -> Vec2 {
    let [least, greatest] = GOALS.map(|radius| radius * radius);
    (least + (greatest - least) * random.share()).sqrt() * facing(TAU * random.share())
}
