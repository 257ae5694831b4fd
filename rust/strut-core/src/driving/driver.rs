//! The driver: generates neutral motion frame by frame that follows a control or a path.

use super::clips::{ClipKind, DrivingClip, DrivingClips};
use super::control::Control;
use super::features::{HORIZONS_SECS, Trajectory, ahead_of, features_of, query_of};
use super::inertia::{HALF_LIFE_SECS, Inertia, Moving};
use super::matching::Matching;
use super::moves::{Move, MovePart, MoveRows};
use super::path::Path;
use super::query::{OnPath, RootState, STOP_BEFORE, by_path, by_stick, in_root, in_world, to_the_right};
use crate::humanoid::Pose;
use crate::math::float_funcs::{atan2, half_life_share, wrap_angle};
use crate::math::stats;
use crate::math::{Quat, Vec2, Vec3};
use crate::pose_vector::Placement;
use std::f32::consts::LN_2;
use std::sync::Arc;

/// Time between searches, seconds: 10 frames at 60 Hz.
const SEARCH_SECS: f32 = 1.0 / 6.0;
/// A new control triggers a search at once, but not earlier than this after the last search, seconds: 3 frames.
const LEAST_SEARCH_SECS: f32 = 0.05;
/// A control is new if its velocity or heading changes by more than this: m/s, radians.
const NEW_SPEED: f32 = 0.3;
const NEW_HEADING: f32 = 15.0 * std::f32::consts::PI / 180.0;
/// A transition does not enter rows within this distance of the end of their clip, of the present row or of the `LEFT`
/// rows left last, seconds: 20 frames.
const NEAR_SECS: f32 = 1.0 / 3.0;
const LEFT: usize = 3;
/// Another row is entered only if its cost is lower than the present row's by more than this.
const BETTER: f32 = 1.0;
/// Extra cost of a take's rows over those of the database's own clips while the character moves: without it, takes
/// would be used for walking. It does not apply when the character is to stand, because a halt that has begun would be
/// left for another step.
const TAKE: f32 = 1.5;
/// Turns on the spot are allowed below this gait, or for a turn of more than this at the last horizon, radians;
/// otherwise their feet skate.
const STANDING_GAIT: f32 = 0.1;
const SHARP_TURN: f32 = 60.0 * std::f32::consts::PI / 180.0;
/// A move from rest begins as soon as the root is slower than this, m/s, or after this time, seconds.
const MOVE_SPEED: f32 = 0.5;
const MOST_BRAKING_SECS: f32 = 1.0;
/// A jump from a run begins when the run takes off, or after this time, seconds.
const MOST_APPROACH_SECS: f32 = 0.5;
/// Share of the style that a standing pose takes if the database has walking only, and the half-life with which the
/// share changes, seconds.
const STANDING_STYLE: f32 = 0.3;
const STYLE_HALF_LIFE_SECS: f32 = 0.1;
/// Steering adds to the clip's turn rate what is missing to the target heading at the first horizon, at most this much,
/// rad/s. It is reduced while the character slows down to stand and the root is slower than `FULL_STEERING_SPEED`, m/s.
const MOST_STEERING: f32 = 60.0 * std::f32::consts::PI / 180.0;
const FULL_STEERING_SPEED: f32 = 0.5;
/// Pacing brings the clip's speed nearer to the target speed, by at most this share, with this half-life, seconds. A
/// clip that travels less than this distance up to the last horizon, metres, is not paced.
const MOST_PACING: f32 = 0.1;
const PACING_HALF_LIFE_SECS: f32 = 0.2;
const LEAST_WAY: f32 = 0.25;
/// A lasting offset from the path is integrated with this half-life, seconds. The character aims at the integral times
/// this gain, 1/s, on the other side of the path, at most this far, metres.
const OFFSET_HALF_LIFE_SECS: f32 = 5.0;
const AIM: f32 = 0.7;
const MOST_AIM: f32 = 0.5;
/// Half-lives with which the styled character's place and speed relative to the neutral one are tracked, seconds, and
/// the range of the speed ratio.
const STYLED_PLACE_HALF_LIFE_SECS: f32 = 0.15;
const STYLED_SPEED_HALF_LIFE_SECS: f32 = 0.5;
const STYLED_SPEEDS: [f32; 2] = [0.3, 2.0];
/// Clips whose median root speed is higher than this are running, m/s.
const RUNNING: f32 = 1.9;
/// Below this speed, m/s, the ratio of styled to neutral speed is not updated.
const MOVING: f32 = 0.3;

