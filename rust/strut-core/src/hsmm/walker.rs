//! Endless walk synthesis, frame by frame; controls take effect in the next frame (`docs/methods/hsmm.md` §8, §9 and §11).

mod controls;
mod durations;
mod planner;
mod runtime_model;
mod step_length;
mod walked_length;

pub use controls::{MAX_TRANSITIONS, MAX_TURN, MAX_WEIGHT, STEP_FRAMES, STRIDE, WeightsError};
pub(super) use durations::counted_end;
pub use planner::HORIZON;
pub(super) use planner::side_of;
pub use runtime_model::RuntimeWalkModel;
pub(super) use runtime_model::least_delta_variance;

use super::RATE_HZ;
use super::joint_range::limited;
use super::mlpg::{CostToGo, FrameTerms, Term};
use super::model::{STATES, Side, Stream};
use crate::humanoid::Pose;
use crate::kinematics::WorldPose;
use crate::kinematics::root_path::RootPath;
use crate::math::float_funcs::wrap_angle;
use crate::math::lanes::{Lane, WIDTH};
use crate::math::{Vec2, Vec3, exp_map};
use planner::{Planner, Start};
use runtime_model::{PADDED, Padded, StateMeans};
use std::sync::Arc;
use step_length::{StepLength, WalkedFrame};

const LANES: usize = PADDED / WIDTH;

/// Position of a frame: its step and state, and when they began, in frames.
#[derive(Clone, Copy, Debug, Default)]
struct Position {
    step: u64,
    /// Unrounded.
    step_begin: f64,
    state: usize,
    /// Beginning of the state, rounded and unrounded.
    begin: u64,
    reckoned: f64,
}

/// The state of a frame: its means and their weights.
#[derive(Clone, Copy, Debug)]
struct Frame<'a> {
    means: &'a StateMeans,
    weights: &'a StateMeans,
}

impl Frame<'_> {
    fn term(&self, part: Stream, l: usize) -> Term<Lane> {
        Term { mean: Lane::of(&self.means[part as usize], l), weight: Lane::of(&self.weights[part as usize], l) }
    }
}

/// The terms of a frame that follows another.
fn terms(before: &Frame, frame: &Frame, l: usize) -> FrameTerms<Lane> {
    FrameTerms {
        pose: frame.term(Stream::Static, l),
        velocity: before.term(Stream::Delta, l),
        acceleration: before.term(Stream::DeltaDelta, l),
    }
}

/// The cost to go of all frames after the first.
fn cost_to_go(frames: &[Frame], l: usize) -> CostToGo<Lane> {
    frames.windows(2).rev().fold(CostToGo::default(), |rest, pair| rest.with(&terms(&pair[0], &pair[1], l)).0)
}

/// The synthesiser of one character's walk.
#[derive(Clone, Debug)]
pub struct Walker {
    runtime: Arc<RuntimeWalkModel>,
    planner: Planner,
    /// Turn per step, radians.
    turn: f32,
    heading: f32,
    frame: u64,
    position: Position,
    /// The last two frames, and the side, the state and the means of the last one.
    emitted: [Padded; 2],
    last: (usize, usize, StateMeans),
    /// Steps and states of the last frame and of those within the horizon.
    path: Vec<(u64, usize)>,
    root: RootPath,
    pose: Pose,
    step_length: StepLength,
}

impl Walker {
    /// Creates a walker in the average of all styles, from the origin along +Z.
    pub fn new(runtime: Arc<RuntimeWalkModel>) -> Self {
        let mut walker = Self {
            planner: Planner::new(Arc::clone(&runtime)),
            turn: 0.0,
            heading: 0.0,
            frame: 0,
            position: Position::default(),
            emitted: [[0.0; PADDED]; 2],
            last: (0, 0, [[0.0; PADDED]; 3]),
            path: Vec::with_capacity(HORIZON + 1),
            root: RootPath::new(&runtime.proportions),
            pose: Pose::default(),
            step_length: StepLength::default(),
            runtime,
        };
        walker.begin();
        walker
    }

    /// Restarts at a place with a heading; styles and controls are kept.
    pub fn reset(&mut self, at: Vec3, heading: f32) {
        self.root.reset(at);
        self.heading = wrap_angle(heading);
        let to = self.planner.start.to;
        self.planner.start = Start { first: 0, from: to, to };
        self.begin();
    }

    /// Number of the last frame's step, and the foot that swings in it.
    pub fn step(&self) -> (u64, Side) {
        (self.path[0].0, side_of(self.path[0].0))
    }

