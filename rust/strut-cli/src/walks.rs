//! The labelled walks that a model is trained and measured on.

use crate::corpus::{self, RefusedFile};
use crate::failure::Outcome;
use crate::gather::gather;
use crate::threads::ThreadPool;
use std::path::{Path, PathBuf};
use strut_core::hsmm::{Track, steps_of};
use strut_core::humanoid::Proportions;
use strut_core::parallel::ParallelMap;
use strut_formats::corpus::Pattern;

/// The action that is walking, where clips have any of that name.
const WALK: &str = "walk";

/// A clip that holds steps.
pub(crate) struct Walk {
    pub(crate) style: String,
    pub(crate) take: u32,
    pub(crate) track: Track,
    /// Number of steps.
    pub(crate) steps: usize,
}

/// The body that walks, and the walks; files that are none join the `refused`.
pub(crate) fn read_walks(
    inputs: &[PathBuf],
    pattern: Option<&Pattern>,
    labels: Option<&Path>,
    refused: &mut Vec<RefusedFile>,
) -> Outcome<(Proportions, Vec<Walk>)> {
    let sources = gather(inputs)?;
    let mut labelled = corpus::label(&sources, pattern, labels, refused)?;
    if labelled.iter().any(|(_, labels)| labels.action == WALK) {
        labelled.retain(|(_, labels)| labels.action == WALK);
    }
    let clips = corpus::read_clips(None, labelled, refused)?;
    let tracks = ThreadPool.map(clips.len(), &|i| {
        let track = Track::new(&clips[i].motion).map_err(|e| e.to_string())?;
        let steps = steps_of(&track).len();
        if steps == 0 { Err("it holds no step".to_owned()) } else { Ok((track, steps)) }
    });
    let body = clips.first().map(|clip| clip.motion.proportions).unwrap_or_default();
    let mut walks = Vec::new();
    for (clip, track) in clips.into_iter().zip(tracks) {
        match track {
            Ok((track, steps)) => walks.push(Walk { style: clip.style, take: clip.take, track, steps }),
            Err(reason) => refused.push(RefusedFile { file: clip.source, reason }),
        }
    }
    Ok((body, walks))
}
