//! The floor of a clip: the height of the soles while they rest.
//!
//! No standard puts the ground of a file at height 0: optical systems leave it at their calibration, body models export with
//! the hips at the origin. A body 5 cm above the floor bends its knees 15° more on another body.

use super::binding::Binding;
use super::sample::local;
use crate::humanoid::{Proportions, Role};
use crate::kinematics::{Sole, Soles};
use crate::math::stats::quantile;
use crate::math::{Quat, Vec3};
use crate::motion::Motion;
use crate::note::{Note, NoteCode};

/// Leg length for which the lengths and speeds below were measured, metres.
const REFERENCE_LEG: f32 = 0.8;
/// A sole rests below this speed, m/s: the threshold of contacts (`crate::contact`).
const RESTING_SPEED: f32 = 0.45;
/// Speeds are differences over about this time, seconds.
const SPEED_SECS: f64 = 1.0 / 60.0;
/// The lowest resting soles are those from this quantile of their heights …
const LOWEST_SHARE: f32 = 0.1;
/// … up to this distance above it, metres: the floor is their median.
const NEAR_LOWEST: f32 = 0.03;
/// Soles must rest for this total time, seconds, for the clip to have a measured floor.
const LEAST_REST_SECS: f32 = 0.1;
/// A floor nearer to 0 than this is set to 0, metres: it is within the error of the estimate, and values then stay unchanged.
const ZERO: f32 = 0.005;
/// Shortest rest that counts as standing on another level, seconds, and its least height above the floor, metres.
const LEVEL_SECS: f32 = 0.25;
const LEVEL_HEIGHT: f32 = 0.15;

/// A floor farther than this from height 0 is noted, metres: those of recordings are within 4.2 cm.
const NOTED: f32 = 0.05;

/// Ground of a clip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Floor {
    /// Height in our axes, metres.
    pub(super) height: f32,
    /// Whether a sole rests on it; otherwise it is the lowest height of a sole.
    pub(super) is_seen: bool,
    /// Height above it of the highest level on which a foot stands, metres; 0 without another level.
    pub(super) highest_level: f32,
}

impl Floor {
    /// Notes on the floor for users.
    pub(super) fn notes(&self) -> Vec<Note> {
        let cm = |metres: f32| (100.0 * metres.abs()).round();
        let side = if self.height < 0.0 { "below" } else { "above" };
        let mut notes = Vec::new();
        if !self.is_seen {
            let text = "No foot rests on the ground in this clip. The lowest point of the soles was used as the floor";
            notes.push(Note::new(NoteCode::NoFloor, format!("{text}, {} cm {side} height 0.", cm(self.height))));
        } else if self.height.abs() > NOTED {
            let text = format!("The feet rest {} cm {side} height 0; the floor was set there.", cm(self.height));
            notes.push(Note::new(NoteCode::Floor, text));
        }
        if self.highest_level > 0.0 {
            let text = format!("The feet rest up to {} cm above the lowest floor", cm(self.highest_level));
            notes.push(Note::new(NoteCode::FloorChanges, text + ". One floor height was used for the whole clip."));
        }
        notes
    }
}

/// Measures the floor of a clip whose skeleton was bound.
pub(super) fn floor_of(motion: &Motion, binding: &Binding) -> Floor {
    let soles = soles_of(motion, binding);
    let scale = (binding.proportions.leg_length() / REFERENCE_LEG).clamp(0.4, 2.5);
    let rests = |side: usize, frame: usize| speed(motion, &soles, side, frame) < RESTING_SPEED * scale;
    let lowest = |side: usize, frame: usize| soles[frame][side].lowest();
    let resting: Vec<[bool; 2]> = (0..soles.len()).map(|frame| [0, 1].map(|side| rests(side, frame))).collect();

    let frames_and_sides = (0..soles.len()).flat_map(|frame| [(0, frame), (1, frame)]);
    let heights = |f: &dyn Fn(usize, usize) -> bool| {
        let chosen = frames_and_sides.clone().filter(|&(side, frame)| f(side, frame));
        sorted(chosen.map(|(side, frame)| lowest(side, frame)))
    };
    let at_rest = heights(&|side, frame| resting[frame][side]);
    let least = (f64::from(LEAST_REST_SECS) / motion.frame_time_secs).ceil() as usize;
    if at_rest.len() < least.min(soles.len()).max(1) {
        let all = heights(&|_, _| true);
        return Floor { height: snapped(quantile(&all, 0.0)), is_seen: false, highest_level: 0.0 };
    }
    let near = quantile(&at_rest, LOWEST_SHARE) + NEAR_LOWEST * scale;
    let on_floor = &at_rest[..at_rest.partition_point(|&height| height <= near)];
    let height = quantile(on_floor, 0.5);
    let shortest = (f64::from(LEVEL_SECS) / motion.frame_time_secs).ceil() as usize;
    let levels = [0, 1].map(|side| highest_level(&soles, &resting, side, shortest));
    let above = levels.into_iter().flatten().fold(height, f32::max) - height;
    let highest_level = if above > LEVEL_HEIGHT * scale { above } else { 0.0 };
    Floor { height: snapped(height), is_seen: true, highest_level }
}

