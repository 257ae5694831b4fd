//! Errors of tasks: a message and a code.

use std::fmt::{self, Display};
use std::io::{self, ErrorKind};
use std::path::Path;

/// Kind of an error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Code {
    /// A file's content is not what was expected.
    BadFile,
    /// The request does not match the files, for example a style that the database lacks.
    BadInput,
    /// An argument is invalid regardless of the files.
    Usage,
    /// The system could not read or write.
    Io(ErrorKind),
    /// The caller asked to stop.
    Cancelled,
    /// A bug in the program.
    Fault,
}

impl Code {
    /// Returns the name in manifests and in Python.
    pub fn name(self) -> &'static str {
        match self {
            Self::BadFile => "bad-file",
            Self::BadInput | Self::Usage => "bad-input",
            Self::Io(_) => "io",
            Self::Cancelled => "cancelled",
            Self::Fault => "fault",
        }
    }
}

/// Why a task ended early.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TaskError {
    /// Code of the error.
    pub code: Code,
    /// One sentence on one line that names the file, without a full stop.
    pub message: String,
    /// How to solve the problem.
    pub hint: Option<String>,
}

/// Result of a step of a task.
pub type Outcome<T = ()> = Result<T, TaskError>;

impl TaskError {
    /// Creates an error with this code.
    pub fn of(code: Code, reason: impl Display) -> Self {
        // Names from files may contain control characters; a message is one line.
        let one_line = |text: String| text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
        Self { code, message: one_line(reason.to_string()), hint: None }
    }

    /// Creates an error that concerns no particular file.
    pub fn new(reason: impl Display) -> Self {
        Self::of(Code::BadInput, reason)
    }

    /// Creates an error about a file.
    pub fn in_file(path: &Path, reason: impl Display) -> Self {
        Self::of(Code::BadFile, format_args!("{}: {reason}", path.display()))
    }

    /// Creates an error from an I/O error of a file.
    pub fn io(path: &Path, error: &io::Error) -> Self {
        Self::of(Code::Io(error.kind()), format_args!("{}: {}", path.display(), reason(error)))
    }

    /// Creates an error about an invalid argument.
    pub fn usage(reason: impl Display) -> Self {
        Self::of(Code::Usage, reason)
    }

    /// Creates the error of a cancelled task.
    pub fn cancelled() -> Self {
        Self::of(Code::Cancelled, "it was cancelled")
    }

    /// Returns the message without the name of the file.
    pub fn reason_in(&self, path: &str) -> String {
        let message = self.message.strip_prefix(path).and_then(|rest| rest.strip_prefix(": "));
        Self { message: message.unwrap_or(&self.message).to_owned(), ..self.clone() }.to_string()
    }

    /// Adds a hint.
    pub fn with_hint(self, hint: impl Display) -> Self {
        Self { hint: Some(hint.to_string()), ..self }
    }
}

impl Display for TaskError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)?;
        match &self.hint {
            Some(hint) => write!(f, "; {hint}"),
            None => Ok(()),
        }
    }
}

impl std::error::Error for TaskError {}

/// Describes an I/O error, without the system's error number where a plain description exists.
fn reason(error: &io::Error) -> String {
    match error.kind() {
        ErrorKind::NotFound => "there is no such file or folder".into(),
        ErrorKind::PermissionDenied => "permission is denied".into(),
        ErrorKind::StorageFull => "the disk is full".into(),
        _ => error.to_string(),
    }
}
