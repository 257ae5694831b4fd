//! The scripts of jumps, punches and kicks, with the key poses that all styles share.

use crate::drill::{Drill, Move};
use crate::forms::{Arm, Swing, arm};
use crate::keys::{Body, Foot, Key};
use crate::path::Side;
use crate::pelvis::GRAVITY;
use crate::style::Style;

const fn foot(ahead: f32, lift: f32, pitch: f32) -> Foot {
    Foot { out: 0.0, ahead, lift, pitch, turn: 0.0 }
}

pub(crate) const UPRIGHT: Body =
    Body { aside: 0.0, ahead: 0.0, drop: 0.0, yaw: 0.0, pitch: 0.0, chest_yaw: 0.0, bend: 0.0 };
pub(crate) const FLAT: Foot = foot(0.0, 0.0, 0.0);
/// The pelvis' share of the trunk's bend.
const PELVIS_SHARE: f32 = 0.45;

/// Greatest flexion of a hanging arm, degrees, even if the style holds it higher in walking.
const MOST_HANGING: f32 = 9.0;

/// Standing at ease: the arms hang as in the style.
pub(crate) fn standing(style: &Style) -> Key {
    let flexion = (5.0 + style.arm_forward).min(MOST_HANGING);
    let hanging = arm(flexion, style.arm_spread, style.arm_twist, 0.8 * style.elbow);
    Key { secs: 0.5, airborne: false, body: UPRIGHT, arms: [hanging; 2], feet: [FLAT; 2], swings: [None; 2] }
}

/// Interpolates between two arms, `t` in [0, 1].
fn between(a: Arm, b: Arm, t: f32) -> Arm {
    let mix = |of: fn(&Arm) -> f32| of(&a) + (of(&b) - of(&a)) * t;
    Arm { flexion: mix(|a| a.flexion), spread: mix(|a| a.spread), twist: mix(|a| a.twist), elbow: mix(|a| a.elbow) }
}

/// A body whose trunk is bent forward by this angle in total.
fn bent(degrees: f32) -> Body {
    Body { pitch: PELVIS_SHARE * degrees, bend: (1.0 - PELVIS_SHARE) * degrees, ..UPRIGHT }
}

/// A jump with arm swing: the dip takes half a second, the push a quarter (Bobbert & van Ingen Schenau 1988,
/// "Coordination in vertical jumping"; arms: Lees, Vanrenterghem & De Clercq 2004). The landing is braked evenly.
fn jump_keys(style: &Style, size: f32) -> Vec<Key> {
    let form = &style.jump;
    let standing = standing(style);
    let both = |arm: Arm| [arm; 2];
    let rolled = |pitch: f32| [foot(0.0, 0.0, pitch); 2];
    let landing_speed = (2.0 * GRAVITY * form.rise * size).sqrt();
    let landing = form.landing * size.sqrt();
    vec![
        Key {
            secs: 0.46,
            body: Body { drop: form.dip * size.sqrt(), ahead: -0.03, ..bent(form.dip_bend) },
            arms: both(form.wind_up),
            ..standing
        },
        Key {
            secs: 0.28,
            airborne: true,
            body: Body { drop: -0.03 * (4.0 * form.rise).min(1.0), ahead: 0.06, ..bent(0.4 * form.air_bend) },
            arms: form.aloft.map(|aloft| between(form.wind_up, aloft, 0.86)),
            feet: rolled(-56.0),
            ..standing
        },
        Key {
            airborne: true,
            body: Body { ahead: 0.03, ..bent(form.air_bend) },
            arms: form.aloft,
            swings: form.legs.map(Some),
            ..standing
        },
        Key {
            body: bent(0.3 * form.air_bend + 0.3 * form.landing_bend),
            arms: form.aloft.map(|aloft| between(aloft, form.catch, 0.5)),
            feet: rolled(-28.0),
            ..standing
        },
        Key {
            secs: 2.1 * landing / landing_speed * form.speed,
            body: Body { drop: landing, ahead: -0.01, ..bent(form.landing_bend) },
            arms: both(form.catch),
            ..standing
        },
        Key { secs: 0.5, ..standing },
    ]
}

const fn jump(size: f32, ahead: f32) -> Move {
    Move { keys: jump_keys, side: Side::Right, size, ahead }
}

