//! Endless walking, frame by frame: what is controlled acts on the next frame (specification, §8, §9 and §11).

use super::RATE_HZ;
use super::joint_range::limited;
use super::mlpg::{Banded, Term};
use super::model::{DIMS, Observation, Part, Row, SIDES, STATES, Side, StyleMeans, WalkModel};
use super::root::RootPath;
use crate::humanoid::{JOINTS, Pose, Proportions, Role};
use crate::kinematics::world_from_local;
use crate::math::lanes::{Lane, WIDTH};
use crate::math::{Quat, Vec3, exp_map};
use std::sync::Arc;
use thiserror::Error;

/// Frames that are looked ahead: with them the trajectory is within 0.1° of that of the whole walk on average.
pub const HORIZON: usize = 20;
/// Steps that may begin within the horizon, and the one before.
const PLANNED: usize = HORIZON / STATES + 2;
/// Frames of a state, whatever is mixed.
const STATE_FRAMES: [f32; 2] = [1.0, 14.0];
/// Greatest turn of a step, radians: the foot turns on the ground by as much.
pub const MAX_TURN: f32 = 0.18;
/// Slowest and fastest steps that can be asked for, frames.
pub const STEP_FRAMES: [f32; 2] = [8.0, 45.0];
/// Shortest and longest steps that can be asked for, as shares of the style's.
pub const STRIDE: [f32; 2] = [0.6, 1.3];
/// Steps that starting and stopping take.
const STARTING_STEPS: f32 = 2.0;
/// How far behind the middle of the joints the ankles are of people who stand, metres.
const ANKLE_BEHIND: f32 = 0.03;
/// Greatest weight of a style, either way.
pub const MAX_WEIGHT: f32 = 5.0;
/// Greatest deviation of drawn durations, as a share of the mean: the variances hold what styles differ by as well.
const MOST_VARIATION: f32 = 0.15;

const PADDED: usize = DIMS.next_multiple_of(WIDTH);
const LANES: usize = PADDED / WIDTH;

type Padded = [f32; PADDED];
type StateMeans = [Padded; 3];

/// Why weights are none.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum WeightsError {
    /// There is not one a style.
    #[error("{found} weights were given for {styles} styles")]
    Count {
        /// Weights given.
        found: usize,
        /// Styles of the model.
        styles: usize,
    },
    /// One is not a number, or too large.
    #[error("a weight is {0}; a number between -{MAX_WEIGHT} and {MAX_WEIGHT} was expected")]
    Range(f32),
}

/// A style in single precision.
#[derive(Clone, Debug)]
struct Voice {
    means: [[StateMeans; STATES]; SIDES],
    durations: [[f32; STATES]; SIDES],
    /// The pose that walking swings about, and stops in: either leg as it is below the body, and all else in between.
    standing: Padded,
}

impl Voice {
    fn new(model: &WalkModel, means: &StyleMeans) -> Self {
        let below: [Row; SIDES] = std::array::from_fn(|leg| below_the_body(model, means, leg));
        let standing = |d: usize| match LEGS.iter().position(|leg| leg.contains(&(d / 3))) {
            Some(leg) => below[leg][d],
            None => 0.5 * (below[0][d] + below[1][d]),
        };
        Self {
            means: means.means.each_ref().map(|side| side.each_ref().map(padded)),
            durations: means.durations.map(|side| side.map(|d| d as f32)),
            standing: std::array::from_fn(|d| if d < DIMS { standing(d) as f32 } else { 0.0 }),
        }
    }
}

