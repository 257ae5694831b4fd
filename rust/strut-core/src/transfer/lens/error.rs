//! Errors of a lens.

use crate::transfer::blend::StyleError;
use crate::transfer::options::OptionsError;
use thiserror::Error;

/// Why a lens cannot show something.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum LensError {
    /// The input has too few frames.
    #[error("the input has {frames} frames; {least} are needed at least")]
    TooShort {
        /// How many.
        frames: usize,
        /// How many there must be.
        least: usize,
    },
    /// There is no such class, joint, degree of freedom or row.
    #[error("there is no {what} {index}; they are 0 to {last}")]
    NotThere {
        /// Of which kind.
        what: &'static str,
        /// What was asked for.
        index: usize,
        /// The last that there is.
        last: usize,
    },
    /// A style without weight is not predicted.
    #[error("the style '{name}' has no weight")]
    NotActive {
        /// Its name.
        name: String,
    },
    /// The options do not fit.
    #[error(transparent)]
    Options(#[from] OptionsError),
    /// The style weights do not fit.
    #[error(transparent)]
    Style(#[from] StyleError),
    /// A number is not finite or outside its range.
    #[error("{what} is {value}; expected {expected}")]
    OutOfRange {
        /// Which number.
        what: &'static str,
        /// What it is.
        value: f32,
        /// What it may be.
        expected: &'static str,
    },
}

/// An index below a count.
pub(super) fn among(what: &'static str, index: usize, count: usize) -> Result<usize, LensError> {
    if index < count { Ok(index) } else { Err(LensError::NotThere { what, index, last: count.saturating_sub(1) }) }
}