/// The take of the jumping database.
pub const JUMPS: Drill = Drill {
    name: "jumps",
    action: "jump",
    rest: standing,
    speed: |style| style.jump.speed,
    rise: |style| style.jump.rise,
    firm: 0.0,
    moves: &[jump(1.0, 0.0), jump(1.0, 0.45), jump(0.75, 0.0), jump(1.1, 0.25), jump(0.9, 0.6)],
    seed: 31,
};

/// On guard: the left foot ahead, fists in front of the chin, the right shoulder slightly back.
fn guard(style: &Style) -> Key {
    let form = &style.punch;
    Key {
        body: Body { ahead: 0.01, drop: 0.003 + 0.7 * form.stance * form.stance, yaw: -12.0, ..UPRIGHT },
        arms: [form.guard; 2],
        feet: [foot(form.stance, 0.0, 0.0), foot(-form.stance, 0.0, 0.0)],
        ..standing(style)
    }
}

/// An arm at the angle `reach` from straight ahead, while the chest is turned by `turned` degrees.
fn towards(reach: Arm, turned: f32) -> Arm {
    Arm { spread: reach.spread + turned, ..reach }
}

/// A straight punch of the rear hand: weight goes back, then forward with the turning hips; the hips lead the chest and
/// the chest the arm (Turner, Baker & Miller 2011, "Increasing the impact force of the rear hand punch").
fn cross_keys(style: &Style, size: f32) -> Vec<Key> {
    let form = &style.punch;
    let guard = guard(style);
    let rolled = |pitch: f32| [guard.feet[0], Foot { pitch, ..guard.feet[1] }];
    let turn = form.turn * size;
    let reach = Key {
        secs: 0.21,
        body: Body {
            ahead: form.shift * size,
            drop: guard.body.drop + 0.01,
            yaw: 0.4 * turn,
            chest_yaw: 0.6 * turn,
            ..bent(form.lean)
        },
        arms: [form.other, towards(form.reach, turn)],
        feet: rolled(-0.6 * turn),
        ..guard
    };
    vec![
        Key {
            secs: 0.17 * form.wind_up_time,
            body: Body {
                ahead: -0.25 * form.shift,
                yaw: -12.0 - 0.25 * turn,
                chest_yaw: -0.25 * turn,
                ..bent(-0.25 * form.lean)
            },
            arms: [form.guard, form.wind_up],
            ..guard
        },
        reach,
        Key { secs: form.hold, ..reach },
        Key {
            secs: 0.18,
            body: Body { ahead: 0.2 * form.shift, yaw: -8.0, ..bent(0.2 * form.lean) },
            arms: [between(form.other, form.guard, 0.7), between(form.reach, form.guard, 0.6)],
            feet: rolled(-0.15 * turn),
            ..guard
        },
        Key { secs: 0.18, ..guard },
    ]
}

/// A jab of the leading hand.
fn jab_keys(style: &Style, size: f32) -> Vec<Key> {
    let form = &style.punch;
    let guard = guard(style);
    let turn = 0.8 * form.turn * size;
    let reach = Key {
        secs: 0.20,
        body: Body { ahead: 0.8 * form.shift * size, yaw: -0.5 * turn, chest_yaw: -0.5 * turn, ..bent(form.lean) },
        arms: [towards(form.reach, turn), form.other],
        ..guard
    };
    vec![
        Key {
            secs: 0.16 * form.wind_up_time,
            body: Body { ahead: -0.01, yaw: -4.0, chest_yaw: 0.2 * turn, ..bent(-0.2 * form.lean) },
            arms: [form.wind_up, form.guard],
            ..guard
        },
        reach,
        Key { secs: form.hold, ..reach },
        Key { secs: 0.31, ..guard },
    ]
}

const fn punch(keys: fn(&Style, f32) -> Vec<Key>, size: f32) -> Move {
    Move { keys, side: Side::Right, size, ahead: 0.0 }
}

/// The take of the punching database.
pub const PUNCHES: Drill = Drill {
    name: "punches",
    action: "punch",
    rest: guard,
    speed: |style| style.punch.speed,
    rise: |_| 0.0,
    firm: 1.0,
    moves: &[
        punch(cross_keys, 1.0),
        punch(jab_keys, 1.0),
        punch(cross_keys, 0.9),
        punch(jab_keys, 0.85),
        punch(jab_keys, 1.05),
        punch(cross_keys, 1.1),
        punch(cross_keys, 0.95),
        punch(jab_keys, 0.95),
        punch(cross_keys, 1.0),
        punch(jab_keys, 1.0),
        punch(cross_keys, 0.92),
    ],
    seed: 41,
};