/// The pose of a step in which the supporting leg has the body above it.
fn below_the_body(model: &WalkModel, means: &StyleMeans, leg: usize) -> Row {
    let states = means.means[1 - leg].each_ref().map(|state| &state[0]);
    let foot = [Role::LeftFoot, Role::RightFoot][leg].index();
    // How far the ankle is before where it would be in standing, in the pose of each state.
    let ahead = states.map(|row| {
        let rotations = std::array::from_fn(|j| {
            let of = |d: usize| row[3 * j + d] as f32;
            model.reference[j] * exp_map::exp(Vec3::new(of(0), of(1), of(2)))
        });
        let world = world_from_local(&model.proportions, &Pose { root: Vec3::ZERO, rotations });
        let centre = world.positions.iter().map(|p| p.z).sum::<f32>() / JOINTS as f32;
        f64::from(world.positions[foot].z - (centre - ANKLE_BEHIND))
    });
    let passes = (1..STATES).find(|&s| ahead[s - 1] > 0.0 && ahead[s] <= 0.0);
    let nearest = (0..STATES).min_by(|a, b| ahead[*a].abs().total_cmp(&ahead[*b].abs())).unwrap_or(0);
    let (before, after) = passes.map_or((nearest, nearest), |s| (s - 1, s));
    let share = if before == after { 0.0 } else { ahead[before] / (ahead[before] - ahead[after]) };
    std::array::from_fn(|d| states[before][d] + share * (states[after][d] - states[before][d]))
}

/// Joints of either leg.
const LEGS: [std::ops::RangeInclusive<usize>; SIDES] =
    [Role::LeftUpperLeg as usize..=Role::LeftToes as usize, Role::RightUpperLeg as usize..=Role::RightToes as usize];

/// Walking that begins or ends.
#[derive(Clone, Copy, Debug)]
struct Start {
    /// The step that it begins with.
    first: u64,
    /// How much of walking there was then, and will be: 0 is standing, 1 walking.
    from: f32,
    to: f32,
}

impl Start {
    /// How much of walking there is in a state.
    fn share(&self, step: u64, state: usize) -> f32 {
        let Some(steps) = step.checked_sub(self.first) else { return self.from };
        let share = (steps as f32 + (state as f32 + 0.5) / STATES as f32) / STARTING_STEPS;
        self.from + share.min(1.0) * (self.to - self.from)
    }
}

fn padded(of: &Observation) -> StateMeans {
    of.map(|row| std::array::from_fn(|d| row.get(d).map_or(0.0, |v| *v as f32)))
}

/// A model made ready to be walked by; walkers share it.
#[derive(Debug)]
pub struct WalkVoices {
    proportions: Proportions,
    reference: [Quat; JOINTS],
    inverse_variances: [[StateMeans; STATES]; SIDES],
    duration_variances: [[f32; STATES]; SIDES],
    range: Vec<[f32; 2]>,
    average: Voice,
    styles: Vec<Voice>,
}

impl WalkVoices {
    /// Of a model.
    pub fn new(model: &WalkModel) -> Self {
        // Where a degree of freedom is padding it is certain to be zero.
        let inverse = |of: &Observation| padded(of).map(|row| row.map(|v| if v > 0.0 { 1.0 / v } else { 1.0 }));
        let [low, high] = &model.range;
        Self {
            proportions: model.proportions,
            reference: model.reference,
            inverse_variances: model.variances.each_ref().map(|side| side.each_ref().map(inverse)),
            duration_variances: model.duration_variances.map(|side| side.map(|v| v as f32)),
            range: low.iter().zip(high).map(|(l, h)| [*l as f32, *h as f32]).collect(),
            average: Voice::new(model, &model.average()),
            styles: model.means.iter().map(|means| Voice::new(model, means)).collect(),
        }
    }

    /// Number of styles.
    pub fn styles(&self) -> usize {
        self.styles.len()
    }
}

/// Weights of the styles, for the steps of either foot.
#[derive(Clone, Debug)]
struct Weights([Vec<f32>; SIDES]);

