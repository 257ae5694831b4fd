//! The labelled walks for the training and the evaluation of a model.

use crate::corpus::{self, RefusedFile};
use crate::error::{Outcome, TaskError};
use crate::gather::gather;
use crate::progress::OnProgress;
use crate::threads::ThreadPool;
use std::path::{Path, PathBuf};
use strut_core::hsmm::{LabelledClip, Options, Track, WALK, WalkModel, landmarks, train, walk_of, walking_action};
use strut_core::humanoid::Proportions;
use strut_core::parallel::ParallelMap;
use strut_formats::corpus::Pattern;
use strut_formats::joints::Reading;

/// A clip with steps.
pub struct Walk {
    /// Its style.
    pub style: String,
    /// Number of the take.
    pub take: u32,
    /// Features that models learn from.
    pub track: Track,
    /// Number of steps.
    pub steps: usize,
}

/// Reads the body and the walks. Unusable files are added to `refused`. Walks are the clips of the action `walk`, or
/// without it those of the action with the most steps.
///
/// # Errors
/// If there is no walk, or the caller cancels.
pub fn read_walks(
    inputs: &[PathBuf],
    pattern: Option<&Pattern>,
    labels: Option<&Path>,
    refused: &mut Vec<RefusedFile>,
    on_progress: &OnProgress<'_>,
) -> Outcome<(Proportions, Vec<Walk>)> {
    let sources = gather(inputs)?;
    let mut labelled = corpus::label(&sources, pattern, labels, refused)?;
    if labelled.iter().any(|(_, labels)| labels.action == WALK) {
        labelled.retain(|(_, labels)| labels.action == WALK);
    }
    let clips = corpus::read_clips(None, &Reading::default(), labelled, refused, on_progress)?.clips;
    let tracks = ThreadPool.map(clips.len(), &|i| walk_of(&clips[i].motion));
    let steps = clips.iter().zip(&tracks).filter_map(|(clip, walk)| Some((&*clip.action, walk.as_ref().ok()?.1)));
    let action = walking_action(&steps.collect::<Vec<_>>()).map(str::to_owned);
    let body = clips.first().map(|clip| clip.motion.proportions).unwrap_or_default();
    let mut walks = Vec::new();
    for (clip, track) in clips.into_iter().zip(tracks) {
        match track {
            Ok(_) if action.as_ref().is_some_and(|action| *action != clip.action) => {
                let reason = format!(
                    "its action is '{}'; that of the walks is '{}'",
                    clip.action,
                    action.as_deref().unwrap_or(WALK)
                );
                refused.push(RefusedFile { file: clip.source, reason });
            }
            Ok((track, steps)) => walks.push(Walk { style: clip.style, take: clip.take, track, steps }),
            Err(error) => refused.push(RefusedFile { file: clip.source, reason: error.to_string() }),
        }
    }
    match refused.last() {
        Some(RefusedFile { file, reason }) if walks.is_empty() => {
            Err(TaskError::new(format_args!("no clip is a walk; of the last, {file}: {reason}")))
        }
        _ => Ok((body, walks)),
    }
}

/// Trains a walk model. Returns it with the walks it was trained on, under the names of its styles: where takes of a
/// style differ much, they become separate styles. Unusable files are added to `refused`.
///
/// # Errors
/// Those of [`read_walks`], or if the walks are not sufficient for a model.
pub fn train_walks(
    inputs: &[PathBuf],
    pattern: Option<&Pattern>,
    labels: Option<&Path>,
    refused: &mut Vec<RefusedFile>,
    on_progress: &OnProgress<'_>,
) -> Outcome<(WalkModel, Vec<Walk>)> {
    let (body, mut walks) = read_walks(inputs, pattern, labels, refused, on_progress)?;
    let names = landmarks(&labelled(&walks));
    walks.iter_mut().zip(names).for_each(|(walk, name)| walk.style = name);
    let model = train(&body, &labelled(&walks), Options::default(), &ThreadPool).map_err(TaskError::new)?;
    Ok((model, walks))
}

fn labelled(walks: &[Walk]) -> Vec<LabelledClip<'_>> {
    walks.iter().map(|walk| LabelledClip { style: &walk.style, track: &walk.track }).collect()
}
