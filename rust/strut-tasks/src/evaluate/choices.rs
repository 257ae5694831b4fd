//! Values of the arguments of `strut evaluate`.

use serde::{Deserialize, Serialize};
use strut_core::registration::WarpMethod;
use strut_core::transfer::BodyPart;
use strut_evaluation::quality::Mode;

/// Labels of the input that the engine is given.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[serde(rename_all = "lowercase")]
pub enum Labels {
    /// Its action and its style.
    Both,
    /// Its action.
    Action,
    /// Its style.
    Style,
    /// None.
    None,
}

/// Whether clips are styled as wholes or frame by frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[serde(rename_all = "lowercase")]
pub enum PassMode {
    /// As wholes.
    Offline,
    /// Frame by frame.
    Online,
}

impl PassMode {
    /// Returns the core's value.
    pub(super) fn mode(self) -> Mode {
        match self {
            Self::Offline => Mode::Offline,
            Self::Online => Mode::Online,
        }
    }
}

/// How the databases are registered.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[serde(rename_all = "lowercase")]
pub enum Registration {
    /// Dynamic time warping.
    Dtw,
    /// Iterative motion warping.
    Imw,
    /// Linear time between foot strikes: the baseline.
    Linear,
}

impl Registration {
    /// Returns the core's value.
    pub fn warp(self) -> WarpMethod {
        match self {
            Self::Dtw => WarpMethod::Dtw,
            Self::Imw => WarpMethod::Imw,
            Self::Linear => WarpMethod::Linear,
        }
    }
}

/// Part of the body that takes the target style.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[serde(rename_all = "lowercase")]
pub enum Part {
    /// All of it.
    Whole,
    /// Head and neck.
    Head,
    /// Hips and spine.
    Torso,
    /// Both arms.
    Arms,
    /// Both legs.
    Legs,
}

impl Part {
    /// Returns the core's values; `None` is the whole body.
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
