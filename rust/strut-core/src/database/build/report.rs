//! Report on a build's actions, styles and clips, for messages and for the command line's JSON output.

use crate::database::BimodalStyle;
use crate::humanoid::TooManyFrames;
use crate::registration::{self, FaultyCycle};
use thiserror::Error;

/// Results of a build by action, clip and style.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BuildReport {
    /// One entry for each action of the database, in the database's order.
    pub actions: Vec<ActionReport>,
    /// One entry for each clip, rejected ones included, sorted by action, style and take.
    pub clips: Vec<ClipReport>,
    /// Bimodal styles, in the database's order.
    pub bimodal_styles: Vec<BimodalStyle>,
}

impl BuildReport {
    /// Clips of the database.
    pub fn accepted(&self) -> impl Iterator<Item = &ClipReport> {
        self.clips.iter().filter(|c| c.refused.is_none())
    }

    /// Rejected clips.
    pub fn refused(&self) -> impl Iterator<Item = &ClipReport> {
        self.clips.iter().filter(|c| c.refused.is_some())
    }
}

/// Registration of an action.
#[derive(Clone, Debug, PartialEq)]
pub struct ActionReport {
    /// Name of the action.
    pub action: String,
    /// Method that computed the clips' correspondence.
    pub method: registration::Method,
    /// Name of the clip that defines the action's canonical timeline.
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
    /// Number of frames at the database's rate; 0 if the clip was rejected before they were counted.
    pub frames: usize,
    /// Number of whole gait cycles.
    pub cycles: usize,
    /// Mean duration of a whole gait cycle, seconds; `None` without cycles.
    pub mean_cycle_secs: Option<f32>,
    /// Change of heading from the start to the end, radians, positive to the left.
    pub turn: f32,
    /// Mean registration cost of the counterparts (squared feature distance per frame, over all styles). It is high for
    /// a clip that is unlike all others. `None` if the correspondence was known or the clip was rejected.
    pub registration_cost: Option<f32>,
    /// Ranges of the clip that are not a regular gait cycle. They stay in the database and are registered separately.
    pub faulty_cycles: Vec<FaultyCycle>,
    /// Reason why the clip was rejected; `None` if it is in the database.
    pub refused: Option<Refusal>,
}

/// Reason why a clip was rejected.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum Refusal {
    /// A value is NaN or infinite. Contains the frame at the clip's own rate.
    #[error("frame {0} holds a value that is not a finite number")]
    NotFinite(usize),
    /// The frame rate is not finite or not positive.
    #[error("its rate is {0} Hz; a positive number was expected")]
    Rate(f32),
    /// The clip has too many frames at the database's rate.
    #[error(transparent)]
    TooLong(#[from] TooManyFrames),
    /// The clip has too few frames at the database's rate.
    #[error("it has only {0} frames; at least {min} are needed", min = super::source::MIN_CLIP_FRAMES)]
    TooShort(usize),
    /// The bone lengths differ from those of most clips: clips must be retargeted to common proportions first.
    #[error("its bone lengths differ from those of most clips")]
    Proportions,
    /// The script does not have one finite, strictly increasing time per frame. Contains the first invalid frame.
    #[error("the scripted time of frame {0} is not finite, or not later than that of the frame before")]
    Script(usize),
    /// The clip does not fit the other clips of its action.
    #[error(transparent)]
    Registration(#[from] registration::Refusal),
}
