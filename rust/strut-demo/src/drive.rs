//! Takes for driving that recorded data sets lack: standing, turns in place, halts, changes of gait and sharp curves
//! (`docs/driving.md`). All are neutral.

use crate::action::Action;
use crate::database::{RATE_HZ, build, source_clip};
use crate::drill::{Drill, Move, keys_of, perform_drill};
use crate::drills::{FLAT, UPRIGHT, standing};
use crate::interlude::{Interlude, perform_interlude};
use crate::keys::{Body, Foot, Key};
use crate::path::Side;
use crate::perform::{Excursion, Performance, perform, perform_transition};
use crate::script::{Passage, Script, passage};
use crate::style::Style;
use crate::styles::STYLES;
use crate::takes::TRANSITIONS;
use std::ops::Range;
use strut_core::database::Database;
use strut_core::database::build::{BuildError, SourceClip};
use strut_core::humanoid::{HumanoidMotion, Proportions};
use strut_core::math::float_funcs::{cos, sin};

/// Sideways shift of the weight while waiting, metres, and its duration, seconds.
const SHIFT: f32 = 0.035;
const SHIFT_SECS: f32 = 1.1;
/// Share of a turn in place by which the first foot turns; the second foot then turns all of it.
const OPENING: f32 = 0.85;
/// Height by which a turning foot is lifted, metres.
const TURNING_LIFT: f32 = 0.045;
/// Shift of the weight towards the supporting foot, metres.
const TURNING_SHIFT: f32 = 0.04;
/// Time before and after the standing part of a halt, seconds: from walking before to walking after.
const BEFORE_HALT_SECS: f32 = 1.25;
const AFTER_HALT_SECS: f32 = 1.5;

const fn at_ease(name: &'static str, moves: &'static [Move]) -> Drill {
    Drill { name, action: "stand", rest: standing, speed: |_| 1.0, rise: |_| 0.0, firm: 0.3, moves, seed: 201 }
}

const fn to_either_side(keys: fn(&Style, f32) -> Vec<Key>, size: f32) -> Move {
    Move { keys, side: Side::Right, size, ahead: 0.0 }
}

/// Waits, with the weight shifting from one foot to the other.
const IDLE: Drill = at_ease("idle", &[to_either_side(shift_keys, 1.0), to_either_side(shift_keys, 0.8)]);
/// Turns in place to the left, by 45, 90 and 135 degrees.
const TURNS: [Drill; 3] = [
    at_ease("turn by 45", &[to_either_side(turn_keys, 45.0)]),
    at_ease("turn by 90", &[to_either_side(turn_keys, 90.0)]),
    at_ease("turn by 135", &[to_either_side(turn_keys, 135.0)]),
];
/// Stands between two walks.
const STANDING: [Drill; 1] = [at_ease("stand", &[to_either_side(still_keys, 1.0)])];

/// The weight shifts to the left, to the right, and back to the middle.
fn shift_keys(style: &Style, size: f32) -> Vec<Key> {
    let rest = standing(style);
    let leaning = |aside: f32| {
        let body = Body { aside: aside * size, drop: 0.004, chest_yaw: -40.0 * aside * size, ..UPRIGHT };
        Key { secs: SHIFT_SECS, body, ..rest }
    };
    vec![leaning(SHIFT), leaning(-SHIFT), Key { secs: SHIFT_SECS, ..rest }]
}

fn still_keys(style: &Style, _: f32) -> Vec<Key> {
    let half = Key { secs: 0.5, ..standing(style) };
    vec![half, half]
}

/// A turn to the left by `degrees`: the left foot starts it, the right one follows, and the left one completes it.
fn turn_keys(style: &Style, degrees: f32) -> Vec<Key> {
    let rest = standing(style);
    // Shares of the turn by which the pelvis and the feet have turned, the side that carries the weight, the foot in
    // the air.
    let key = |secs: f32, pelvis: f32, [left, right]: [f32; 2], weight: f32, lifted: Option<usize>| {
        let foot = |side: usize, share: f32| {
            let lift = if lifted == Some(side) { TURNING_LIFT } else { 0.0 };
            let pitch = if lifted == Some(side) { -8.0 } else { 0.0 };
            Foot { turn: share * degrees, lift, pitch, ..FLAT }
        };
        // Towards the left of the mean direction of the feet.
        let faced = (0.5 * (left + right) * degrees).to_radians();
        let towards = TURNING_SHIFT * weight;
        let body = Body {
            aside: towards * cos(faced),
            ahead: -towards * sin(faced),
            drop: 0.012,
            yaw: pelvis * degrees,
            chest_yaw: 0.12 * degrees * (1.0 - pelvis) * pelvis * 4.0,
            ..UPRIGHT
        };
        Key { secs, body, feet: [foot(0, left), foot(1, right)], ..rest }
    };
    let closed = key(0.22, 1.0, [1.0, 1.0], 0.0, None);
    vec![
        key(0.2, 0.06, [0.0, 0.0], -1.0, None),
        key(0.2, 0.34, [0.5 * OPENING, 0.0], -1.0, Some(0)),
        key(0.2, 0.6, [OPENING, 0.0], 0.0, None),
        key(0.14, 0.72, [OPENING, 0.0], 1.0, None),
        key(0.18, 0.88, [OPENING, 0.55], 1.0, Some(1)),
        key(0.18, 0.97, [OPENING, 1.0], 0.0, None),
        key(0.14, 0.99, [OPENING, 1.0], -0.9, None),
        key(0.18, 1.0, [0.95, 1.0], -0.9, Some(0)),
        Key { body: Body { drop: 0.0, chest_yaw: 0.0, ..closed.body }, ..closed },
    ]
}

