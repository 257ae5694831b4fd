//! The clips for the training of a key-style model.

use crate::corpus::{RefusedFile, parse};
use crate::error::{Outcome, TaskError};
use crate::gather::gather;
use crate::progress::{Counter, OnProgress};
use crate::threads::ThreadPool;
use std::path::PathBuf;
use strut_core::parallel::ParallelMap;
use strut_core::retarget::to_humanoid;
use strut_core::somn::Recording;
use strut_formats::corpus::stem;

/// Reads all clips of the inputs onto the body of the first readable one, in the order of their paths. Unusable files
/// are added to `refused`.
///
/// # Errors
/// If no file can be used, with the reason for the first one; or the caller cancels.
pub fn read_recordings(
    inputs: &[PathBuf],
    refused: &mut Vec<RefusedFile>,
    on_progress: &OnProgress<'_>,
) -> Outcome<Vec<Recording>> {
    let sources = gather(inputs)?;
    let Some(body) = sources.iter().find_map(|source| Some(parse(source).ok()?.binding.proportions)) else {
        let reason = parse(&sources[0]).err().unwrap_or_default();
        return Err(TaskError::new(format_args!("{}: {reason}", sources[0].path)));
    };
    let counter = Counter::new("reading", sources.len(), on_progress);
    let results = ThreadPool.map(sources.len(), &|i| {
        let recording = parse(&sources[i]).and_then(|clip| {
            let motion = to_humanoid(&clip.motion, &clip.binding, &body);
            Recording::new(stem(&sources[i].path), &motion).map_err(|e| e.to_string())
        });
        counter.step().map(|()| recording)
    });
    let results = results.into_iter().collect::<Outcome<Vec<_>>>()?;
    let mut recordings = Vec::new();
    for (source, result) in sources.iter().zip(results) {
        match result {
            Ok(recording) => recordings.push(recording),
            Err(reason) => refused.push(RefusedFile { file: source.path.clone(), reason }),
        }
    }
    Ok(recordings)
}