/// A frame of a [`Driver`].
#[derive(Clone, Debug, PartialEq)]
pub struct DrivenFrame {
    /// The pose in the world.
    pub pose: Pose,
    /// Which feet are planted, [left, right].
    pub contacts: [bool; 2],
    /// Place and heading of the root.
    pub root: Placement,
    /// Target trajectory.
    pub asked: Trajectory,
    /// Trajectory of the clip that plays.
    pub ahead: Trajectory,
    /// Speed of the root over the ground, m/s.
    pub speed: f32,
    /// The row that plays; see [`DrivingClips`].
    pub row: usize,
    /// Whether the driver made a transition instead of playing the next row.
    pub switched: bool,
    /// The move that plays.
    pub action: Option<Move>,
    /// Share of the style that the pose may take, 0 to 1, for
    /// [`Stylizer::set_style_share`](crate::transfer::Stylizer::set_style_share).
    pub style_share: f32,
}

/// Properties of a row that do not depend on the query.
#[derive(Clone, Copy, Debug)]
struct Entry {
    /// Whether a search may enter it.
    is_open: bool,
    /// Whether its clip turns on the spot.
    turns: bool,
    /// Cost added to the distance of its features while the character moves.
    extra: f32,
}

/// Progress of the requested move.
#[derive(Clone, Copy, Debug, PartialEq)]
enum ActionState {
    /// The character has been slowing down for this many seconds.
    Braking { action: Move, secs: f32 },
    /// The character has been running towards its next take-off for this many seconds: a jump from a run.
    Approaching { action: Move, secs: f32 },
    /// The move plays up to the row `end`. In a jump from a run the root keeps `momentum`, its velocity in the world,
    /// m/s.
    Playing { action: Move, end: usize, momentum: Option<Vec2> },
}

impl ActionState {
    /// Whether the character stops for the move. In a jump from a run it keeps following the control.
    fn stops(&self) -> bool {
        matches!(self, Self::Braking { .. } | Self::Playing { momentum: None, .. })
    }
}

/// Generates neutral motion that follows a control or a path.
#[derive(Clone, Debug)]
pub struct Driver {
    clips: Arc<DrivingClips>,
    matching: Matching,
    /// One per row.
    entries: Vec<Entry>,
    /// Speeds of walking and running, m/s.
    speeds: [f32; 2],
    control: Control,
    path: Option<(Path, f32)>,
    state: State,
    frame: DrivenFrame,
}

/// State that changes every frame.
#[derive(Clone, Copy, Debug)]
struct State {
    row: usize,
    root: Placement,
    /// Differences of the root's velocity in its frame and of its turn rate from the row's; they decay.
    velocity: Vec2,
    turn_rate: f32,
    /// Ratio of the root's speed to the clip's.
    pace: f32,
    /// Integrated offset to the left of the path, metres · seconds.
    offset: f32,
    inertia: Inertia,
    since_search_secs: f32,
    acting: Option<ActionState>,
    /// Target of the last search: velocity and heading in the world.
    asked: (Vec2, f32),
    left: [Option<usize>; LEFT],
    /// Offset on the ground from the neutral hips to the styled ones, and the ratio of the styled hips' speed to the
    /// neutral ones'.
    styled: Vec2,
    styled_share: f32,
    /// Places of the neutral and the styled hips in the last frame.
    before: Option<[Vec2; 2]>,
    /// Smoothed distance that the neutral and the styled hips travel, metres a frame.
    gone: [f32; 2],
}