/// A walk at a speed, as a multiple of the preferred one, with a halt.
const fn halt(name: &'static str, passages: &'static [Passage], seed: u64) -> Interlude {
    let script = Script { name, action: Action::Walk, passages, seed };
    Interlude {
        gait: Excursion { script, to: Action::Walk, over: [0.0, 1.0], back: [1.0, 2.0] },
        halt: 3,
        drills: &STANDING,
    }
}

const HALTS: [Interlude; 3] = [
    halt("halt from a stroll", &[passage(7, 0.45, 0.0)], 211),
    halt("halt from a slow walk", &[passage(7, 0.7, 0.0)], 212),
    halt("halt from a walk", &[passage(7, 1.0, 0.0)], 213),
];

/// Curves that are sharper than those of the built-in walks.
const CURVES: [Script; 1] = [Script {
    name: "sharp curves",
    action: Action::Walk,
    passages: &[passage(1, 0.9, 0.0), passage(3, 0.75, 250.0), passage(1, 0.9, 0.0)],
    seed: 221,
}];

/// Takes for driving in addition to those of a database, each a neutral clip.
///
/// # Errors
/// Never for the clips of this crate; the error is returned so that the caller need not panic.
pub fn driving_database() -> Result<Database, BuildError> {
    let drills = [IDLE].into_iter().chain(TURNS).map(|drill| {
        let take = perform_drill(&drill, &STYLES[0], &Proportions::default(), RATE_HZ);
        debug_assert!(take.phase.iter().all(|&phase| phase <= keys_of(&drill)));
        clip("stand", drill.name, take)
    });
    let halts = HALTS.iter().map(|interlude| clip("halt", interlude.name(), perform_halt(interlude)));
    let changes = TRANSITIONS.iter().map(|transition| {
        let take = perform_transition(transition, &STYLES[0], &Proportions::default(), RATE_HZ);
        clip("change of gait", transition.script.name, take)
    });
    let curves = CURVES
        .iter()
        .map(|script| clip("walk", script.name, perform(script, &STYLES[0], &Proportions::default(), RATE_HZ)));
    let clips: Vec<SourceClip> = drills.chain(halts).chain(changes).chain(curves).collect();
    build(&clips, RATE_HZ)
}

fn clip(action: &str, name: &str, take: Performance) -> SourceClip {
    source_clip([action, name, STYLES[0].name], 1, take, |phase| phase)
}

/// The halt and the strides around it.
fn perform_halt(interlude: &Interlude) -> Performance {
    let whole = perform_interlude(interlude, &STYLES[0], &Proportions::default(), RATE_HZ);
    let stood = standing_frames(&whole.planted);
    let frames = |secs: f32| (secs * RATE_HZ).round() as usize;
    let end = (stood.end + frames(AFTER_HALT_SECS)).min(whole.phase.len());
    let kept = stood.start.saturating_sub(frames(BEFORE_HALT_SECS))..end;
    Performance {
        motion: HumanoidMotion { poses: whole.motion.poses[kept.clone()].to_vec(), ..whole.motion },
        phase: whole.phase[kept.clone()].to_vec(),
        planted: whole.planted[kept].to_vec(),
    }
}

/// Longest period in which both feet are planted.
fn standing_frames(planted: &[[bool; 2]]) -> Range<usize> {
    let mut longest = 0..0;
    let mut begin = 0;
    for (i, feet) in planted.iter().enumerate() {
        if *feet != [true; 2] {
            begin = i + 1;
        } else if i + 1 - begin > longest.len() {
            longest = begin..i + 1;
        }
    }
    longest
}

#[cfg(test)]
mod tests {
    use super::*;
    use strut_core::kinematics::world_from_local;
    use strut_core::math::float_funcs::wrap_angle;
    use strut_core::pose_vector::heading_of;

    fn take(db: &Database, name: &str) -> HumanoidMotion {
        let clip = db.clips.iter().position(|clip| clip.name.contains(name)).unwrap();
        db.motion_of_clip(clip)
    }

    #[test]
    fn turns_turn_by_what_they_say_and_stay_where_they_are() {
        let db = driving_database().unwrap();
        for degrees in [45.0_f32, 90.0, 135.0] {
            let motion = take(&db, &format!("turn by {degrees}"));
            let [first, last] = [motion.poses.first(), motion.poses.last()].map(Option::unwrap);
            let heading = |pose| heading_of(&world_from_local(&motion.proportions, pose)).unwrap();
            let turned = wrap_angle(heading(last) - heading(first));
            assert!((turned - degrees.to_radians()).abs() < 0.05, "{degrees}: {turned}");
            assert!((last.root - first.root).length() < 0.02, "{} {}", first.root, last.root);
            let secs = motion.poses.len() as f32 / RATE_HZ;
            assert!((secs - 1.65).abs() < 0.1, "{secs}");
        }
    }

    #[test]
    fn halts_come_from_walking_and_go_back_to_it() {
        let db = driving_database().unwrap();
        for (name, speed) in [("stroll", 0.5), ("slow walk", 0.8), ("halt from a walk", 1.1)] {
            let motion = take(&db, name);
            let pace = |i: usize| (motion.poses[i + 1].root - motion.poses[i].root).with_y(0.0).length() * RATE_HZ;
            let mean = |frames: Range<usize>| frames.clone().map(pace).sum::<f32>() / frames.len() as f32;
            let n = motion.poses.len();
            assert!(mean(0..30) > 0.6 * speed && mean(n - 31..n - 1) > 0.6 * speed, "{name}: {}", mean(0..30));
            let still = (0..n - 31).map(|i| mean(i..i + 30)).fold(f32::INFINITY, f32::min);
            assert!(still < 0.05, "{name}: {still} m/s");
        }
    }
}
