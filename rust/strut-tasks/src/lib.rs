//! Tasks of `strut` with files and threads, without arguments and printing. The command and the Python package call
//! them.
//!
//! Errors are [`TaskError`]s. Progress is reported to a callback that may cancel. Results never depend on the threads.
#![forbid(unsafe_code)]

pub mod batch;
pub mod clip;
pub mod corpus;
pub mod digest;
pub mod error;
pub mod evaluate;
pub mod files;
pub mod gather;
pub mod key_styles;
pub mod note_report;
pub mod progress;
pub mod recordings;
pub mod search;
pub mod stylize;
pub mod suggestion;
pub mod threads;
pub mod walk;
pub mod walks;
pub mod weights;

pub use error::{Code, Outcome, TaskError};
pub use progress::{OnProgress, Progress};
pub use strut_formats::counted;
