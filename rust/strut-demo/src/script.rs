//! What a take performs, the same in every style: so many strides at a speed, turning so much.

use crate::action::Action;
use crate::drills::{INPUT_JUMP, INPUT_KICKS, INPUT_PUNCHES};
use crate::interlude::Interlude;
use crate::perform::{Excursion, Transition};
use crate::periodic::smooth_step;
use strut_core::math::float_funcs::wrap_angle;

/// A stretch of a script.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Passage {
    /// Length in strides (two steps each).
    pub strides: u32,
    /// Speed as a multiple of the style's preferred one.
    pub speed: f32,
    /// Degrees turned to the left over the passage; negative is to the right.
    pub turn_degrees: f32,
}

/// A take: its name, what is performed, and the seed of its irregularities.
///
/// Time within a script is counted in strides (the *phase*): whole numbers are heel strikes of the left
/// foot, halves of the right. It is what makes frames of two styles counterparts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Script {
    /// Name, part of the clips' names.
    pub name: &'static str,
    /// What is performed.
    pub action: Action,
    /// Stretches in order; the last one leads back into the first. At least one.
    pub passages: &'static [Passage],
    /// Seed of all irregularities.
    pub seed: u64,
}

/// Strides before and after a change of passage over which speed and turning change.
const EASE_STRIDES: f32 = 0.75;

impl Script {
    /// Length in strides.
    pub fn strides(&self) -> u32 {
        self.passages.iter().map(|p| p.strides).sum()
    }

    /// Speed at a phase as a multiple of the style's preferred one; repeats with the script.
    pub(crate) fn speed(&self, phase: f32) -> f32 {
        self.eased(phase, |p| p.speed)
    }

    /// Turning at a phase, radians to the left a stride; repeats with the script.
    pub(crate) fn turn_rate(&self, phase: f32) -> f32 {
        self.eased(phase, |p| p.turn_degrees.to_radians() / p.strides as f32)
    }

    /// Heading reached at the end, relative to the beginning, radians.
    pub fn net_turn(&self) -> f32 {
        wrap_angle(self.passages.iter().map(|p| p.turn_degrees.to_radians()).sum())
    }

    fn eased(&self, phase: f32, value: impl Fn(&Passage) -> f32) -> f32 {
        let n = self.passages.len();
        let length = self.strides() as f32;
        let phase = phase - (phase / length).floor() * length;
        let mut begin = 0.0;
        for (i, p) in self.passages.iter().enumerate() {
            let end = begin + p.strides as f32;
            if phase < end || i + 1 == n {
                let from = value(&self.passages[(i + n - 1) % n]);
                let to = value(&self.passages[(i + 1) % n]);
                let here = value(p);
                let entered = smooth_step(begin - EASE_STRIDES, begin + EASE_STRIDES, phase);
                let left = smooth_step(end - EASE_STRIDES, end + EASE_STRIDES, phase);
                return from + (here - from) * entered + (to - here) * left;
            }
            begin = end;
        }
        1.0
    }
}

pub(crate) const fn passage(strides: u32, speed: f32, turn_degrees: f32) -> Passage {
    Passage { strides, speed, turn_degrees }
}

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

/// The take that makes the walking database of full size long enough: step sizes, speeds and turns of every sharpness.
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

/// What the page offers as input: not the takes of the database.
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

/// An input that changes its gait and comes back, so that it can be repeated.
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

/// Inputs that halt for jumps, punches and kicks.
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

/// Speed, as a multiple of the preferred one, at which somebody comes to a halt.
const HALTING: f32 = 0.45;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turning_adds_up_to_what_the_passages_say() {
        let s = &WALK_TAKES[1];
        let n = 200 * s.strides();
        let total: f32 = (0..n).map(|i| s.turn_rate((i as f32 + 0.5) / 200.0) / 200.0).sum();
        assert!((wrap_angle(total) - s.net_turn()).abs() < 1e-3, "{total} {}", s.net_turn());
    }

    #[test]
    fn speed_changes_without_a_step_also_where_the_script_repeats() {
        for s in WALK_TAKES.iter().chain(&RUN_TAKES).chain(&INPUT_TAKES) {
            let n = 100 * s.strides();
            for i in 0..=n {
                let x = i as f32 / 100.0;
                assert!((s.speed(x + 0.01) - s.speed(x)).abs() < 0.01);
            }
        }
    }
}