impl Driver {
    /// Creates a driver at the origin that faces +Z and stands, or moves as slowly as its clips allow.
    pub fn new(clips: Arc<DrivingClips>) -> Self {
        let matching = Matching::new(features_of(&clips));
        let near = near_rows(&clips);
        let entry = |clip: &DrivingClip, row: usize| Entry {
            is_open: row + near < clip.rows.end && clip.kind != ClipKind::Moves,
            turns: clip.turns,
            extra: if clip.kind == ClipKind::Take { TAKE } else { 0.0 },
        };
        let entries = clips.clips().iter().flat_map(|clip| clip.rows.clone().map(move |row| entry(clip, row)));
        let entries = entries.collect();
        let speeds = speeds_of(&clips);
        let state = State::at(slowest(&clips), Placement::default());
        let frame = DrivenFrame {
            pose: *clips.pose(state.row),
            contacts: clips.contact(state.row),
            root: state.root,
            asked: [(Vec2::ZERO, 0.0); HORIZONS_SECS.len()],
            ahead: [(Vec2::ZERO, 0.0); HORIZONS_SECS.len()],
            speed: 0.0,
            row: state.row,
            switched: false,
            action: None,
            style_share: 1.0,
        };
        Self { clips, matching, entries, speeds, control: Control::default(), path: None, state, frame }
    }

    /// Speeds of walking and of running, m/s, at the gaits 1 and 2.
    pub fn speeds(&self) -> [f32; 2] {
        self.speeds
    }

    /// Moves that can be requested.
    pub fn moves(&self) -> impl Iterator<Item = Move> {
        self.clips.moves()
    }

    /// Restarts at a place, without a path.
    pub fn reset(&mut self, root: Placement) {
        self.state = State::at(slowest(&self.clips), root);
        self.path = None;
        self.frame.style_share = 1.0;
    }

    /// Makes the character follow a line through points (x, z), metres, from its beginning to its end, instead of the
    /// control's `wish`. Fewer than two distinct points remove the path.
    pub fn set_path(&mut self, points: &[Vec2]) {
        self.path = Path::new(points).map(|path| (path, 0.0));
        self.state.offset = 0.0;
    }

    /// Distance that the character has covered along its path, metres; `None` without a path.
    pub fn progress(&self) -> Option<f32> {
        self.path.as_ref().map(|(_, progress)| *progress)
    }

    /// Whether the character has reached the end of its path; true without a path.
    pub fn has_arrived(&self) -> bool {
        self.path.as_ref().is_none_or(|(path, progress)| *progress >= path.length() - STOP_BEFORE)
    }

    /// Returns the next frame, `1 / rate_hz` after the last. A control with a number that is not finite is replaced by
    /// the last valid one. `styled_hips` is the place of the styled character's hips in the last frame, so that the
    /// *styled* character follows the path.
    pub fn next(&mut self, control: &Control, styled_hips: Option<Vec3>) -> &DrivenFrame {
        let held = self.control.action;
        self.control = control.checked().unwrap_or(self.control);
        if self.control.action != held && self.state.acting.is_none() {
            let known = self.control.action.filter(|action| self.clips.moves().any(|of| of == *action));
            self.state.acting = known.map(|action| self.request(action));
        }
        let dt = 1.0 / self.clips.rate_hz;
        self.observe(styled_hips.filter(|hips| hips.is_finite()), dt);
        // Earlier offsets decay in this frame; the offset of a new transition decays from the next frame on.
        self.state.inertia.advance(dt);
        let now = self.root_state();
        let (asked, wanted) = self.asked(&now, dt);
        let switched = self.choose(&now, &asked, wanted, dt);
        self.advance(&asked, wanted.0, dt);
        self.frame.asked = asked;
        self.frame.switched = switched;
        &self.frame
    }

