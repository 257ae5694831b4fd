//! The scripts of jumps, punches and kicks.

use crate::drill::{Drill, Move};
use crate::keys::{Arm, Body, Foot, Key};
use crate::path::Side;

const fn arm(flexion: f32, spread: f32, twist: f32, elbow: f32) -> Arm {
    Arm { flexion, spread, twist, elbow }
}

const fn foot(ahead: f32, lift: f32, pitch: f32) -> Foot {
    Foot { out: 0.0, ahead, lift, pitch }
}

const UPRIGHT: Body = Body { aside: 0.0, ahead: 0.0, drop: 0.0, yaw: 0.0, pitch: 0.0, chest_yaw: 0.0, bend: 0.0 };
const HANGING: Arm = arm(2.0, 10.0, 15.0, 22.0);
const FLAT: Foot = foot(0.0, 0.0, 0.0);

/// Standing at ease.
const STANDING: Key = Key { secs: 0.5, airborne: false, body: UPRIGHT, arms: [HANGING; 2], feet: [FLAT; 2] };

/// A jump with arm swing: the dip takes half a second, the push a quarter (Bobbert & van Ingen Schenau 1988,
/// "Coordination in vertical jumping"; arms: Lees, Vanrenterghem & De Clercq 2004).
const JUMP: &[Key] = &[
    Key {
        secs: 0.48,
        body: Body { drop: 0.27, ahead: -0.03, pitch: 28.0, bend: 18.0, ..UPRIGHT },
        arms: [arm(-48.0, 14.0, 10.0, 20.0); 2],
        ..STANDING
    },
    Key {
        secs: 0.30,
        airborne: true,
        body: Body { drop: -0.03, ahead: 0.08, pitch: 4.0, bend: 2.0, ..UPRIGHT },
        arms: [arm(104.0, 12.0, 20.0, 45.0); 2],
        feet: [foot(0.0, 0.0, -58.0); 2],
    },
    Key {
        airborne: true,
        body: Body { drop: 0.0, ahead: 0.03, pitch: 6.0, bend: 4.0, ..UPRIGHT },
        arms: [arm(112.0, 14.0, 20.0, 55.0); 2],
        feet: [foot(0.02, -0.11, -48.0); 2],
        ..STANDING
    },
    Key {
        body: Body { drop: 0.0, ahead: 0.0, pitch: 10.0, bend: 8.0, ..UPRIGHT },
        arms: [arm(75.0, 22.0, 18.0, 50.0); 2],
        feet: [foot(0.0, 0.0, -28.0); 2],
        ..STANDING
    },
    Key {
        secs: 0.24,
        body: Body { drop: 0.24, ahead: -0.01, pitch: 24.0, bend: 16.0, ..UPRIGHT },
        arms: [arm(18.0, 26.0, 12.0, 40.0); 2],
        ..STANDING
    },
    Key { secs: 0.55, ..STANDING },
];

const fn jump(size: f32, ahead: f32) -> Move {
    Move { keys: JUMP, side: Side::Right, size, ahead }
}

/// The take of the jumping database.
pub const JUMPS: Drill = Drill {
    name: "jumps",
    action: "jump",
    rest: STANDING,
    moves: &[jump(1.0, 0.0), jump(1.0, 0.45), jump(0.75, 0.0), jump(1.1, 0.25), jump(0.9, 0.6)],
    seed: 31,
};

/// On guard: the left foot ahead, fists before the chin.
const GUARD: Key = Key {
    secs: 0.4,
    airborne: false,
    body: Body { ahead: 0.03, drop: 0.035, yaw: -18.0, bend: 4.0, ..UPRIGHT },
    arms: [arm(38.0, 12.0, 10.0, 118.0), arm(26.0, 14.0, 12.0, 128.0)],
    feet: [foot(0.17, 0.0, 0.0), foot(-0.16, 0.0, -12.0)],
};

/// A straight punch of the rear hand: weight goes back, then forward with the turning hips; the hips lead the chest and
/// the chest the arm (Turner, Baker & Miller 2011, "Increasing the impact force of the rear hand punch").
const CROSS: &[Key] = &[
    Key {
        secs: 0.26,
        body: Body { ahead: -0.02, drop: 0.05, yaw: -28.0, chest_yaw: -14.0, bend: 3.0, ..UPRIGHT },
        arms: [arm(42.0, 10.0, 10.0, 112.0), arm(2.0, 26.0, 8.0, 128.0)],
        ..GUARD
    },
    Key {
        secs: 0.24,
        body: Body { ahead: 0.12, drop: 0.06, yaw: 16.0, pitch: 5.0, chest_yaw: 28.0, bend: 8.0, ..UPRIGHT },
        arms: [arm(24.0, 12.0, 14.0, 128.0), arm(88.0, -4.0, 55.0, 6.0)],
        feet: [foot(0.17, 0.0, 0.0), foot(-0.16, 0.0, -38.0)],
        ..GUARD
    },
    Key {
        secs: 0.26,
        body: Body { ahead: 0.07, drop: 0.045, yaw: -6.0, chest_yaw: 4.0, bend: 5.0, ..UPRIGHT },
        arms: [arm(34.0, 12.0, 10.0, 120.0), arm(36.0, 14.0, 14.0, 118.0)],
        feet: [foot(0.17, 0.0, 0.0), foot(-0.16, 0.0, -20.0)],
        ..GUARD
    },
    Key { secs: 0.24, ..GUARD },
];