/// A change of style that is spread over steps.
#[derive(Clone, Debug)]
struct Transition {
    /// The first step that is in between.
    first: u64,
    /// Steps in between.
    steps: u32,
    to: Weights,
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

/// A step to come, or the current one, in its style.
#[derive(Clone, Debug)]
struct PlannedStep {
    number: u64,
    means: [StateMeans; STATES],
    durations: [f32; STATES],
}

/// Where a frame stands: the step, the state in it, and when the state began in frames, counted and reckoned.
#[derive(Clone, Copy, Debug, Default)]
struct Position {
    step: u64,
    state: usize,
    begin: u64,
    reckoned: f64,
}

/// Someone who walks, and never stops.
#[derive(Clone, Debug)]
pub struct Walker {
    voices: Arc<WalkVoices>,
    weights: Weights,
    transitions: Vec<Transition>,
    /// What the durations of states are drawn by; without it they are the means.
    seed: Option<u32>,
    /// Frames of a step if they are prescribed.
    step_frames: Option<f32>,
    /// Turn of a step, radians.
    turn: f32,
    /// Length of steps as a share of the style's.
    stride: f32,
    start: Start,
    limits: bool,

    heading: f32,
    frame: u64,
    position: Position,
    /// A ring: the step of number n is in slot n mod the length.
    planned: Vec<PlannedStep>,
    /// Whether the planned steps are those of the current weights.
    is_planned: bool,
    /// The last two frames, and the side, state, and means of the last one's velocity and acceleration.
    emitted: [Padded; 2],
    last: (usize, usize, [Padded; 2]),
    systems: Vec<Banded<Lane>>,
    path: Vec<(u64, usize)>,
    root: RootPath,
    pose: Pose,
}

impl Walker {
    /// Someone who walks as the average of all styles, from the origin along +Z.
    pub fn new(voices: Arc<WalkVoices>) -> Self {
        let none = Weights([(); SIDES].map(|()| vec![0.0; voices.styles.len()]));
        let step = PlannedStep { number: u64::MAX, means: voices.average.means[0], durations: [0.0; STATES] };
        let mut walker = Self {
            weights: none,
            transitions: Vec::new(),
            seed: None,
            step_frames: None,
            turn: 0.0,
            stride: 1.0,
            start: Start { first: 0, from: 1.0, to: 1.0 },
            limits: true,
            heading: 0.0,
            frame: 0,
            position: Position::default(),
            planned: vec![step; PLANNED],
            is_planned: false,
            emitted: [[0.0; PADDED]; 2],
            last: (0, 0, [[0.0; PADDED]; 2]),
            systems: vec![Banded::with_capacity(HORIZON + 1); LANES],
            path: Vec::with_capacity(HORIZON + 1),
            root: RootPath::new(&voices.proportions),
            pose: Pose::default(),
            voices,
        };
        walker.begin();
        walker
    }

    /// Begins anew at a place with a heading; styles and controls stay.
    pub fn reset(&mut self, at: Vec3, heading: f32) {
        self.root.reset(at);
        self.heading = heading;
        self.start = Start { first: 0, from: self.start.to, to: self.start.to };
        self.begin();
    }

    /// Styles of both feet's steps from the next frame on; what weights lack to a sum of 1 is the average's.
    ///
    /// # Errors
    /// See [`WeightsError`]; the former weights then stay.
    pub fn set_styles(&mut self, weights: &[f32]) -> Result<(), WeightsError> {
        self.set_sides([weights; SIDES])
    }

    /// [`Walker::set_styles`] for the steps of the left foot and of the right.
    ///
    /// # Errors
    /// See [`WeightsError`]; the former weights then stay.
    pub fn set_sides(&mut self, weights: [&[f32]; SIDES]) -> Result<(), WeightsError> {
        weights.iter().try_for_each(|w| self.check(w))?;
        for (own, new) in self.weights.0.iter_mut().zip(weights) {
            own.copy_from_slice(new);
        }
        self.transitions.clear();
        self.is_planned = false;
        Ok(())
    }