    /// Updates the styled character's place and speed relative to the neutral one.
    fn observe(&mut self, styled_hips: Option<Vec3>, dt: f32) {
        let state = &mut self.state;
        let ground = |v: Vec3| Vec2::new(v.x, v.z);
        let neutral = ground(self.frame.pose.root);
        let Some(styled) = styled_hips.map(ground) else { return };
        state.styled += (styled - neutral - state.styled) * half_life_share(dt, STYLED_PLACE_HALF_LIFE_SECS);
        if let Some([neutral_before, styled_before]) = state.before {
            let share = half_life_share(dt, STYLED_SPEED_HALF_LIFE_SECS);
            let gone = [neutral.distance(neutral_before), styled.distance(styled_before)];
            for (mean, now) in state.gone.iter_mut().zip(gone) {
                *mean += (now - *mean) * share;
            }
            let [neutral, styled] = state.gone;
            if neutral > MOVING * dt {
                let [least, most] = STYLED_SPEEDS;
                state.styled_share = (styled / neutral).clamp(least, most);
            }
        }
        state.before = Some([neutral, styled]);
    }

    fn root_state(&self) -> RootState {
        let State { row, root, velocity, turn_rate, pace, .. } = self.state;
        let motion = self.clips.motion(row);
        let place = Vec2::new(root.x, root.z);
        let velocity = in_world(root.heading, (motion.velocity + velocity) * pace);
        RootState { place, heading: root.heading, velocity, turn_rate: motion.turn_rate + turn_rate }
    }

    /// Returns the target trajectory, and the velocity and heading it is derived from.
    fn asked(&mut self, now: &RootState, dt: f32) -> (Trajectory, (Vec2, f32)) {
        let Control { wish, gait, face, .. } = self.control;
        if self.state.acting.as_ref().is_some_and(ActionState::stops) {
            return (by_stick(now, Vec2::ZERO, now.heading), (Vec2::ZERO, now.heading));
        }
        let speed = speed_of(self.speeds, gait);
        if let Some((path, progress)) = &mut self.path {
            let styled = now.place + self.state.styled;
            *progress = path.nearest(*progress, styled);
            if *progress < path.length() - STOP_BEFORE {
                let direction = path.direction(*progress);
                let off = -to_the_right(direction).dot(styled - path.at(*progress));
                let state = &mut self.state;
                state.offset = (state.offset * (1.0 - half_life_share(dt, OFFSET_HALF_LIFE_SECS)) + off * dt)
                    .clamp(-MOST_AIM / AIM, MOST_AIM / AIM);
                let (share, aim) = (state.styled_share, AIM * state.offset);
                let asked = by_path(now, OnPath { path, progress: *progress, speed, styled, share, aim });
                return (asked, (direction * speed, atan2(direction.x, direction.y)));
            }
            let goal = face.unwrap_or(now.heading);
            return (by_stick(now, Vec2::ZERO, goal), (Vec2::ZERO, goal));
        }
        let wanted = wish * speed;
        let along = (wanted != Vec2::ZERO).then(|| atan2(wanted.x, wanted.y));
        let goal = face.or(along).unwrap_or(now.heading);
        (by_stick(now, wanted, goal), (wanted, goal))
    }