    /// Number of the next frame's step: the first that can be planned.
    pub fn next_step(&self) -> u64 {
        self.position.step
    }

    /// State of the last frame, 0 to 4.
    pub fn state(&self) -> usize {
        self.path[0].1
    }

    /// Durations of the states of the last frame's step, frames.
    pub fn durations(&self) -> &[f32; STATES] {
        &self.planner.step(self.path[0].0).durations
    }

    /// Whether the left and the right foot are on the ground in the last frame.
    pub fn planted(&self) -> [bool; 2] {
        self.root.planted()
    }

    /// Heading of the body, radians about +Y from +Z; positive is to the left.
    pub fn heading(&self) -> f32 {
        self.heading
    }

    /// Shifts the body from the next frame on, [x, z] in metres; its foot slides by the same distance.
    pub(crate) fn shift(&mut self, by: Vec2) {
        self.root.shift(by);
    }

    /// World transforms of the last frame's joints.
    pub fn world(&self) -> WorldPose {
        self.root.world()
    }

    /// The last frame.
    pub fn pose(&self) -> &Pose {
        &self.pose
    }

    /// Synthesises the next frame.
    pub fn advance(&mut self) -> &Pose {
        self.follow_path();
        let row = self.next_row();
        self.emitted = [self.emitted[1], row];
        self.remember_means();
        let mut rotations = self.runtime.reference;
        for (j, q) in rotations.iter_mut().enumerate() {
            let of = |d: usize| {
                let x = row[3 * j + d];
                if self.planner.limits { limited(x, self.runtime.range[3 * j + d]) } else { x }
            };
            *q = *q * exp_map::exp(Vec3::new(of(0), of(1), of(2)));
        }
        self.pose = Pose { root: Vec3::ZERO, rotations };
        let (step, state) = self.path[0];
        let frames = self.durations().iter().sum::<f32>();
        let walking = self.planner.start.share(step, state);
        self.heading = wrap_angle(self.heading + walking * self.turn / frames);
        self.root.place(&mut self.pose, side_of(step), self.heading, 1.0 / RATE_HZ);
        self.follow_length(step, walking);
        &self.pose
    }

    /// Updates the step-length correction after a frame; `walking` is the share of walking in it.
    fn follow_length(&mut self, step: u64, walking: f32) {
        // Lengths were measured with the limits on.
        let follows = self.runtime.has_step_lengths && self.planner.limits && walking == 1.0;
        let length = follows.then(|| self.planner.step(step).length.max(0.0));
        if let Some(swing) = self.step_length.advance(WalkedFrame { step, length, place: self.pose.root }) {
            self.planner.swing = swing;
            self.planner.forget();
        }
    }

    /// Foot, point of its sole, and place in the world of the ground contact.
    pub fn contact(&self) -> Option<(usize, usize, Vec3)> {
        self.root.contact()
    }

    /// Synthesises two frames that are not shown, so that the first shown frame has predecessors.
    fn begin(&mut self) {
        (self.frame, self.position) = (0, Position::default());
        self.step_length = StepLength::default();
        self.planner.swing = 1.0;
        self.planner.forget();
        self.follow_path();
        self.emitted = self.first_rows();
        self.follow_path();
        self.remember_means();
    }

    /// Computes the path from this frame on, and sets the position to that of the next frame.
    fn follow_path(&mut self) {
        self.planner.forget_transitions_before(self.position.step);
        self.path.clear();
        let mut at = self.position;
        for frame in self.frame..=self.frame + HORIZON as u64 {
            loop {
                self.planner.plan(at.step, at.step_begin);
                let end = at.reckoned + f64::from(self.planner.step(at.step).durations[at.state]);
                let counted = counted_end(at.begin, end);
                if frame < counted {
                    break;
                }
                (at.begin, at.reckoned, at.state) = (counted, end, at.state + 1);
                if at.state == STATES {
                    (at.step, at.step_begin, at.state) = (at.step + 1, end, 0);
                }
            }
            self.path.push((at.step, at.state));
            if frame == self.frame + 1 {
                self.position = at;
            }
        }
        self.frame += 1;
    }

    /// The last frame, whose state is stored, and those of the path.
    fn frames(&self) -> [Frame<'_>; HORIZON + 2] {
        let (side, state, means) = &self.last;
        let frame =
            |side: usize, state: usize, means| Frame { means, weights: &self.runtime.inverse_variances[side][state] };
        let last = frame(*side, *state, means);
        std::array::from_fn(|i| {
            let Some((number, state)) = i.checked_sub(1).map(|t| self.path[t]) else { return last };
            frame(side_of(number) as usize, state, &self.planner.step(number).means[state])
        })
    }