fn snapped(height: f32) -> f32 {
    if height.abs() < ZERO { 0.0 } else { height }
}

fn sorted(values: impl Iterator<Item = f32>) -> Vec<f32> {
    let mut sorted: Vec<f32> = values.filter(|v| v.is_finite()).collect();
    sorted.sort_by(f32::total_cmp);
    sorted
}

/// The highest level on which a foot rests for long enough to stand there.
fn highest_level(soles: &[[Sole; 2]], resting: &[[bool; 2]], side: usize, shortest: usize) -> Option<f32> {
    let (mut highest, mut frame) = (None, 0);
    for run in resting.chunk_by(|a, b| a[side] == b[side]) {
        let frames = frame..frame + run.len();
        frame = frames.end;
        if run[0][side] && run.len() >= shortest {
            let lowest = soles[frames].iter().map(|sole| sole[side].lowest()).fold(f32::MAX, f32::min);
            highest = Some(highest.map_or(lowest, |highest: f32| highest.max(lowest)));
        }
    }
    highest
}

/// Speed of the lower point of a sole at a frame, m/s: a central difference, one-sided at the ends.
fn speed(motion: &Motion, soles: &[[Sole; 2]], side: usize, frame: usize) -> f32 {
    let half = ((SPEED_SECS / motion.frame_time_secs).round() as usize).max(1);
    let (before, after) = (frame.saturating_sub(half), (frame + half).min(soles.len() - 1));
    let [a, b, here] = [before, after, frame].map(|f| soles[f][side]);
    let way = if here.heel.y < here.ball.y { b.heel - a.heel } else { b.ball - a.ball };
    way.length() / ((after - before).max(1) as f64 * motion.frame_time_secs) as f32
}

/// Ground points of both feet in every frame, in our axes, metres.
fn soles_of(motion: &Motion, binding: &Binding) -> Vec<[Sole; 2]> {
    let proportions: &Proportions = &binding.proportions;
    let soles = Soles::new(proportions);
    let of_role = |role: Role| binding.joint_of_role[role.index()];
    // Only the ancestors of the feet are computed.
    let mut leads = vec![false; motion.skeleton.len()];
    for joint in Soles::JOINTS.iter().flatten().filter_map(|&role| of_role(role)) {
        std::iter::successors(Some(joint), |&j| binding.parents[j]).for_each(|j| leads[j] = true);
    }
    let joints: Vec<usize> = (0..leads.len()).filter(|&j| leads[j]).collect();
    let mut world = vec![(Vec3::ZERO, binding.world_from_file); leads.len()];
    let of_frame = |frame: usize| {
        let (translations, rotations) = (motion.translations_at(frame), motion.rotations_at(frame));
        for &joint in &joints {
            let above = binding.parents[joint].map_or((Vec3::ZERO, binding.world_from_file), |p| world[p]);
            let (translation, rotation) = local(translations[joint], rotations[joint], binding.is_mirrored);
            world[joint] = (above.0 + above.1 * (translation * binding.metres_per_unit), above.1 * rotation);
        }
        [0, 1].map(|side| {
            let [foot, toes] = Soles::JOINTS[side];
            let turned = |joint: usize| world[joint].1 * binding.rest_world_rotations[joint].inverse();
            let (ankle, foot) = of_role(foot).map_or((Vec3::ZERO, Quat::IDENTITY), |j| (world[j].0, turned(j)));
            let (toe_joint, toes) = of_role(toes)
                .map_or_else(|| (ankle + foot * proportions.offsets[toes.index()], foot), |j| (world[j].0, turned(j)));
            let sole = soles.from_ankle(side, [foot, toes], Vec3::ZERO);
            // The heel relative to the ankle, the ball relative to the toe joint.
            Sole { heel: ankle + sole.heel, ball: toe_joint + sole.ball }
        })
    };
    (0..motion.frames()).map(of_frame).collect()
}