    /// Plays the next row, or makes a transition to a better one; returns whether it made a transition.
    fn choose(&mut self, now: &RootState, asked: &Trajectory, wanted: (Vec2, f32), dt: f32) -> bool {
        let state = &mut self.state;
        let clip = &self.clips.clips()[self.clips.clip_of(state.row)];
        let mut ends = state.row + 1 >= clip.rows.end;
        state.since_search_secs += dt;
        match &mut state.acting {
            Some(ActionState::Playing { end, .. }) if state.row + 1 < *end => {
                state.row += 1;
                return false;
            }
            Some(ActionState::Playing { .. }) => {
                state.acting = None;
                ends = true;
            }
            Some(ActionState::Braking { action, secs }) => {
                *secs += dt;
                if now.velocity.length() < MOVE_SPEED || *secs >= MOST_BRAKING_SECS {
                    let action = *action;
                    self.begin(action);
                    return true;
                }
            }
            Some(ActionState::Approaching { action, secs }) => {
                *secs += dt;
                if ends || takes_off(&self.clips, state.row) || *secs >= MOST_APPROACH_SECS {
                    let action = *action;
                    self.leap(action, now.velocity);
                    return true;
                }
            }
            None => {}
        }
        let is_new =
            (wanted.0 - state.asked.0).length() > NEW_SPEED || wrap_angle(wanted.1 - state.asked.1).abs() > NEW_HEADING;
        let is_due = state.since_search_secs >= SEARCH_SECS || (is_new && state.since_search_secs >= LEAST_SEARCH_SECS);
        if !ends && !is_due {
            state.row += 1;
            return false;
        }
        state.since_search_secs = 0.0;
        state.asked = wanted;
        let query = query_of(self.matching.row(state.row), &in_root(now, asked));
        let goes = wanted.0.length() >= STANDING_GAIT * self.speeds[0];
        let may_turn = !goes || self.turns_sharply(now, asked);
        let near = near_rows(&self.clips);
        let State { row, left, .. } = self.state;
        let is_near = |other: usize, to: usize| other.abs_diff(to) <= near;
        let extra = |entry: &Entry| if goes { entry.extra } else { 0.0 };
        let extra_where_open = |other: usize| {
            let entry = &self.entries[other];
            let is_left = is_near(other, row) || left.iter().flatten().any(|&to| is_near(other, to));
            (entry.is_open && (may_turn || !entry.turns) && !is_left).then(|| extra(entry))
        };
        let best = self.matching.nearest(&query, extra_where_open);
        let present = self.matching.cost_of(&query, row) + extra(&self.entries[row]);
        let found = match best {
            Some(found) if ends || found.cost + if is_new { 0.0 } else { BETTER } < present => found.row,
            // A clip that ends without a candidate starts again.
            None if ends => clip.rows.start,
            _ => {
                self.state.row += 1;
                return false;
            }
        };
        self.switch(found);
        true
    }

    /// Whether the target heading of a moving character is so far off that it may turn on the spot.
    fn turns_sharply(&self, now: &RootState, asked: &Trajectory) -> bool {
        let turn = wrap_angle(asked[asked.len() - 1].1 - now.heading).abs();
        self.path.is_none() && self.clips.knows_standing() && turn > SHARP_TURN
    }

    /// Initial state of a requested move: a jump from a run waits for the next take-off, any other move for rest.
    fn request(&self, action: Move) -> ActionState {
        let flies = self.clips.move_rows().iter().any(|of| of.action == action && of.flight.is_some());
        if flies && self.frame.speed >= RUNNING {
            ActionState::Approaching { action, secs: 0.0 }
        } else {
            ActionState::Braking { action, secs: 0.0 }
        }
    }

    /// Begins a move at one of its first rows.
    fn begin(&mut self, action: Move) {
        self.play(action, None, |of, rate_hz| Some(of.part_from_rest(rate_hz)));
    }

    /// Begins a jump at its take-off; the root keeps its velocity up to the landing.
    fn leap(&mut self, action: Move, velocity: Vec2) {
        self.play(action, Some(velocity), MoveRows::part_from_take_off);
    }

    /// Plays a part of a move from that of its entries at which the body is nearest to the present one.
    fn play(&mut self, action: Move, momentum: Option<Vec2>, part: impl Fn(&MoveRows, f32) -> Option<MovePart>) {
        let row = self.state.row;
        let mut best: Option<(f32, usize, usize)> = None;
        for of in self.clips.move_rows().iter().filter(|of| of.action == action) {
            let Some(MovePart { entries, end }) = part(of, self.clips.rate_hz) else { continue };
            for to in entries {
                let cost = self.matching.body_distance(row, to);
                if best.is_none_or(|(least, ..)| cost < least) {
                    best = Some((cost, end, to));
                }
            }
        }
        let Some((_, end, to)) = best else { return };
        self.state.acting = Some(ActionState::Playing { action, end, momentum });
        self.switch(to);
    }

