//! Report of a build on actions, styles and each clip, for messages and for the command line's JSON.

use crate::database::TwoManners;
use crate::humanoid::TooManyFrames;
use crate::registration::{self, FaultyCycle};
use thiserror::Error;

/// Results of a build by action, clip and style.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BuildReport {
    /// One entry an action that entered the database, in the database's order.
    pub actions: Vec<ActionReport>,
    /// One entry a clip, refused ones included, sorted by action, style and take.
    pub clips: Vec<ClipReport>,
    /// Styles whose clips are performed in two manners in an action, in the database's order.
    pub two_manners: Vec<TwoManners>,
}

impl BuildReport {
    /// The clips that entered the database.
    pub fn accepted(&self) -> impl Iterator<Item = &ClipReport> {
        self.clips.iter().filter(|c| c.refused.is_none())
    }

    /// The clips that did not enter the database.
    pub fn refused(&self) -> impl Iterator<Item = &ClipReport> {
        self.clips.iter().filter(|c| c.refused.is_some())
    }
}

/// How an action was registered.
#[derive(Clone, Debug, PartialEq)]
pub struct ActionReport {
    /// Name of the action.
    pub action: String,
    /// How the clips' correspondence was found.
    pub method: registration::Method,
    /// Name of the clip that the action's canonical timeline comes from.
    pub reference_clip: String,
    /// Length of the canonical timeline, in frames at the database's rate.
    pub canonical_frames: f32,
}

/// Result for one clip.
#[derive(Clone, Debug, PartialEq)]
pub struct ClipReport {
    /// Name of the clip.
    pub name: String,
    /// Name of its action.
    pub action: String,
    /// Name of its style.
    pub style: String,
    /// Number of the take.
    pub take: u32,
    /// Frames at the database's rate; 0 if the clip could not be read that far.
    pub frames: usize,
    /// Whole gait cycles.
    pub cycles: usize,
    /// Mean duration of a whole gait cycle, seconds; `None` without cycles.
    pub mean_cycle_secs: Option<f32>,
    /// Change of heading from the start to the end, radians, positive to the left.
    pub turn: f32,
    /// Mean registration cost of the counterparts (squared feature distance a frame, over all styles); high
    /// for a clip that resembles no other. `None` where correspondence was known or the clip was refused.
    pub registration_cost: Option<f32>,
    /// Stretches of the clip that are no proper gait cycle. They stay in the database, registered on their own.
    pub faulty_cycles: Vec<FaultyCycle>,
    /// Why the clip did not enter the database; `None` if it did.
    pub refused: Option<Refusal>,
}

/// Why a clip did not enter the database.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum Refusal {
    /// A NaN or an infinity; the frame at the clip's own rate.
    #[error("frame {0} holds a value that is not a finite number")]
    NotFinite(usize),
    /// The rate is no positive number of frames per second.
    #[error("its rate is {0} Hz; a positive number was expected")]
    Rate(f32),
    /// Too many frames at the database's rate.
    #[error(transparent)]
    TooLong(#[from] TooManyFrames),
    /// Too few frames at the database's rate.
    #[error("it has only {0} frames; at least {min} are needed", min = super::source::MIN_CLIP_FRAMES)]
    TooShort(usize),
    /// Other bone lengths than most clips: clips must be retargeted to common proportions first.
    #[error("its bone lengths differ from those of most clips")]
    Proportions,
    /// The script has not one finite, strictly increasing time per frame; the first offending frame.
    #[error("its script has no finite time that increases at frame {0}")]
    Script(usize),
    /// It does not fit the other clips of its action.
    #[error(transparent)]
    Registration(#[from] registration::Refusal),
}