/// A jab of the leading hand.
const JAB: &[Key] = &[
    Key {
        secs: 0.20,
        body: Body { ahead: 0.0, drop: 0.045, yaw: -14.0, chest_yaw: 8.0, bend: 4.0, ..UPRIGHT },
        arms: [arm(22.0, 18.0, 10.0, 128.0), arm(28.0, 14.0, 12.0, 126.0)],
        ..GUARD
    },
    Key {
        secs: 0.21,
        body: Body { ahead: 0.085, drop: 0.045, yaw: -26.0, pitch: 3.0, chest_yaw: -16.0, bend: 5.0, ..UPRIGHT },
        arms: [arm(87.0, -2.0, 55.0, 7.0), arm(24.0, 14.0, 12.0, 128.0)],
        feet: [foot(0.17, 0.0, 0.0), foot(-0.16, 0.0, -24.0)],
        ..GUARD
    },
    Key { secs: 0.30, ..GUARD },
];

const fn punch(keys: &'static [Key], size: f32) -> Move {
    Move { keys, side: Side::Right, size, ahead: 0.0 }
}

/// The take of the punching database.
pub const PUNCHES: Drill = Drill {
    name: "punches",
    action: "punch",
    rest: GUARD,
    moves: &[
        punch(CROSS, 1.0),
        punch(JAB, 1.0),
        punch(CROSS, 0.9),
        punch(JAB, 0.85),
        punch(JAB, 1.05),
        punch(CROSS, 1.1),
        punch(CROSS, 0.95),
        punch(JAB, 0.95),
        punch(CROSS, 1.0),
    ],
    seed: 41,
};

/// A front kick: the weight shifts, the knee rises folded, the shin whips out and back before the foot is set down
/// (Falco et al. 2009; Sørensen et al. 1996, "Dynamics of the martial arts high front kick": thigh, then shin).
const KICK: &[Key] = &[
    Key {
        secs: 0.28,
        body: Body { aside: 0.075, drop: 0.015, yaw: -6.0, pitch: 2.0, chest_yaw: 4.0, ..UPRIGHT },
        arms: [arm(16.0, 16.0, 15.0, 42.0), arm(-8.0, 18.0, 15.0, 38.0)],
        feet: [FLAT, foot(0.0, 0.0, -24.0)],
        ..STANDING
    },
    Key {
        secs: 0.21,
        body: Body { aside: 0.085, ahead: -0.01, drop: 0.012, pitch: -8.0, chest_yaw: -4.0, bend: 4.0, ..UPRIGHT },
        arms: [arm(22.0, 22.0, 15.0, 62.0), arm(4.0, 26.0, 15.0, 52.0)],
        feet: [FLAT, foot(0.16, 0.42, -35.0)],
        ..STANDING
    },
    Key {
        secs: 0.19,
        body: Body { aside: 0.085, ahead: -0.03, drop: 0.015, yaw: 12.0, pitch: -22.0, chest_yaw: -16.0, bend: 6.0 },
        arms: [arm(34.0, 26.0, 15.0, 60.0), arm(-26.0, 30.0, 15.0, 36.0)],
        feet: [FLAT, foot(0.82, 0.75, 60.0)],
        ..STANDING
    },
    Key {
        secs: 0.20,
        body: Body { aside: 0.08, ahead: -0.01, drop: 0.012, yaw: 2.0, pitch: -8.0, chest_yaw: -4.0, bend: 4.0 },
        arms: [arm(22.0, 22.0, 15.0, 58.0), arm(0.0, 24.0, 15.0, 48.0)],
        feet: [FLAT, foot(0.20, 0.38, -22.0)],
        ..STANDING
    },
    Key {
        secs: 0.26,
        body: Body { aside: 0.045, drop: 0.02, pitch: 1.0, bend: 2.0, ..UPRIGHT },
        arms: [arm(6.0, 14.0, 15.0, 34.0), arm(4.0, 16.0, 15.0, 32.0)],
        ..STANDING
    },
    Key { secs: 0.30, ..STANDING },
];

const fn kick(side: Side, size: f32) -> Move {
    Move { keys: KICK, side, size, ahead: 0.0 }
}

/// The take of the kicking database.
pub const KICKS: Drill = Drill {
    name: "kicks",
    action: "kick",
    rest: STANDING,
    moves: &[
        kick(Side::Right, 1.0),
        kick(Side::Left, 1.0),
        kick(Side::Right, 0.85),
        kick(Side::Right, 1.08),
        kick(Side::Left, 0.92),
        kick(Side::Left, 1.0),
        kick(Side::Right, 1.0),
        kick(Side::Left, 0.88),
    ],
    seed: 51,
};
