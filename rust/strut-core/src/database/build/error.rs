//! Errors of a build.

use super::report::Refusal;
use crate::database::{DatabaseError, MAX_FRAMES};
use thiserror::Error;

/// Reason why a build failed.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum BuildError {
    /// No clip was given.
    #[error("no clips were given; at least one is needed")]
    NoClips,
    /// The rate is out of range.
    #[error("the database's rate is {0} Hz; 10 to 480 was expected")]
    Rate(f32),
    /// No clip has the requested neutral style.
    #[error("no usable clip has the neutral style '{wanted}'; the styles are {styles}")]
    Neutral {
        /// Requested name.
        wanted: String,
        /// Available names.
        styles: String,
    },
    /// Every clip was rejected.
    #[error("every clip was refused; '{name}' because {reason}")]
    NothingLeft {
        /// Name of the first clip.
        name: String,
        /// Reason of its rejection.
        reason: Refusal,
    },
    /// More labels than an index can represent.
    #[error("{0} styles or actions; at most 65535 are supported")]
    TooManyLabels(usize),
    /// More frames than a database may have.
    #[error("the clips have {0} frames; at most {MAX_FRAMES} are supported")]
    TooManyFrames(usize),
    /// The next step of a failed build, or the database of an unfinished one, was requested.
    #[error("the build failed earlier or is not finished")]
    Unfinished,
    /// The progress function cancelled the build.
    #[error("cancelled")]
    Cancelled,
    /// A clip contains values out of range.
    #[error("these clips do not make a valid database: {0}")]
    Database(#[from] DatabaseError),
}