    /// The first frame of the most likely trajectory along the path, given the previous frames.
    fn next_row(&self) -> Padded {
        let frames = self.frames();
        let mut row = [0.0; PADDED];
        for l in 0..LANES {
            let (_, choice) = cost_to_go(&frames[1..], l).with(&terms(&frames[0], &frames[1], l));
            choice.after(self.emitted.each_ref().map(|row| Lane::of(row, l))).write(&mut row, l);
        }
        row
    }

    /// The first two frames of the most likely trajectory along the path without previous frames: there are no deltas before
    /// its third frame.
    fn first_rows(&self) -> [Padded; 2] {
        let frames = self.frames();
        let mut rows = [[0.0; PADDED]; 2];
        for l in 0..LANES {
            let pose = |frame: &Frame| FrameTerms { pose: frame.term(Stream::Static, l), ..FrameTerms::default() };
            let (rest, second) = cost_to_go(&frames[2..], l).with(&pose(&frames[2]));
            let (_, first) = rest.with(&pose(&frames[1]));
            let c = first.after([Lane::default(); 2]);
            c.write(&mut rows[0], l);
            second.after([Lane::default(), c]).write(&mut rows[1], l);
        }
        rows
    }

    /// Stores this frame's means for the next frame's system.
    fn remember_means(&mut self) {
        let (number, state) = self.path[0];
        self.last = (side_of(number) as usize, state, self.planner.step(number).means[state]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hsmm::mlpg::Banded;
    use crate::hsmm::model::SIDES;
    use crate::hsmm::tests::walker;
    use std::f32::consts::PI;

    /// The first two frames along the path by the banded system in double precision, with or without the previous frames.
    fn by_banded_system(walker: &Walker, d: usize, goes_on: bool) -> [f64; 2] {
        let frames = walker.frames();
        let term = |i: usize, part: Stream| {
            let number = |of: &StateMeans| f64::from(of[part as usize][d]);
            Term { mean: number(frames[i].means), weight: number(frames[i].weights) }
        };
        let mut system = Banded::default();
        system.begin(HORIZON + 1);
        for t in 0..=HORIZON {
            system.pose(t, term(t + 1, Stream::Static));
            if t > 0 && t < HORIZON {
                system.velocity(t, term(t + 1, Stream::Delta));
                system.acceleration(t, term(t + 1, Stream::DeltaDelta));
            }
        }
        if goes_on {
            let terms = |part: Stream| [0, 1].map(|i| term(i, part));
            let known = walker.emitted.each_ref().map(|row| f64::from(row[d]));
            system.after(known, terms(Stream::Delta), terms(Stream::DeltaDelta));
        }
        let trajectory = system.solve();
        [trajectory[0], trajectory[1]]
    }

    #[test]
    fn frames_are_those_of_the_banded_system() {
        let mut walker = walker(&[1.0, 0.0]);
        let mut first = walker.clone();
        (first.frame, first.position) = (0, Position::default());
        first.follow_path();
        let rows = first.first_rows();
        let is_near = |d: usize| {
            let expected = by_banded_system(&first, d, false);
            (0..2).all(|t| (f64::from(rows[t][d]) - expected[t]).abs() < 2e-5)
        };
        assert!((0..PADDED).all(is_near));

        let mut greatest = 0.0_f64;
        walker.plan_transition(5, 3, [&[-1.0, 2.0]; SIDES]).unwrap();
        for frame in 0..300 {
            if frame == 150 {
                walker.set_walking(false);
            }
            let mut next = walker.clone();
            next.follow_path();
            let row = next.next_row();
            let off = |d: usize| (f64::from(row[d]) - by_banded_system(&next, d, true)[0]).abs();
            greatest = (0..PADDED).map(off).fold(greatest, f64::max);
            walker.advance();
        }
        assert!(greatest < 2e-5, "{greatest} rad");
    }

    #[test]
    fn the_heading_stays_within_half_a_turn() {
        let mut walker = walker(&[1.0, 0.0]);
        walker.set_turn(MAX_TURN);
        let mut last = walker.advance().rotations[0];
        for _ in 0..2000 {
            let hips = walker.advance().rotations[0];
            assert!(walker.heading.abs() <= PI + 1e-5, "{}", walker.heading);
            let turn = last.inv_mul(hips).angle();
            assert!(turn < 0.3, "no jump where the heading wraps: {turn}");
            last = hips;
        }
    }
}
