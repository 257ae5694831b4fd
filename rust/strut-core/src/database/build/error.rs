//! Why a build gives no database.

use super::report::Refusal;
use crate::database::{DatabaseError, MAX_FRAMES};
use thiserror::Error;

/// Why nothing could be built.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum BuildError {
    /// No clip was given.
    #[error("no clips were given; at least one is needed")]
    NoClips,
    /// The rate is out of range.
    #[error("the database's rate is {0} Hz; 10 to 480 was expected")]
    Rate(f32),
    /// No clip has the neutral style asked for.
    #[error("no usable clip has the neutral style '{wanted}'; the styles are {styles}")]
    Neutral {
        /// Name asked for.
        wanted: String,
        /// Names there are.
        styles: String,
    },
    /// Every clip was refused.
    #[error("every clip was refused; '{name}' because {reason}")]
    NothingLeft {
        /// Name of the first clip.
        name: String,
        /// Why it was refused.
        reason: Refusal,
    },
    /// More labels than an index can tell apart.
    #[error("{0} styles or actions; at most 65535 are supported")]
    TooManyLabels(usize),
    /// More frames than a database may have.
    #[error("the clips have {0} frames; at most {MAX_FRAMES} are supported")]
    TooManyFrames(usize),
    /// A build is asked for its next step after it has failed, or for its database before its last step.
    #[error("the build has failed, or has steps left")]
    Unfinished,
    /// The progress function asked to stop.
    #[error("cancelled")]
    Cancelled,
    /// A clip holds values outside every reasonable range.
    #[error("the clips make no valid database: {0}")]
    Database(#[from] DatabaseError),
}
