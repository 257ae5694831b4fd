//! Errors of tasks: what happened, in a sentence, and of which kind it is.

use std::fmt::{self, Display};
use std::io::{self, ErrorKind};
use std::path::Path;

/// Kind of an error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Code {
    /// A file's content is not what was expected.
    BadFile,
    /// What was asked for does not go with the files: a style that a database lacks, for example.
    BadInput,
    /// An argument that no file could make right.
    Usage,
    /// The system could not read or write.
    Io(ErrorKind),
    /// The caller asked to stop.
    Cancelled,
    /// A fault of the program.
    Fault,
}

impl Code {
    /// Its name in manifests and in Python.
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
    /// Kind of the error.
    pub code: Code,
    /// One sentence on one line, which names the file, without a full stop.
    pub message: String,
    /// What to do about it.
    pub hint: Option<String>,
}

/// Result of a step of a task.
pub type Outcome<T = ()> = Result<T, TaskError>;

impl TaskError {
    /// An error of a kind.
    pub fn of(code: Code, reason: impl Display) -> Self {
        // Names from files may hold anything; a message is one line.
        let one_line = |text: String| text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
        Self { code, message: one_line(reason.to_string()), hint: None }
    }

    /// An error that concerns no file in particular.
    pub fn new(reason: impl Display) -> Self {
        Self::of(Code::BadInput, reason)
    }

    /// An error of a file.
    pub fn in_file(path: &Path, reason: impl Display) -> Self {
        Self::of(Code::BadFile, format_args!("{}: {reason}", path.display()))
    }

    /// What the system says of a file.
    pub fn io(path: &Path, error: &io::Error) -> Self {
        Self::of(Code::Io(error.kind()), format_args!("{}: {}", path.display(), reason(error)))
    }

    /// Arguments that no file could make right.
    pub fn usage(reason: impl Display) -> Self {
        Self::of(Code::Usage, reason)
    }

    /// The caller asked to stop.
    pub fn cancelled() -> Self {
        Self::of(Code::Cancelled, "it was cancelled")
    }

    /// The sentence without the name of the file.
    pub fn reason_in(&self, path: &str) -> String {
        let message = self.message.strip_prefix(path).and_then(|rest| rest.strip_prefix(": "));
        Self { message: message.unwrap_or(&self.message).to_owned(), ..self.clone() }.to_string()
    }

    /// With what to do about it.
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

/// What an I/O error means, without the system's error number where a plain word exists.
fn reason(error: &io::Error) -> String {
    match error.kind() {
        ErrorKind::NotFound => "there is no such file or folder".into(),
        ErrorKind::PermissionDenied => "permission is denied".into(),
        ErrorKind::StorageFull => "the disk is full".into(),
        _ => error.to_string(),
    }
}
