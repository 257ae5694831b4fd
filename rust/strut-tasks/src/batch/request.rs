//! What a batch is asked for.

use super::manifest::Status;
use super::shard::Shard;
use super::variants::Variant;
use crate::error::{Code, Outcome, TaskError};
use std::num::NonZero;
use std::path::PathBuf;

/// Which jobs that ended otherwise than done are done again.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[allow(missing_docs)] // Their names say it, and comments would be the help of the command.
pub enum Retry {
    Failed,
    Skipped,
    All,
}

impl Retry {
    pub(super) fn includes(self, status: Status) -> bool {
        match status {
            Status::Done => false,
            Status::Skipped => matches!(self, Self::Skipped | Self::All),
            Status::Failed => matches!(self, Self::Failed | Self::All),
        }
    }
}

/// What to do.
#[derive(Clone, Debug)]
pub struct BatchRequest {
    /// BVH files, folders with all below them, archives.
    pub inputs: Vec<PathBuf>,
    /// The database.
    pub database: PathBuf,
    /// What every input becomes.
    pub variants: Vec<Variant>,
    /// Folder of the outputs.
    pub output: PathBuf,
    /// The share of the jobs that is this run's.
    pub shard: Shard,
    /// Threads that work; one a processor if `None`.
    pub threads: Option<NonZero<usize>>,
    /// What did not work before and is done again.
    pub retry: Option<Retry>,
    /// Whether outputs are compared with what was recorded by their content, not by their size alone.
    pub verify: bool,
}

impl BatchRequest {
    /// A second run would take outputs for inputs.
    pub(super) fn refuse_outputs_among_inputs(&self) -> Outcome {
        let absolute = std::path::absolute(&self.output).map_err(|e| TaskError::io(&self.output, &e))?;
        // As much of it as there is.
        let output = absolute.ancestors().find_map(|path| path.canonicalize().ok()).unwrap_or_default();
        for input in self.inputs.iter().filter(|input| input.is_dir()) {
            if output.starts_with(input.canonicalize().map_err(|e| TaskError::io(input, &e))?) {
                let reason = format_args!("it lies in the input {}; another folder was expected", input.display());
                return Err(TaskError::of(Code::BadInput, format_args!("{}: {reason}", self.output.display())));
            }
        }
        Ok(())
    }
}