    /// Changes styles from a step to come on, over so many steps in between; 0 is an abrupt change.
    ///
    /// # Errors
    /// See [`WeightsError`]; nothing changes then.
    pub fn plan_transition(&mut self, step: u64, between: u32, weights: &[f32]) -> Result<(), WeightsError> {
        self.check(weights)?;
        let to = Weights([(); SIDES].map(|()| weights.to_vec()));
        let at = self.transitions.partition_point(|t| t.first <= step);
        self.transitions.insert(at, Transition { first: step, steps: between, to });
        self.is_planned = false;
        Ok(())
    }

    /// Steps a minute from now on; `None` leaves it to the style. The nearest of [`STEP_FRAMES`] is taken.
    pub fn set_cadence(&mut self, steps_per_minute: Option<f32>) {
        let frames = |cadence: f32| (60.0 * RATE_HZ / cadence).clamp(STEP_FRAMES[0], STEP_FRAMES[1]);
        self.step_frames = steps_per_minute.filter(|c| c.is_finite() && *c > 0.0).map(frames);
        self.is_planned = false;
    }

    /// Whether states last as long as people's do, now longer and now shorter, drawn by this number; `None` gives every step
    /// of a style the same durations.
    pub fn set_variation(&mut self, seed: Option<u32>) {
        self.seed = seed;
        self.is_planned = false;
    }

    /// Turn of a step, radians to the left; at most [`MAX_TURN`] either way.
    pub fn set_turn(&mut self, turn: f32) {
        self.turn = if turn.is_finite() { turn.clamp(-MAX_TURN, MAX_TURN) } else { 0.0 };
    }

    /// Length of steps as a share of the style's, about: the legs swing by as much more or less. The nearest of [`STRIDE`] is
    /// taken.
    pub fn set_stride(&mut self, share: f32) {
        self.stride = if share.is_finite() { share.clamp(STRIDE[0], STRIDE[1]) } else { 1.0 };
        self.is_planned = false;
    }

    /// Whether to walk or to stand, from the next frame on: either takes two steps, in which the swing of the joints about
    /// how they stand grows or fades. No walks from rest or to it are recorded that it could be learnt from.
    pub fn set_walking(&mut self, walks: bool) {
        let Position { step, state, .. } = self.position;
        let to = f32::from(u8::from(walks));
        if to != self.start.to {
            self.start = Start { first: step, from: self.start.share(step, state), to };
            self.is_planned = false;
        }
    }

    /// Whether joints keep within the range of the recorded walks; they do unless told otherwise.
    pub fn set_limits(&mut self, limits: bool) {
        self.limits = limits;
    }

    /// Number of the step that the last frame belongs to, and the foot that swings in it.
    pub fn step(&self) -> (u64, Side) {
        (self.path[0].0, side_of(self.path[0].0))
    }

    /// Number of the step that the next frame belongs to: the first that can be planned for.
    pub fn next_step(&self) -> u64 {
        self.position.step
    }

    /// State of the last frame, 0 to 4.
    pub fn state(&self) -> usize {
        self.path[0].1
    }

    /// How long the states of the last frame's step last, frames.
    pub fn durations(&self) -> &[f32; STATES] {
        &self.planned[slot_of(self.path[0].0)].durations
    }

    /// Feet that are on the ground in the last frame, left and right.
    pub fn planted(&self) -> [bool; 2] {
        self.root.planted()
    }

    /// The last frame.
    pub fn pose(&self) -> &Pose {
        &self.pose
    }

    /// The next frame.
    pub fn advance(&mut self) -> &Pose {
        self.follow_path();
        self.solve(true);
        let row = self.row(0);
        self.emitted = [self.emitted[1], row];
        self.remember_means();
        let side = side_of(self.path[0].0);
        let mut rotations = self.voices.reference;
        for (j, q) in rotations.iter_mut().enumerate() {
            let of = |d: usize| {
                let x = row[3 * j + d];
                if self.limits { limited(x, self.voices.range[3 * j + d]) } else { x }
            };
            *q = *q * exp_map::exp(Vec3::new(of(0), of(1), of(2)));
        }
        self.pose = Pose { root: Vec3::ZERO, rotations };
        let (step, state) = self.path[0];
        self.heading += self.start.share(step, state) * self.turn
            / self.planned[slot_of(self.path[0].0)].durations.iter().sum::<f32>();
        self.root.place(&mut self.pose, side, self.heading);
        &self.pose
    }