    /// Makes a transition to the row after `like`, which resembles the present row.
    fn switch(&mut self, like: usize) {
        let state = &mut self.state;
        let from = state.row;
        // Very short clips stop at their last row.
        let after = |row: usize| (row + 1).min(self.clips.clips()[self.clips.clip_of(row)].rows.end - 1);
        let (next, to) = (after(from), after(like));
        let moving =
            |row: usize, then: usize| Moving::between(self.clips.pose(row), self.clips.pose(then), self.clips.rate_hz);
        // The frame that would be played next without the transition.
        let last = Moving { pose: *self.clips.pose(next), ..moving(from, next) };
        state.inertia.go_on(&last, &moving(to, after(to)));
        let (was, is) = (self.clips.motion(from), self.clips.motion(to));
        state.velocity += was.velocity - is.velocity;
        state.turn_rate += was.turn_rate - is.turn_rate;
        state.left.rotate_right(1);
        state.left[0] = Some(from);
        state.row = to;
    }

    /// Moves the root, where `wanted` is the final target velocity, and poses the row there.
    fn advance(&mut self, asked: &Trajectory, wanted: Vec2, dt: f32) {
        let is_acting = matches!(self.state.acting, Some(ActionState::Playing { .. }));
        let pacing = if is_acting { 1.0 } else { self.pacing(wanted) };
        self.state.pace += (pacing - self.state.pace) * half_life_share(dt, PACING_HALF_LIFE_SECS);
        let steering = if is_acting { 0.0 } else { self.steering(asked, wanted) };
        let state = &mut self.state;
        let motion = self.clips.motion(state.row);
        if let Some(ActionState::Playing { momentum: Some(momentum), .. }) = state.acting {
            state.velocity = in_world(-state.root.heading, momentum) / state.pace - motion.velocity;
        }
        let velocity = (motion.velocity + state.velocity) * state.pace;
        let speed = velocity.length();
        let turn_rate = motion.turn_rate + state.turn_rate + steering;
        let heading = wrap_angle(state.root.heading + turn_rate * dt);
        let step = in_world(heading, velocity) * dt;
        state.root = Placement { x: state.root.x + step.x, z: state.root.z + step.y, heading };
        let left = 1.0 - half_life_share(dt, HALF_LIFE_SECS);
        state.velocity *= left;
        state.turn_rate *= left;

        let mut pose = state.inertia.shown(self.clips.pose(state.row));
        let turn = Quat::from_rotation_y(heading);
        pose.root = turn * pose.root + Vec3::new(state.root.x, 0.0, state.root.z);
        pose.rotations[0] = turn * pose.rotations[0];
        self.frame.pose = pose;
        self.frame.contacts = self.clips.contact(state.row);
        self.frame.root = state.root;
        let row = self.matching.row(state.row);
        self.frame.ahead = std::array::from_fn(|horizon| {
            let (way, turned) = ahead_of(row, horizon);
            (Vec2::new(state.root.x, state.root.z) + in_world(heading, way), wrap_angle(heading + turned))
        });
        self.frame.speed = speed;
        self.frame.row = state.row;
        self.frame.action = match state.acting {
            Some(ActionState::Playing { action, .. }) => Some(action),
            _ => None,
        };
        let is_unknown = !self.clips.knows_standing() && self.clips.is_standing(state.row);
        let share = if is_unknown { STANDING_STYLE } else { 1.0 };
        self.frame.style_share += (share - self.frame.style_share) * half_life_share(dt, STYLE_HALF_LIFE_SECS);
    }

    /// Ratio to the clip's speed at which the character should move to reach the target velocity.
    fn pacing(&self, wanted: Vec2) -> f32 {
        const LAST: usize = HORIZONS_SECS.len() - 1;
        let way = ahead_of(self.matching.row(self.state.row), LAST).0.length();
        if way < LEAST_WAY {
            return 1.0;
        }
        (wanted.length() * HORIZONS_SECS[LAST] / way).clamp(1.0 - MOST_PACING, 1.0 + MOST_PACING)
    }

