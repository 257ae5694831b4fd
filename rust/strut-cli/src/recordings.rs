//! The clips that a key-style model learns from.

use crate::corpus::RefusedFile;
use crate::failure::{Failure, Outcome};
use crate::gather::{Source, gather};
use crate::progress::Bar;
use crate::threads::ThreadPool;
use std::path::PathBuf;
use strut_core::parallel::ParallelMap;
use strut_core::retarget::to_humanoid;
use strut_core::somn::Recording;
use strut_formats::corpus::{Clip, stem};

/// All clips of the inputs on the body of the first readable one, in the order of their paths; unusable files are added to
/// `refused`.
///
/// # Errors
/// If no file can be used; with the reason for the first.
pub(crate) fn read_recordings(inputs: &[PathBuf], refused: &mut Vec<RefusedFile>) -> Outcome<Vec<Recording>> {
    let sources = gather(inputs)?;
    let parse = |source: &Source| source.bytes().and_then(|bytes| Clip::parse(&bytes).map_err(|e| e.to_string()));
    let Some(body) = sources.iter().find_map(|source| Some(parse(source).ok()?.binding.proportions)) else {
        let reason = parse(&sources[0]).err().unwrap_or_default();
        return Err(Failure::new(format_args!("{}: {reason}", sources[0].path)));
    };
    let bar = Bar::new("reading", sources.len());
    let results = ThreadPool.map(sources.len(), &|i| {
        let recording = parse(&sources[i]).and_then(|clip| {
            let motion = to_humanoid(&clip.motion, &clip.binding, &body);
            Recording::new(stem(&sources[i].path), &motion).map_err(|e| e.to_string())
        });
        bar.step();
        recording
    });
    let mut recordings = Vec::new();
    for (source, result) in sources.iter().zip(results) {
        match result {
            Ok(recording) => recordings.push(recording),
            Err(reason) => refused.push(RefusedFile { file: source.path.clone(), reason }),
        }
    }
    Ok(recordings)
}
