//! Results of registration.

use super::options::MAX_COUNTERPARTS;
use std::ops::Range;
use thiserror::Error;

/// A frame of another example, possibly fractional.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Counterpart {
    /// Index of the example.
    pub example: u32,
    /// Fractional frame of the example.
    pub frame: f32,
}

/// A frame's counterparts in one style; `None`s come last.
pub type Counterparts = [Option<Counterpart>; MAX_COUNTERPARTS];

/// Result for one example.
#[derive(Clone, Debug, PartialEq)]
pub struct Registered {
    /// Time on the action's canonical timeline of every frame, in canonical frames.
    pub canonical_time: Vec<f32>,
    /// Seconds of the clip per canonical frame, at every frame; positive.
    pub time_step: Vec<f32>,
    /// Counterparts: frames × styles.
    pub counterparts: Vec<Counterparts>,
    /// Whole gait cycles.
    pub cycles: Vec<Range<usize>>,
    /// Ranges between heel strikes that are not a gait cycle.
    pub faulty_cycles: Vec<FaultyCycle>,
    /// Mean cost of the counterparts' warps (squared feature distance per frame); `None` for known correspondence.
    pub cost: Option<f32>,
}

/// A range between two left heel strikes that is not a gait cycle.
#[derive(Clone, Debug, PartialEq)]
pub struct FaultyCycle {
    /// Its frames.
    pub frames: Range<usize>,
    /// Its fault.
    pub fault: CycleFault,
}

/// Reason why a range between two left heel strikes is not a gait cycle.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum CycleFault {
    /// The number of right heel strikes is not one.
    #[error("{0} right heel strikes; 1 was expected")]
    RightStrikes(usize),
    /// The duration is far from the usual one.
    #[error("it lasts {found_secs:.2} s; about {usual_secs:.2} s is usual")]
    Duration {
        /// Its duration, seconds.
        found_secs: f32,
        /// Median over the clip's cycles, or over the style's if the clip has few; seconds.
        usual_secs: f32,
    },
}

/// Reason why an example does not fit the others of its action.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum Refusal {
    /// The action walks or runs, and this clip has no left heel strike at which it can be divided.
    #[error("no left heel strike was found in it, but its action is a walk or a run")]
    NoHeelStrikes,
    /// A clip for a new style of a walk or a run has no whole gait cycle.
    #[error("it has no three steps in a row (left, right, left); a walk of at least three seconds was expected")]
    NoGait,
    /// A walk or a run cannot be a new style of an action that is neither.
    #[error("it contains walking or running, unlike the other clips of the action")]
    Gait,
    /// The clip turns against the action's usual direction; radians, positive to the left.
    #[error("it turns against the action's usual direction: {:.0}° instead of {:.0}°", turn.to_degrees(), usual.to_degrees())]
    TurnsTheOtherWay {
        /// Turn of the clip.
        turn: f32,
        /// Median turn of the action's clips.
        usual: f32,
    },
    /// No time warp within the slope limit maps the clip to the action's reference.
    #[error("it cannot be time-warped to the action's reference clip: it is more than three times longer or shorter")]
    NoWarp,
}

/// Method that found an action's correspondence.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// By gait cycles.
    Cycles,
    /// By whole clips.
    WholeClips,
    /// From scripts.
    Scripts,
}

impl Method {
    /// Name in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Cycles => "cycles",
            Self::WholeClips => "whole clips",
            Self::Scripts => "scripts",
        }
    }
}

/// Results for the examples of an action.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// Method that found the correspondence.
    pub method: Method,
    /// Example that defines the canonical timeline; `None` if all were rejected.
    pub reference: Option<usize>,
    /// Length of the canonical timeline in frames.
    pub canonical_frames: f32,
    /// One entry for each example.
    pub clips: Vec<Result<Registered, Refusal>>,
}
