//! What a style is made of: numbers that are measured on a pose and mean something (specification, §2).

use super::expression::{ExpressionError, Node, parse, parse_list};
use crate::humanoid::{JOINTS, Pose, Proportions, Role};
use crate::kinematics::world_from_local;
use crate::math::Vec3;
use std::fmt::{self, Display};

/// What there is to measure in a pose that faces +Z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// Positions of the joints with the hips above the origin, metres: x to the left, y up, z forward.
    pub positions: [Vec3; JOINTS],
    /// How fast the body goes on the floor, m/s; NaN where a pose is all there is.
    pub speed: f32,
}

impl Frame {
    /// Of a pose; its place on the floor does not matter.
    pub fn new(proportions: &Proportions, pose: &Pose, speed: f32) -> Self {
        let above_origin = Pose { root: pose.root * Vec3::Y, ..*pose };
        Self { positions: world_from_local(proportions, &above_origin).positions, speed }
    }

    fn at(&self, role: Role) -> Vec3 {
        self.positions[role.index()]
    }
}

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
    /// Empty for numbers without a unit, and for units that have no usual sign.
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
    /// The name that commands and files know it by.
    pub name: &'static str,
    /// Its unit.
    pub unit: Unit,
    /// What it is, for people.
    pub meaning: &'static str,
    /// Its value.
    pub(super) of: fn(&Frame) -> f64,
}

fn cm(metres: f32) -> f64 {
    100.0 * f64::from(metres)
}

/// How far a hand is before its shoulder joint.
fn reach(frame: &Frame, hand: Role, arm: Role) -> f64 {
    cm((frame.at(hand) - frame.at(arm)).z)
}

/// How much a knee or an elbow is bent from straight, degrees.
fn bend(frame: &Frame, upper: Role, middle: Role, end: Role) -> f64 {
    let (a, b) = (frame.at(middle) - frame.at(upper), frame.at(end) - frame.at(middle));
    libm::atan2(f64::from(a.cross(b).length()), f64::from(a.dot(b))).to_degrees()
}

impl Measure {
    /// The measures with a name.
    pub const NAMED: &[NamedMeasure] = &[
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
                libm::atan2(torso.z.into(), torso.y.into()).to_degrees()
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

    /// The measure that a name or an expression says: `hips_height`, `hand_l.y - shoulder_l.y`. Joints go by their role
    /// (`left_hand` or `hand_l`), `x y z` are centimetres to the left, up and forward of the floor below the hips; there are
    /// `+ - * / ( )`, `abs min max sqrt`, `atan2` in degrees, numbers, and the names of [`Measure::NAMED`].
    ///
    /// # Errors
    /// See [`ExpressionError`], which says at which character.
    pub fn parse(text: &str) -> Result<Self, ExpressionError> {
        parse(text).map(|node| Self { text: text.trim().to_owned(), unit: node.unit(), node })
    }

    /// Several, with commas between them.
    ///
    /// # Errors
    /// See [`ExpressionError`]; columns count from the beginning of the whole text.
    pub fn parse_list(text: &str) -> Result<Vec<Self>, ExpressionError> {
        let measure = |(text, node): (&str, Node)| Self { text: text.trim().to_owned(), unit: node.unit(), node };
        Ok(parse_list(text)?.into_iter().map(measure).collect())
    }

    /// As it was written.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Its unit.
    pub fn unit(&self) -> Unit {
        self.unit
    }

    /// Its value in [`Measure::unit`]; not finite where the expression has none, such as after a division by zero.
    pub fn measure(&self, frame: &Frame) -> f64 {
        self.node.value(frame)
    }
}

/// A number that is measured on a pose.
#[derive(Clone, Debug, PartialEq)]
pub struct Measure {
    text: String,
    unit: Unit,
    node: Node,
}

impl Display for Measure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}
