//! Errors of the command.

use std::fmt::{self, Display};
use std::path::Path;
use strut_tasks::{Code, TaskError};

/// A message of one sentence on one line, and the exit code.
#[derive(Debug)]
pub(crate) struct Failure {
    sentence: String,
    pub(crate) exit_code: u8,
}

/// Exit code that shells expect after Ctrl-C.
pub(crate) const INTERRUPTED: u8 = 130;

/// Result of a step.
pub(crate) type Outcome<T = ()> = Result<T, Failure>;

impl Failure {
    /// Creates a failure that concerns no particular file.
    pub(crate) fn new(reason: impl Display) -> Self {
        let sentence = reason.to_string();
        // Names from files may contain control characters; a message is one line.
        let one_line = sentence.chars().map(|c| if c.is_control() { ' ' } else { c });
        Self { sentence: one_line.collect(), exit_code: 1 }
    }

    /// Creates a failure about a file.
    pub(crate) fn in_file(path: &Path, reason: impl Display) -> Self {
        Self::new(format_args!("{}: {reason}", path.display()))
    }

    /// Creates a failure about an invalid argument.
    pub(crate) fn usage(reason: impl Display) -> Self {
        Self { exit_code: 2, ..Self::new(reason) }
    }
}

impl From<TaskError> for Failure {
    fn from(error: TaskError) -> Self {
        let exit_code = match error.code {
            Code::Usage => 2,
            Code::Cancelled => INTERRUPTED,
            _ => 1,
        };
        Self { exit_code, ..Self::new(error) }
    }
}

impl Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.sentence)
    }
}
