//! Named measures, with their units.

use super::frame::Frame;
use crate::humanoid::Role;
use crate::math::float_funcs::double;
use std::fmt::{self, Display};

/// The unit of a measure: powers of centimetres, degrees and seconds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Unit {
    /// Power of centimetres.
    pub cm: i8,
    /// Power of degrees.
    pub deg: i8,
    /// Power of seconds.
    pub secs: i8,
}

impl Unit {
    /// Centimetres.
    pub const CM: Self = Self { cm: 1, deg: 0, secs: 0 };
    /// Degrees.
    pub const DEG: Self = Self { cm: 0, deg: 1, secs: 0 };
    /// Centimetres per second.
    pub const CM_PER_SEC: Self = Self { cm: 1, deg: 0, secs: -1 };
}

impl Display for Unit {
    /// Writes nothing for numbers without a unit, and for units that have no usual symbol.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match (self.cm, self.deg, self.secs) {
            (1, 0, 0) => "cm",
            (2, 0, 0) => "cm²",
            (0, 1, 0) => "°",
            (1, 0, -1) => "cm/s",
            _ => "",
        })
    }
}

/// A measure with a name.
#[derive(Clone, Copy, Debug)]
pub struct NamedMeasure {
    /// Its name in commands and files.
    pub name: &'static str,
    /// Its unit.
    pub unit: Unit,
    /// Description for users.
    pub meaning: &'static str,
    /// Its value.
    pub(super) of: fn(&Frame) -> f64,
}

fn cm(metres: f32) -> f64 {
    100.0 * f64::from(metres)
}

/// Distance of a hand in front of its shoulder joint.
fn reach(frame: &Frame, hand: Role, arm: Role) -> f64 {
    cm((frame.at(hand) - frame.at(arm)).z)
}

/// Bend of a knee or an elbow from straight, degrees.
fn bend(frame: &Frame, upper: Role, middle: Role, end: Role) -> f64 {
    let (a, b) = (frame.at(middle) - frame.at(upper), frame.at(end) - frame.at(middle));
    double::atan2(f64::from(a.cross(b).length()), f64::from(a.dot(b))).to_degrees()
}

/// The named measures.
pub(super) const NAMED: &[NamedMeasure] = &[
    NamedMeasure {
        name: "hips_height",
        unit: Unit::CM,
        meaning: "height of the hips above the floor",
        of: |f| cm(f.at(Role::Hips).y),
    },
    NamedMeasure {
        name: "reach_left",
        unit: Unit::CM,
        meaning: "how far the left hand is before its shoulder",
        of: |f| reach(f, Role::LeftHand, Role::LeftUpperArm),
    },
    NamedMeasure {
        name: "reach_right",
        unit: Unit::CM,
        meaning: "how far the right hand is before its shoulder",
        of: |f| reach(f, Role::RightHand, Role::RightUpperArm),
    },
    NamedMeasure {
        name: "hand_height_left",
        unit: Unit::CM,
        meaning: "height of the left hand above the floor",
        of: |f| cm(f.at(Role::LeftHand).y),
    },
    NamedMeasure {
        name: "hand_height_right",
        unit: Unit::CM,
        meaning: "height of the right hand above the floor",
        of: |f| cm(f.at(Role::RightHand).y),
    },
    NamedMeasure {
        name: "foot_separation",
        unit: Unit::CM,
        meaning: "how far the left foot is before the right one",
        of: |f| cm((f.at(Role::LeftFoot) - f.at(Role::RightFoot)).z),
    },
    NamedMeasure {
        name: "foot_height_difference",
        unit: Unit::CM,
        meaning: "how much higher the left foot is than the right one",
        of: |f| cm((f.at(Role::LeftFoot) - f.at(Role::RightFoot)).y),
    },
    NamedMeasure {
        name: "torso_lean",
        unit: Unit::DEG,
        meaning: "how far the torso leans forward",
        of: |f| {
            let torso = f.at(Role::Neck) - f.at(Role::Hips);
            double::atan2(torso.z.into(), torso.y.into()).to_degrees()
        },
    },
    NamedMeasure {
        name: "hands_apart",
        unit: Unit::CM,
        meaning: "distance between the hands",
        of: |f| cm((f.at(Role::LeftHand) - f.at(Role::RightHand)).length()),
    },
    NamedMeasure {
        name: "knee_bend_left",
        unit: Unit::DEG,
        meaning: "how much the left knee is bent",
        of: |f| bend(f, Role::LeftUpperLeg, Role::LeftLowerLeg, Role::LeftFoot),
    },
    NamedMeasure {
        name: "knee_bend_right",
        unit: Unit::DEG,
        meaning: "how much the right knee is bent",
        of: |f| bend(f, Role::RightUpperLeg, Role::RightLowerLeg, Role::RightFoot),
    },
    NamedMeasure {
        name: "speed",
        unit: Unit::CM_PER_SEC,
        meaning: "how fast the body goes; a pose alone does not show it",
        of: |f| cm(f.speed),
    },
];
