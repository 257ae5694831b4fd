//! Values of the arguments of `strut evaluate`.

use clap::ValueEnum;
use serde::Serialize;
use strut_core::evaluation::quality::Mode;
use strut_core::transfer::BodyPart;

/// Labels of the input that the engine is given.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Labels {
    Both,
    Action,
    Style,
    None,
}

/// Whether clips are styled as wholes or frame by frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum PassMode {
    Offline,
    Online,
}

impl PassMode {
    /// The core's value.
    pub(super) fn mode(self) -> Mode {
        match self {
            Self::Offline => Mode::Offline,
            Self::Online => Mode::Online,
        }
    }
}

/// How the databases are registered.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Registration {
    Dtw,
    Imw,
    Linear,
}

/// Part of the body that takes the target style.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Part {
    Whole,
    Head,
    Torso,
    Arms,
    Legs,
}

impl Part {
    /// The core's values; `None` is the whole body.
    pub(super) fn parts(self) -> Option<&'static [BodyPart]> {
        match self {
            Self::Whole => None,
            Self::Head => Some(&[BodyPart::Head]),
            Self::Torso => Some(&[BodyPart::Torso]),
            Self::Arms => Some(&[BodyPart::LeftArm, BodyPart::RightArm]),
            Self::Legs => Some(&[BodyPart::Legs]),
        }
    }
}