/// A front kick: the weight shifts, the knee rises folded, the shin whips out and back before the foot is set down
/// (Falco et al. 2009; Sørensen et al. 1996, "Dynamics of the martial arts high front kick": thigh, then shin).
fn kick_keys(style: &Style, size: f32) -> Vec<Key> {
    let form = &style.kick;
    let standing = standing(style);
    let hanging = standing.arms[0];
    let on_one_leg = |ahead: f32, lean: f32| Body { aside: 0.085, ahead, drop: form.sink, ..bent(lean) };
    let raised = |t: f32| form.arms.map(|raised| between(hanging, raised, t));
    let strike = Key {
        secs: 0.18,
        body: Body { yaw: 12.0, chest_yaw: -14.0, ..on_one_leg(-0.03, form.lean) },
        arms: form.arms,
        swings: [None, Some(Swing { hip: form.strike.hip * size, ..form.strike })],
        ..standing
    };
    vec![
        Key {
            secs: 0.26,
            body: Body { aside: 0.075, drop: 0.014, yaw: -5.0, chest_yaw: 4.0, ..bent(0.1 * form.lean) },
            arms: raised(0.3),
            feet: [FLAT, foot(0.0, 0.0, -24.0)],
            ..standing
        },
        Key {
            secs: 0.24,
            body: on_one_leg(-0.01, 0.5 * form.lean),
            arms: raised(0.8),
            swings: [None, Some(form.chamber)],
            ..standing
        },
        strike,
        Key { secs: form.hold, ..strike },
        Key {
            secs: 0.18,
            body: on_one_leg(-0.01, 0.5 * form.lean),
            arms: raised(0.8),
            swings: [None, Some(Swing { hip: 0.62 * form.strike.hip, knee: 62.0, ankle: -18.0, ..form.strike })],
            ..standing
        },
        Key {
            secs: 0.25,
            body: Body { aside: 0.045, drop: 0.02, ..bent(0.1 * form.lean) },
            arms: raised(0.3),
            ..standing
        },
        Key { secs: 0.28, ..standing },
    ]
}

const fn kick(side: Side, size: f32) -> Move {
    Move { keys: kick_keys, side, size, ahead: 0.0 }
}

/// The take of the kicking database.
pub const KICKS: Drill = Drill {
    name: "kicks",
    action: "kick",
    rest: standing,
    speed: |style| style.kick.speed,
    rise: |_| 0.0,
    firm: 0.5,
    moves: &[
        kick(Side::Right, 1.0),
        kick(Side::Left, 1.0),
        kick(Side::Right, 0.85),
        kick(Side::Right, 1.06),
        kick(Side::Left, 0.92),
        kick(Side::Left, 1.0),
        kick(Side::Right, 1.0),
        kick(Side::Left, 0.88),
    ],
    seed: 51,
};

/// The first moves of a drill.
const fn first(moves: usize, drill: Drill) -> Drill {
    Drill { moves: drill.moves.split_at(moves).0, ..drill }
}

/// The drills of the page's database, which must stay below 1.5 MB.
pub(crate) const PAGE_DRILLS: [Drill; 3] = [first(3, JUMPS), first(4, PUNCHES), first(3, KICKS)];

/// Jumps, punches and kicks of the page's inputs: different moves from the database's.
pub(crate) const INPUT_JUMP: Drill = Drill { moves: &[jump(0.95, 0.3)], seed: 131, ..JUMPS };
/// See `INPUT_JUMP`.
pub(crate) const INPUT_PUNCHES: Drill =
    Drill { moves: &[punch(jab_keys, 0.95), punch(cross_keys, 1.05), punch(jab_keys, 1.0)], seed: 141, ..PUNCHES };
/// See `INPUT_JUMP`.
pub(crate) const INPUT_KICKS: Drill =
    Drill { moves: &[kick(Side::Right, 0.95), kick(Side::Left, 1.0)], seed: 151, ..KICKS };
