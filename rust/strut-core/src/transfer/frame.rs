//! Output of the stylizer for a frame, and its stages.

use super::blend::StyleBlend;
use crate::catalogue::Catalogue;
use crate::humanoid::Pose;
use crate::search::Neighbour;

/// One styled frame.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct StyledFrame {
    /// The pose, on the database's proportions.
    pub pose: Pose,
    /// Time of the input frame since the reset, seconds.
    pub time_in_secs: f64,
    /// Time at which the output frame is due since the reset, seconds.
    pub time_out_secs: f64,
    /// Output time since the frame before, seconds; 0 for the first.
    pub dt_secs: f32,
    /// Likelihood that the left and the right foot of the input is planted.
    pub contact: [f32; 2],
    /// The same for the output: mean of the input's likelihood and the registered targets'. Either alone skates more:
    /// the input's where its phase differs from the output's (standing that becomes a stride), the targets' where the
    /// neighbours are far away.
    pub contact_out: [f32; 2],
    /// Whether the left and the right foot are held in place.
    pub planted: [bool; 2],
    /// Whether the input frame was unusable (NaN, a jump) and replaced.
    pub repaired: bool,
    /// Input frames replaced since the reset.
    pub repaired_total: u32,
}

/// Stages of a frame in order; a [`StageClock`] is called when each ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Input checked and turned into degrees of freedom and points.
    Features,
    /// Nearest windows of every class.
    Search,
    /// Class weights, regressions and their mixture.
    Regression,
    /// Durations.
    Timing,
    /// Styles blended, pose rebuilt.
    Blend,
    /// Contact likelihood.
    Contact,
    /// Footplant and inverse kinematics; offline it runs after the last frame and is not timed.
    Footplant,
}

impl Stage {
    /// All stages in order.
    pub const ALL: [Self; 7] =
        [Self::Features, Self::Search, Self::Regression, Self::Timing, Self::Blend, Self::Contact, Self::Footplant];

    /// Name in traces and benchmarks.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Features => "features",
            Self::Search => "search",
            Self::Regression => "regression",
            Self::Timing => "timing",
            Self::Blend => "blend",
            Self::Contact => "contact",
            Self::Footplant => "footplant",
        }
    }
}

/// Measures stages from outside: the core has no clock.
pub trait StageClock {
    /// A frame begins.
    fn start(&mut self) {}
    /// A stage has ended; the next begins.
    fn end(&mut self, stage: Stage) {
        let _ = stage;
    }
}

/// A clock that measures nothing.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoClock;

impl StageClock for NoClock {}

/// Data from which the last frame was computed: the contents of a line of `--trace`.
#[derive(Clone, Copy, Debug)]
pub struct Trace<'a> {
    pub(super) catalogue: &'a Catalogue,
    /// Weight of every class of the database; they sum to 1.
    pub class_weights: &'a [f32],
    pub(super) neighbours: &'a [Neighbour],
    /// Weight of each neighbour.
    pub(super) neighbour_weights: &'a [f32],
    pub(super) blend: &'a StyleBlend,
    /// Largest |Δx| of the heaviest class in standard deviations of its neighbours.
    pub bias: f32,
    /// The frame itself.
    pub frame: &'a StyledFrame,
}

/// A neighbour by clip and frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TracedNeighbour {
    /// Index of the clip.
    pub clip: usize,
    /// Frame within the clip.
    pub frame: usize,
    /// √D: root mean square distance of the weighted points, metres.
    pub distance: f32,
}

impl Trace<'_> {
    /// Neighbours of the heaviest class, nearest first.
    pub fn neighbours(&self) -> impl Iterator<Item = TracedNeighbour> + '_ {
        self.neighbours.iter().map(|n| {
            let row = n.row as usize;
            let clip = self.catalogue.clip_of_row(row);
            TracedNeighbour { clip, frame: row - self.catalogue.clips[clip].first_frame, distance: n.distance.sqrt() }
        })
    }
}
