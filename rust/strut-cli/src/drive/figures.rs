//! Measurements of a drive: accuracy on the path, response to controls, and quality of the motion.

use super::orders::Orders;
use serde::Serialize;
use strut_core::contact::label;
use strut_core::driving::{ClipKind, Control, DrivenFrame, DrivingClips};
use strut_core::humanoid::{HumanoidMotion, JOINTS, Pose};
use strut_core::kinematics::world_from_local;
use strut_core::math::float_funcs::{atan2, wrap_angle};
use strut_core::math::{Vec2, Vec3};
use strut_core::metrics::foot_skate;
use strut_core::pose_vector::Placement;
use strut_core::stream::{LiveFigure, Place};
use strut_core::transfer::StyledFrame;

/// Distances from a path are measured from this time on, seconds, without the start.
const UNDER_WAY_SECS: f32 = 2.0;
/// Duration after a transition that counts as part of it, seconds.
const TRANSITION_SECS: f32 = 0.15;
/// Speed below which the character counts as standing, m/s.
const STILL: f32 = 0.1;
/// A heading counts as reached within this angle, degrees: while walking, and while standing.
const WALKING_DEGREES: f32 = 15.0;
const STANDING_DEGREES: f32 = 10.0;

/// The driven motion, one entry per frame.
#[derive(Default)]
pub(super) struct Log {
    pub(super) poses: Vec<Pose>,
    pub(super) contacts: Vec<[bool; 2]>,
    pub(super) roots: Vec<Placement>,
    /// Speeds of the root, m/s.
    pub(super) speeds: Vec<f32>,
    /// Whether a transition to another row occurred.
    pub(super) switched: Vec<bool>,
    /// Whether an action played.
    pub(super) acted: Vec<bool>,
    /// Time of the driver, microseconds.
    pub(super) driver_us: Vec<f32>,
}

impl Log {
    pub(super) fn push(&mut self, frame: &DrivenFrame) {
        self.poses.push(frame.pose);
        self.contacts.push(frame.contacts);
        self.roots.push(frame.root);
        self.speeds.push(frame.speed);
        self.switched.push(frame.switched);
        self.acted.push(frame.action.is_some());
    }
}

/// Measurements of a drive.
#[derive(Serialize)]
pub(super) struct Report {
    pub(super) frames: usize,
    pub(super) secs: f32,
    /// Number of candidate rows and clips, takes and mirror images included.
    rows: usize,
    clips: usize,
    /// Transitions to another row than the next one, per second.
    pub(super) transitions_per_sec: f32,
    /// Distance of the styled hips from the path, from two seconds after the start to the path's end, metres.
    pub(super) path_error_m: Option<PathError>,
    /// Mean speed of planted feet, m/s.
    skate: Skate,
    /// Greatest distance of the footplanted neutral character from the driven root, metres.
    wander_m: f32,
    /// 99.9th percentile and maximum of the horizontal acceleration of the styled hips, m/s².
    hips_acceleration: Peak,
    /// 99th percentile of the joints' acceleration, m/s²: just after transitions, and in the clips.
    transition_acceleration: f32,
    clip_acceleration: f32,
    /// Time of the driver per frame, microseconds.
    driver_us: Cost,
    /// Response to each control of a log.
    orders: Vec<Response>,
}

#[derive(Serialize)]
pub(super) struct PathError {
    pub(super) mean: f32,
    p95: f32,
}

/// Foot skate of the driver's output and after footplant, both with the clips' contacts; and of the finished motion,
/// with its own contacts.
#[derive(Serialize)]
struct Skate {
    driven: f32,
    planted: f32,
    styled: f32,
}

#[derive(Serialize)]
struct Peak {
    p999: f32,
    most: f32,
}

#[derive(Serialize)]
struct Cost {
    median: f32,
    p95: f32,
}

/// Response to a control until the next one.
#[derive(Serialize)]
struct Response {
    time: f32,
    gait: f32,
    /// Requested turn, degrees.
    turn: Option<f32>,
    /// Number of frames until the root had turned by one degree in that direction, and until the styled hips had.
    first_degree_frames: Option<usize>,
    first_styled_degree_frames: Option<usize>,
    /// Seconds until the heading was reached, within 15 degrees while walking and 10 while standing.
    heading_secs: Option<f32>,
    /// Seconds until 50 and 90 % of the change of speed.
    half_speed_secs: Option<f32>,
    speed_secs: Option<f32>,
    /// Seconds and metres until the character stood, for a control that stops it.
    stop_secs: Option<f32>,
    stop_m: Option<f32>,
    /// Distance of the last position from the first, metres.
    moved_m: f32,
    /// Seconds until an action began, and its duration.
    action_secs: Option<f32>,
    acted_secs: f32,
}

