//! Errors of a lens.

use crate::transfer::blend::StyleError;
use crate::transfer::options::OptionsError;
use thiserror::Error;

/// Reason why a lens cannot show something.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum LensError {
    /// The input has too few frames.
    #[error("the input has {frames} frames; {least} are needed at least")]
    TooShort {
        /// Number of frames given.
        frames: usize,
        /// Least number of frames.
        least: usize,
    },
    /// The class, joint, degree of freedom or row does not exist.
    #[error("there is no {what} {index}; they are 0 to {last}")]
    NotThere {
        /// Kind of object.
        what: &'static str,
        /// Requested index.
        index: usize,
        /// Last valid index.
        last: usize,
    },
    /// A style without weight is not predicted.
    #[error("the style '{name}' has no weight")]
    NotActive {
        /// Name of the style.
        name: String,
    },
    /// The options are invalid.
    #[error(transparent)]
    Options(#[from] OptionsError),
    /// The style weights are invalid.
    #[error(transparent)]
    Style(#[from] StyleError),
    /// A number is not finite or outside its range.
    #[error("{what} is {value}; expected {expected}")]
    OutOfRange {
        /// Name of the number.
        what: &'static str,
        /// Its value.
        value: f32,
        /// Its valid range.
        expected: &'static str,
    },
}

/// Returns the index if it is below the count.
pub(super) fn among(what: &'static str, index: usize, count: usize) -> Result<usize, LensError> {
    if index < count { Ok(index) } else { Err(LensError::NotThere { what, index, last: count.saturating_sub(1) }) }
}
