//! One job: from the bytes of the input to the written output.

use super::attempts::{Attempts, MOST};
use super::manifest::{Record, Status, now_ms};
use super::outputs;
use super::styling::VariantStyling;
use super::workers::Ending;
use crate::digest::sha256_hex;
use crate::error::{Code, Outcome, TaskError};
use crate::gather::Source;
use crate::note_report::NoteReport;
use crate::progress::OnProgress;
use crate::stylize::{Spread, Styling};
use std::path::Path;
use strut_formats::GENERATOR;
use strut_formats::bvh;

/// Shared state of all jobs of a batch.
pub(super) struct Performer<'a> {
    /// Folder of the outputs.
    pub(super) folder: &'a Path,
    /// Name of the manifest.
    pub(super) manifest: String,
    /// Starts that have not ended.
    pub(super) attempts: Attempts,
}

/// A written output.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Written {
    /// SHA-256 of the output.
    pub(super) sha256: String,
    /// Size of the output.
    pub(super) bytes: u64,
    /// Frames of the output.
    pub(super) frames: u64,
    /// Frames of the input that were replaced.
    pub(super) repaired: u64,
    pub(super) notes: Vec<NoteReport>,
}

/// Digests of a job's input, known even if the job fails.
#[derive(Clone, Debug, Default)]
pub(super) struct Known {
    /// SHA-256 of the input.
    pub(super) input: Option<String>,
    /// Key of the job.
    pub(super) key: Option<String>,
}

impl Performer<'_> {
    /// Styles a source into an output. Sets `known` as soon as the source is read.
    ///
    /// # Errors
    /// If the input cannot be read or styled, the output cannot be written, or the caller cancels.
    pub(super) fn perform(
        &self,
        (source, output): (&Source, &str),
        VariantStyling { styling, digests, .. }: &VariantStyling,
        known: &mut Known,
        on_progress: &OnProgress<'_>,
    ) -> Outcome<Written> {
        let bytes = source.bytes()?;
        // The digest is of the bytes that are styled, even if the file changes meanwhile.
        let input = sha256_hex(&bytes);
        let key = digests.key(&input);
        *known = Known { input: Some(input), key: Some(key.clone()) };
        let Some(started) = self.attempts.start(output, &key)? else {
            let reason = format_args!("{}: the program ended {MOST} times while styling this clip", source.path);
            return Err(TaskError::of(Code::Fault, reason));
        };
        let styled = self.styled(source, &bytes, output, styling, on_progress);
        if matches!(&styled, Err(error) if matches!(error.code, Code::Cancelled | Code::Io(_))) {
            started.take_back();
        }
        styled
    }

    fn styled(
        &self,
        source: &Source,
        bytes: &[u8],
        output: &str,
        styling: &Styling,
        on_progress: &OnProgress<'_>,
    ) -> Outcome<Written> {
        let clip = styling.read(&source.path, bytes)?;
        let styled = styling.style(&source.path, &clip, None, Spread::Clips, on_progress)?;
        let text = bvh::write(&styled.file);
        outputs::write(self.folder, output, &self.manifest, &text)?;
        Ok(Written {
            sha256: sha256_hex(&text),
            bytes: text.len() as u64,
            frames: styled.file.frames as u64,
            repaired: styled.motion.frames.last().map_or(0, |frame| u64::from(frame.repaired_total)),
            notes: NoteReport::of(&styled.notes),
        })
    }
}

/// Returns the record of a job that just ended: its output, input and variant by name.
pub(super) fn record((output, input, variant): (&str, &str, &str), known: Known, ending: Ending<Written>) -> Record {
    let (status, written, error) = match ending {
        Ending::Done(written) => (Status::Done, Some(written), None),
        Ending::Skipped(error) => (Status::Skipped, None, Some(error)),
        Ending::Failed(error) => (Status::Failed, None, Some(error)),
    };
    Record {
        job: output.to_owned(),
        key: known.key,
        input: input.to_owned(),
        input_sha256: known.input,
        variant: variant.to_owned(),
        output: output.to_owned(),
        output_sha256: written.as_ref().map(|written| written.sha256.clone()),
        bytes: written.as_ref().map(|written| written.bytes),
        frames: written.as_ref().map(|written| written.frames),
        repaired: written.as_ref().map(|written| written.repaired),
        notes: written.map(|written| written.notes).unwrap_or_default(),
        status,
        code: error.as_ref().map(|error| error.code.name().to_owned()),
        message: error.map(|error| error.to_string()),
        version: GENERATOR.to_owned(),
        time_ms: now_ms(),
    }
}