/// Returns the measurements of a drive with its styled frames and the finished motion.
pub(super) fn report(
    clips: &DrivingClips,
    speeds: [f32; 2],
    log: &Log,
    styled: (&[StyledFrame], &HumanoidMotion),
    orders: &Orders,
    arrived: usize,
) -> Report {
    let (styled, finished) = styled;
    let rate_hz = clips.rate_hz;
    let frames = log.poses.len();
    let secs = frames as f32 / rate_hz;
    let hips: Vec<Vec2> = styled.iter().map(|frame| ground(&frame.pose)).collect();
    let under_way = &hips[((UNDER_WAY_SECS * rate_hz) as usize).min(arrived)..arrived];
    let planted = planted(clips, log);
    let transitions = log.switched.iter().filter(|switched| **switched).count();
    Report {
        frames,
        secs,
        rows: clips.rows(),
        clips: clips.clips().len(),
        transitions_per_sec: transitions as f32 / secs,
        path_error_m: orders.path().filter(|_| !under_way.is_empty()).map(|path| path_error(path, under_way)),
        skate: skate(clips, log, &planted, finished),
        wander_m: log.poses.iter().zip(&planted).map(|(a, b)| ground(a).distance(ground(b))).fold(0.0, f32::max),
        hips_acceleration: hips_acceleration(finished),
        transition_acceleration: percentile(
            &mut accelerations(clips, &log.poses, |i| is_of_transition(log, rate_hz, i)),
            0.99,
        ),
        clip_acceleration: clip_acceleration(clips),
        driver_us: Cost {
            median: percentile(&mut log.driver_us.clone(), 0.5),
            p95: percentile(&mut log.driver_us.clone(), 0.95),
        },
        orders: responses(log, styled, orders.log(), speeds, rate_hz),
    }
}

/// Returns mean and 95th percentile of the distances of positions from a line.
fn path_error(path: &[Vec2], places: &[Vec2]) -> PathError {
    let distance = |place: Vec2| {
        let to = |piece: &[Vec2]| {
            let (along, off) = (piece[1] - piece[0], place - piece[0]);
            let t = (off.dot(along) / along.length_squared().max(f32::MIN_POSITIVE)).clamp(0.0, 1.0);
            off.distance(along * t)
        };
        path.windows(2).map(to).fold(f32::INFINITY, f32::min)
    };
    let mut distances: Vec<f32> = places.iter().map(|&place| distance(place)).collect();
    let mean = distances.iter().sum::<f32>() / distances.len() as f32;
    PathError { mean, p95: percentile(&mut distances, 0.95) }
}

fn percentile(values: &mut [f32], share: f32) -> f32 {
    values.sort_by(f32::total_cmp);
    let last = values.len().saturating_sub(1);
    values.get((share * last as f32) as usize).copied().unwrap_or_default()
}

fn ground(pose: &Pose) -> Vec2 {
    Vec2::new(pose.root.x, pose.root.z)
}

/// Returns the displayed neutral character, with footplant.
fn planted(clips: &DrivingClips, log: &Log) -> Vec<Pose> {
    let mut ghost = LiveFigure::new(&clips.proportions, clips.rate_hz, Place::Follow, true);
    let frames = log.poses.iter().zip(&log.contacts);
    frames.map(|(pose, feet)| ghost.next(pose, feet.map(f32::from), pose, false)).collect()
}

fn hips_acceleration(motion: &HumanoidMotion) -> Peak {
    let hips: Vec<Vec2> = motion.poses.iter().map(ground).collect();
    let of = |at: &[Vec2]| (at[0] - 2.0 * at[1] + at[2]).length() * motion.rate_hz * motion.rate_hz;
    let mut all: Vec<f32> = hips.windows(3).map(of).collect();
    Peak { p999: percentile(&mut all, 0.999), most: percentile(&mut all, 1.0) }
}

fn skate(clips: &DrivingClips, log: &Log, planted: &[Pose], finished: &HumanoidMotion) -> Skate {
    let motion = |poses: Vec<Pose>| HumanoidMotion { proportions: clips.proportions, rate_hz: clips.rate_hz, poses };
    Skate {
        driven: foot_skate(&motion(log.poses.clone()), &log.contacts),
        planted: foot_skate(&motion(planted.to_vec()), &log.contacts),
        styled: foot_skate(finished, &label(finished)),
    }
}

fn is_of_transition(log: &Log, rate_hz: f32, frame: usize) -> bool {
    let before = (TRANSITION_SECS * rate_hz).round() as usize;
    log.switched[frame.saturating_sub(before)..=frame].contains(&true)
}

/// Returns the acceleration of every joint in the chosen frames, m/s².
fn accelerations(clips: &DrivingClips, poses: &[Pose], chosen: impl Fn(usize) -> bool) -> Vec<f32> {
    let joints: Vec<[Vec3; JOINTS]> =
        poses.iter().map(|pose| world_from_local(&clips.proportions, pose).positions).collect();
    let per_sec2 = clips.rate_hz * clips.rate_hz;
    let of = |i: usize| {
        let [a, b, c] = [&joints[i - 1], &joints[i], &joints[i + 1]];
        let each: [f32; JOINTS] = std::array::from_fn(|j| (a[j] - 2.0 * b[j] + c[j]).length() * per_sec2);
        each
    };
    (1..joints.len().saturating_sub(1)).filter(|&i| chosen(i)).flat_map(of).collect()
}