    /// Foot, point and place in the world that touch the ground.
    #[cfg(any(test, feature = "offline"))]
    pub(super) fn contact(&self) -> Option<(usize, usize, Vec3)> {
        self.root.contact()
    }

    fn check(&self, weights: &[f32]) -> Result<(), WeightsError> {
        let styles = self.voices.styles.len();
        if weights.len() != styles {
            return Err(WeightsError::Count { found: weights.len(), styles });
        }
        let bad = weights.iter().find(|w| w.is_nan() || w.abs() > MAX_WEIGHT);
        bad.map_or(Ok(()), |w| Err(WeightsError::Range(*w)))
    }

    /// Takes two frames that nobody sees: those after them have a past.
    fn begin(&mut self) {
        (self.frame, self.position, self.is_planned) = (0, Position::default(), false);
        self.follow_path();
        self.solve(false);
        self.emitted = [self.row(0), self.row(1)];
        self.follow_path();
        self.remember_means();
    }

    /// Steps and states of this frame and those within the horizon; then the position is that of the next frame.
    fn follow_path(&mut self) {
        if !self.is_planned {
            self.planned.iter_mut().for_each(|step| step.number = u64::MAX);
            self.is_planned = true;
        }
        self.forget_past_transitions();
        self.path.clear();
        let mut at = self.position;
        for frame in self.frame..=self.frame + HORIZON as u64 {
            loop {
                self.plan(at.step);
                let reckoned = at.reckoned + f64::from(self.planned[slot_of(at.step)].durations[at.state]);
                let end = (reckoned.round() as u64).max(at.begin + 1);
                if frame < end {
                    break;
                }
                let is_last = at.state + 1 == STATES;
                at = Position {
                    step: at.step + u64::from(is_last),
                    state: if is_last { 0 } else { at.state + 1 },
                    begin: end,
                    reckoned,
                };
            }
            self.path.push((at.step, at.state));
            if frame == self.frame + 1 {
                self.position = at;
            }
        }
        self.frame += 1;
    }

    /// Transitions that are over become the style that all begins with.
    fn forget_past_transitions(&mut self) {
        let step = self.position.step;
        let over = self.transitions.iter().take_while(|t| t.share(step, 0) >= 1.0).count();
        if over > 0 {
            self.weights.clone_from(&self.transitions[over - 1].to);
            self.transitions.drain(..over);
        }
    }