    /// Turn rate that is added to the clip's to reach the target heading, rad/s.
    fn steering(&self, asked: &Trajectory, wanted: Vec2) -> f32 {
        let State { row, root, velocity, turn_rate, pace, .. } = self.state;
        let (_, turned) = ahead_of(self.matching.row(row), 0);
        // The decaying turn rate of the last transition adds to the turn.
        let dying = turn_rate * HALF_LIFE_SECS / LN_2 * half_life_share(HORIZONS_SECS[0], HALF_LIFE_SECS);
        let lacks = wrap_angle(wrap_angle(asked[0].1 - root.heading) - turned - dying);
        let steering = (lacks / HORIZONS_SECS[0]).clamp(-MOST_STEERING, MOST_STEERING);
        // A character that starts to walk or turns on the spot lifts its feet; a standing one would slide over them.
        if wanted != Vec2::ZERO || self.entries[row].turns {
            return steering;
        }
        let speed = ((self.clips.motion(row).velocity + velocity) * pace).length();
        steering * (speed / FULL_STEERING_SPEED).min(1.0)
    }
}

impl State {
    fn at(row: usize, root: Placement) -> Self {
        Self {
            row,
            root,
            velocity: Vec2::ZERO,
            turn_rate: 0.0,
            pace: 1.0,
            offset: 0.0,
            inertia: Inertia::default(),
            since_search_secs: SEARCH_SECS,
            acting: None,
            asked: (Vec2::ZERO, root.heading),
            left: [None; LEFT],
            styled: Vec2::ZERO,
            styled_share: 1.0,
            before: None,
            gone: [0.0; 2],
        }
    }
}

/// Whether the last planted foot leaves the ground after a row.
fn takes_off(clips: &DrivingClips, row: usize) -> bool {
    let is_planted = |row: usize| clips.contact(row) != [false; 2];
    row + 1 < clips.rows() && is_planted(row) && !is_planted(row + 1)
}

fn near_rows(clips: &DrivingClips) -> usize {
    (NEAR_SECS * clips.rate_hz).round() as usize
}

/// The speed of a gait: a share of the walking speed up to 1, from there to the running speed at 2.
fn speed_of([walk, run]: [f32; 2], gait: f32) -> f32 {
    if gait <= 1.0 { gait * walk } else { walk + (gait - 1.0) * (run - walk) }
}

/// Speeds of walking and of running: medians of the clips of each. Without running clips the running speed is the
/// walking speed.
fn speeds_of(clips: &DrivingClips) -> [f32; 2] {
    let own = clips.clips().iter().filter(|clip| clip.kind == ClipKind::Locomotion);
    let speeds: Vec<f32> = own.filter(|clip| !clip.mirrored).map(|clip| clips.median_speed(clip)).collect();
    let median = |running: bool| {
        let of = speeds.iter().filter(|speed| (**speed >= RUNNING) == running);
        stats::median(of.map(|speed| f64::from(*speed))).map(|speed| speed as f32)
    };
    let (walking, running) = (median(false), median(true));
    let walk = walking.or(running).unwrap_or(1.0);
    [walk, running.unwrap_or(walk).max(walk)]
}

/// The row with the slowest root, turns and moves excluded.
fn slowest(clips: &DrivingClips) -> usize {
    let near = near_rows(clips);
    let goes = clips.clips().iter().filter(|clip| clip.kind != ClipKind::Moves && !clip.turns);
    let rows = goes.flat_map(|clip| clip.rows.start..clip.rows.end.saturating_sub(near).max(clip.rows.start + 1));
    let speed = |row: usize| clips.motion(row).velocity.length();
    rows.reduce(|best, row| if speed(row) < speed(best) { row } else { best }).unwrap_or(0)
}