/// Returns the 99th percentile of the joints' world acceleration in the database's own locomotion.
fn clip_acceleration(clips: &DrivingClips) -> f32 {
    let mut all = Vec::new();
    let own = clips.clips().iter().filter(|clip| clip.kind == ClipKind::Locomotion && !clip.mirrored);
    for clip in own {
        let (mut place, mut heading) = (Vec3::ZERO, 0.0);
        let poses: Vec<Pose> = clip
            .rows
            .clone()
            .map(|row| {
                let motion = clips.motion(row);
                heading += motion.turn_rate / clips.rate_hz;
                let turn = strut_core::math::Quat::from_rotation_y(heading);
                place += turn * Vec3::new(motion.velocity.x, 0.0, motion.velocity.y) / clips.rate_hz;
                let mut pose = *clips.pose(row);
                pose.root = turn * pose.root + place;
                pose.rotations[0] = turn * pose.rotations[0];
                pose
            })
            .collect();
        all.extend(accelerations(clips, &poses, |_| true));
    }
    percentile(&mut all, 0.99)
}

fn responses(
    log: &Log,
    styled: &[StyledFrame],
    controls: &[(f32, Control)],
    speeds: [f32; 2],
    rate_hz: f32,
) -> Vec<Response> {
    let frame_at = |secs: f32| ((secs * rate_hz).ceil() as usize).min(log.poses.len());
    let ends = controls.iter().skip(1).map(|(time, _)| frame_at(*time)).chain([log.poses.len()]);
    let each = controls.iter().zip(ends).filter(|((time, _), end)| frame_at(*time) < *end);
    each.map(|((time, control), end)| response(log, styled, frame_at(*time)..end, *time, control, speeds, rate_hz))
        .collect()
}

fn response(
    log: &Log,
    styled: &[StyledFrame],
    frames: std::ops::Range<usize>,
    time: f32,
    control: &Control,
    [walk, run]: [f32; 2],
    rate_hz: f32,
) -> Response {
    let gait = control.gait * control.wish.length();
    let asked = if gait <= 1.0 { gait * walk } else { walk + (gait - 1.0) * (run - walk) };
    let along = (gait > 0.0).then(|| atan2(control.wish.x, control.wish.y));
    let goal = control.face.or(along);
    let (begin, end) = (frames.start, frames.end);
    let place = |i: usize| Vec2::new(log.roots[i].x, log.roots[i].z);
    let first =
        |is_so: &dyn Fn(usize) -> bool| (begin..end).find(|&i| is_so(i)).map(|i| (i - begin + 1) as f32 / rate_hz);
    let enough = if gait > 0.0 { WALKING_DEGREES } else { STANDING_DEGREES }.to_radians();
    let from = log.speeds[begin];
    let changed = |share: f32| {
        let reached = from + share * (asked - from);
        first(&|i| if asked > from { log.speeds[i] >= reached } else { log.speeds[i] <= reached })
    };
    let before = begin.saturating_sub(1);
    let turned = |heading: &dyn Fn(usize) -> f32| {
        let way = wrap_angle(goal? - heading(before));
        let is_turn = way.abs() > enough;
        let by = |i: usize| wrap_angle(heading(i) - heading(before)) * way.signum();
        is_turn.then(|| (begin..end).find(|&i| by(i) > 1.0_f32.to_radians())).flatten().map(|i| i - begin + 1)
    };
    let hips = |i: usize| {
        let ahead = styled[i].pose.rotations[0] * Vec3::Z;
        atan2(ahead.x, ahead.z)
    };
    let changes = gait > 0.0 && (asked - from).abs() > 0.2;
    let stop_secs = (gait == 0.0 && from > STILL).then(|| first(&|i| log.speeds[i] < STILL)).flatten();
    let stopped = stop_secs.map(|secs| begin + (secs * rate_hz) as usize);
    Response {
        time,
        gait,
        turn: goal.map(|goal| wrap_angle(goal - log.roots[begin].heading).to_degrees()),
        first_degree_frames: turned(&|i| log.roots[i].heading),
        first_styled_degree_frames: turned(&hips),
        heading_secs: goal.and_then(|goal| first(&|i| wrap_angle(log.roots[i].heading - goal).abs() < enough)),
        half_speed_secs: changes.then(|| changed(0.5)).flatten(),
        speed_secs: changes.then(|| changed(0.9)).flatten(),
        stop_secs,
        stop_m: stopped.map(|i| place(i.min(end - 1)).distance(place(begin))),
        moved_m: place(end - 1).distance(place(begin)),
        action_secs: first(&|i| log.acted[i]),
        acted_secs: log.acted[begin..end].iter().filter(|acted| **acted).count() as f32 / rate_hz,
    }
}
