//! The request of a batch.

use super::manifest::Status;
use super::shard::Shard;
use super::variants::Variant;
use crate::error::{Code, Outcome, TaskError};
use std::num::NonZero;
use std::path::PathBuf;

/// Which jobs that ended otherwise than done are done again.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[allow(missing_docs)] // The names are self-explanatory, and comments would appear in the help.
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

/// Inputs, variants and options of a batch.
#[derive(Clone, Debug)]
pub struct BatchRequest {
    /// BVH files, folders (recursively) and archives.
    pub inputs: Vec<PathBuf>,
    /// The database.
    pub database: PathBuf,
    /// The variants in which every input is styled.
    pub variants: Vec<Variant>,
    /// Folder of the outputs.
    pub output: PathBuf,
    /// The shard of the jobs that this run does.
    pub shard: Shard,
    /// Number of worker threads; one per processor if `None`.
    pub threads: Option<NonZero<usize>>,
    /// Which unsuccessful jobs are done again.
    pub retry: Option<Retry>,
    /// Whether existing outputs are checked by their content, not only by their size.
    pub verify: bool,
}

impl BatchRequest {
    /// Refuses an output folder inside an input folder: a second run would read outputs as inputs.
    pub(super) fn refuse_outputs_among_inputs(&self) -> Outcome {
        let absolute = std::path::absolute(&self.output).map_err(|e| TaskError::io(&self.output, &e))?;
        // The part of the path that exists.
        let output = absolute.ancestors().find_map(|path| path.canonicalize().ok()).unwrap_or_default();
        for input in self.inputs.iter().filter(|input| input.is_dir()) {
            if output.starts_with(input.canonicalize().map_err(|e| TaskError::io(input, &e))?) {
                let reason = format_args!(
                    "the output folder is inside the input {}; another folder was expected",
                    input.display()
                );
                return Err(TaskError::of(Code::BadInput, format_args!("{}: {reason}", self.output.display())));
            }
        }
        Ok(())
    }
}
