//! Takes of the built-in databases and inputs.

use crate::action::Action;
use crate::drills::{INPUT_JUMP, INPUT_KICKS, INPUT_PUNCHES};
use crate::interlude::Interlude;
use crate::perform::{Excursion, Transition};
use crate::script::{Script, passage};

/// The takes of the walking database.
pub const WALK_TAKES: [Script; 2] = [
    Script {
        name: "pace",
        action: Action::Walk,
        passages: &[passage(4, 1.0, 0.0), passage(3, 1.3, 0.0), passage(2, 0.95, 0.0), passage(3, 0.7, 0.0)],
        seed: 11,
    },
    Script {
        name: "turns",
        action: Action::Walk,
        passages: &[
            passage(2, 1.0, 0.0),
            passage(2, 0.9, 70.0),
            passage(2, 1.0, 0.0),
            passage(2, 0.9, -70.0),
            passage(4, 1.0, 120.0),
            passage(4, 1.05, -120.0),
        ],
        seed: 12,
    },
];

/// Take that gives the full-size walking database its length: step sizes, speeds, and turns of every sharpness.
pub(crate) const LONG_WALK: [Script; 1] = [Script {
    name: "stroll",
    action: Action::Walk,
    passages: &[
        passage(3, 1.0, 0.0),
        passage(3, 1.15, 35.0),
        passage(2, 0.8, 90.0),
        passage(3, 1.0, 0.0),
        passage(3, 0.6, 0.0),
        passage(3, 1.2, -45.0),
        passage(2, 0.85, -110.0),
        passage(4, 1.05, 10.0),
    ],
    seed: 13,
}];

/// The take of the running database.
pub const RUN_TAKES: [Script; 1] = [Script {
    name: "loop",
    action: Action::Run,
    passages: &[
        passage(2, 1.0, 0.0),
        passage(2, 1.2, 0.0),
        passage(3, 0.95, 80.0),
        passage(2, 0.85, 0.0),
        passage(3, 0.95, -80.0),
    ],
    seed: 21,
}];

/// The takes of the transition database.
pub const TRANSITIONS: [Transition; 2] = [
    Transition {
        script: Script { name: "walk to run", action: Action::Walk, passages: &[passage(2, 1.0, 0.0)], seed: 61 },
        to: Action::Run,
        over: [-0.1, 1.4],
    },
    Transition {
        script: Script { name: "run to walk", action: Action::Run, passages: &[passage(2, 1.0, 0.0)], seed: 62 },
        to: Action::Walk,
        over: [-0.1, 1.4],
    },
];

/// Inputs of the page, which are not takes of the database.
pub const INPUT_TAKES: [Script; 4] = [
    Script {
        name: "neutral walk",
        action: Action::Walk,
        passages: &[passage(6, 1.0, 0.0), passage(4, 1.08, 8.0), passage(4, 0.94, -8.0)],
        seed: 101,
    },
    Script {
        name: "neutral walk with turns",
        action: Action::Walk,
        passages: &[
            passage(3, 1.0, 0.0),
            passage(3, 0.9, 95.0),
            passage(3, 1.15, 0.0),
            passage(5, 1.0, 175.0),
            passage(2, 0.8, 0.0),
            passage(3, 0.95, 90.0),
        ],
        seed: 102,
    },
    Script {
        name: "neutral walk in a circle",
        action: Action::Walk,
        passages: &[passage(2, 1.0, 0.0), passage(10, 0.96, 360.0), passage(2, 1.0, 0.0)],
        seed: 104,
    },
    Script {
        name: "neutral run",
        action: Action::Run,
        passages: &[passage(6, 1.0, 0.0), passage(3, 1.0, 60.0), passage(4, 1.1, 0.0), passage(3, 1.0, 60.0)],
        seed: 103,
    },
];

/// An input that changes its gait and returns, so that it can be looped.
pub(crate) const INPUT_EXCURSION: Excursion = Excursion {
    script: Script {
        name: "neutral walk, run and walk",
        action: Action::Walk,
        passages: &[passage(14, 1.0, 0.0)],
        seed: 105,
    },
    to: Action::Run,
    over: [3.0, 4.5],
    back: [9.0, 10.5],
};

/// Inputs that halt or slow down for jumps, punches and kicks.
pub const INTERLUDES: [Interlude; 2] = [
    Interlude {
        gait: Excursion {
            script: Script {
                name: "neutral run, walk, jump and walk",
                action: Action::Run,
                passages: &[passage(6, 1.0, 0.0), passage(2, HALTING, 0.0), passage(5, 1.0, 0.0)],
                seed: 106,
            },
            to: Action::Walk,
            over: [2.5, 4.0],
            back: [11.0, 12.5],
        },
        halt: 7,
        drills: &[INPUT_JUMP],
    },
    Interlude {
        gait: Excursion {
            script: Script {
                name: "neutral walk, punch, kick, jump and walk",
                action: Action::Walk,
                passages: &[passage(4, 1.0, 0.0), passage(2, HALTING, 0.0), passage(4, 1.0, 0.0)],
                seed: 107,
            },
            to: Action::Walk,
            over: [2.5, 4.0],
            back: [7.0, 8.5],
        },
        halt: 5,
        drills: &[INPUT_PUNCHES, INPUT_KICKS, INPUT_JUMP],
    },
];

/// Speed before a halt, as a multiple of the preferred one.
const HALTING: f32 = 0.45;