    /// Mixes the means of a step, if it is not planned yet.
    fn plan(&mut self, number: u64) {
        let slot = slot_of(number);
        if self.planned[slot].number == number {
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
        let step = &mut self.planned[slot];
        step.number = number;
        (step.means, step.durations) = ([[[0.0; PADDED]; 3]; STATES], [0.0; STATES]);
        for state in 0..STATES {
            let (mut rest, mut standing) = (1.0, [0.0; PADDED]);
            let mut add = |weight: f32, voice: &Voice| {
                if weight == 0.0 {
                    return;
                }
                let sums = step.means[state].as_flattened_mut().iter_mut();
                sums.zip(voice.means[side][state].as_flattened()).for_each(|(sum, v)| *sum += weight * v);
                step.durations[state] += weight * voice.durations[side][state];
                standing.iter_mut().zip(voice.standing).for_each(|(sum, v)| *sum += weight * v);
            };
            for (style, voice) in voices.styles.iter().enumerate() {
                let weight = weight(style, state);
                rest -= weight;
                add(weight, voice);
            }
            add(rest, &voices.average);
            let walking = self.start.share(number, state);
            if walking < 1.0 || self.stride != 1.0 {
                swing(&mut step.means[state], &standing, walking, self.stride);
            }
        }
        let [least, greatest] = STATE_FRAMES;
        let variances = voices.duration_variances[side];
        if let Some(seed) = self.seed {
            for (state, duration) in step.durations.iter_mut().enumerate() {
                let deviation = variances[state].sqrt().min(MOST_VARIATION * *duration);
                *duration += deviation * normal(seed, number, state);
            }
        }
        step.durations = step.durations.map(|d| d.clamp(least, greatest));
        if let Some(wanted) = self.step_frames {
            last(&mut step.durations, &variances, wanted);
        }
    }

    /// Solves for the likeliest trajectory along the path, going on from the frames before or not.
    fn solve(&mut self, goes_on: bool) {
        let (last_side, last_state, last_means) = &self.last;
        for l in 0..LANES {
            let system = &mut self.systems[l];
            system.begin(self.path.len());
            let term = |side: usize, state: usize, part: Part, means: &Padded| Term {
                mean: Lane::of(means, l),
                weight: Lane::of(&self.voices.inverse_variances[side][state][part as usize], l),
            };
            let at = |t: usize, part: Part| {
                let (number, state) = self.path[t];
                let step = &self.planned[slot_of(number)];
                term(side_of(number) as usize, state, part, &step.means[state][part as usize])
            };
            for t in 0..self.path.len() {
                system.pose(t, at(t, Part::Pose));
                if t > 0 && t + 1 < self.path.len() {
                    system.velocity(t, at(t, Part::Velocity));
                    system.acceleration(t, at(t, Part::Acceleration));
                }
            }
            if goes_on {
                let terms =
                    |part: Part| [term(*last_side, *last_state, part, &last_means[part as usize - 1]), at(0, part)];
                let known = self.emitted.each_ref().map(|row| Lane::of(row, l));
                system.after(known, terms(Part::Velocity), terms(Part::Acceleration));
            }
            system.solve();
        }
    }

    /// A frame of the trajectory.
    fn row(&self, t: usize) -> Padded {
        let mut row = [0.0; PADDED];
        self.systems.iter().enumerate().for_each(|(l, system)| system.trajectory()[t].write(&mut row, l));
        row
    }

    /// Keeps what the next frame's trajectory needs of this one's means.
    fn remember_means(&mut self) {
        let (number, state) = self.path[0];
        let [_, velocity, acceleration] = self.planned[slot_of(number)].means[state];
        self.last = (side_of(number) as usize, state, [velocity, acceleration]);
    }
}

/// Makes states last so many frames together: each gives way as far as it varies, but no farther than states can.
fn last(durations: &mut [f32; STATES], variances: &[f32; STATES], frames: f32) {
    let [least, greatest] = STATE_FRAMES;
    for _ in 0..STATES {
        let rest = frames - durations.iter().sum::<f32>();
        let gives = |duration: f32| if rest < 0.0 { duration > least } else { duration < greatest };
        let all = durations.iter().zip(variances).filter(|(d, _)| gives(**d)).map(|(_, v)| v).sum::<f32>();
        if rest == 0.0 || all <= 0.0 {
            break;
        }
        for (duration, variance) in durations.iter_mut().zip(variances).filter(|(d, _)| gives(**d)) {
            *duration = (*duration + rest * variance / all).clamp(least, greatest);
        }
    }
}

/// Makes a state's joints swing less about how they stand, or more, the legs by another share than the rest.
fn swing(means: &mut StateMeans, standing: &Padded, share: f32, legs: f32) {
    for d in 0..DIMS {
        let is_leg = LEGS.iter().any(|leg| leg.contains(&(d / 3)));
        let share = if is_leg { share * legs } else { share };
        means[0][d] = standing[d] + share * (means[0][d] - standing[d]);
        means[1][d] *= share;
        means[2][d] *= share;
    }
}

/// Where a step is planned.
fn slot_of(step: u64) -> usize {
    (step % PLANNED as u64) as usize
}

/// The foot that swings in a step.
fn side_of(step: u64) -> Side {
    if step.is_multiple_of(2) { Side::Left } else { Side::Right }
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
