//! Labelled clips, read and brought to one body: what a database is built from and an evaluation run on.

use crate::clip::Clip;
use crate::failure::{Failure, Outcome};
use crate::gather::Source;
use crate::labels;
use crate::pattern::{Labels, Pattern};
use crate::progress::Bar;
use rayon::iter::{IndexedParallelIterator, IntoParallelIterator, IntoParallelRefIterator, ParallelIterator};
use serde::Serialize;
use std::collections::{BTreeMap, HashMap};
use std::path::Path;
use strut_core::database::build::SourceClip;
use strut_core::humanoid::Proportions;
use strut_core::retarget::to_humanoid;

/// What files are called unless a pattern or a table says otherwise.
pub(crate) const DEFAULT_PATTERN: &str = "{action}_{style}_{take}.bvh";

/// A file that did not enter the database.
#[derive(Debug, Serialize)]
pub(crate) struct RefusedFile {
    pub(crate) file: String,
    pub(crate) reason: String,
}

/// The sources that have labels, from a table, a pattern, or the default pattern if there is neither; a take
/// that the labels leave out is counted within its class.
pub(crate) fn label<'a>(
    sources: &'a [Source],
    pattern: Option<&Pattern>,
    table: Option<&Path>,
    refused: &mut Vec<RefusedFile>,
) -> Outcome<Vec<(&'a Source, Labels)>> {
    let paths: Vec<String> = sources.iter().map(|s| s.path.clone()).collect();
    let default = table.is_none().then(|| DEFAULT_PATTERN.parse().map_err(Failure::new)).transpose()?;
    let labels = labels::assign(&paths, pattern.or(default.as_ref()), table)?;
    let mut takes: BTreeMap<(String, String), u32> = BTreeMap::new();
    let mut labelled = Vec::new();
    for (source, labels) in sources.iter().zip(labels) {
        match labels {
            Ok(mut labels) => {
                let counted = takes.entry((labels.action.clone(), labels.style.clone())).or_default();
                *counted += 1;
                labels.take.get_or_insert(*counted);
                labelled.push((source, labels));
            }
            Err(reason) => refused.push(RefusedFile { file: source.path.clone(), reason }),
        }
    }
    if labelled.is_empty() {
        let advice = "say how clips are labelled with --pattern or --labels";
        let RefusedFile { file, reason } = &refused[0];
        return Err(Failure::new(format_args!("{file}: {reason}; {advice}")));
    }
    Ok(labelled)
}

/// Reads all clips and brings them to the body of the first clip in the neutral style.
pub(crate) fn read_clips(
    neutral: Option<&str>,
    labelled: Vec<(&Source, Labels)>,
    refused: &mut Vec<RefusedFile>,
) -> Outcome<Vec<SourceClip>> {
    let bar = Bar::new("reading", labelled.len());
    let read = |(source, labels): (_, Labels)| {
        let source: &Source = source;
        let clip = source.bytes().and_then(|bytes| Clip::parse(&bytes));
        bar.step();
        (source, labels, clip)
    };
    let results: Vec<_> = labelled.into_par_iter().map(read).collect();
    let mut clips = Vec::new();
    for (source, labels, clip) in results {
        match clip {
            Ok(clip) => clips.push((source, labels, clip)),
            Err(reason) => refused.push(RefusedFile { file: source.path.clone(), reason }),
        }
    }
    if clips.is_empty() {
        let RefusedFile { file, reason } = &refused[0];
        return Err(Failure::new(format_args!("{file}: {reason}")));
    }
    let is_neutral = |style: &str| match neutral {
        Some(name) => style == name,
        None => matches!(style, "neutral" | "normal"),
    };
    let body = clips.iter().find(|(_, labels, _)| is_neutral(&labels.style)).unwrap_or(&clips[0]);
    let body: Proportions = body.2.binding.proportions;
    let names = distinct_names(&clips.iter().map(|(source, ..)| *source).collect::<Vec<_>>());
    let convert = |((source, labels, clip), name): (&(&Source, Labels, Clip), &String)| SourceClip {
        name: name.clone(),
        action: labels.action.clone(),
        style: labels.style.clone(),
        take: labels.take.unwrap_or(0),
        motion: to_humanoid(&clip.motion, &clip.binding, &body),
        source: source.path.clone(),
        licence: source.licence(),
        script: None,
    };
    Ok(clips.par_iter().zip(&names).map(convert).collect())
}

/// The stem of every file; the path of those that share theirs, so that reports can name them.
fn distinct_names(sources: &[&Source]) -> Vec<String> {
    let mut count: HashMap<&str, usize> = HashMap::new();
    for source in sources {
        *count.entry(source.stem()).or_default() += 1;
    }
    let name = |s: &&Source| if count[s.stem()] == 1 { s.stem().to_owned() } else { s.path.clone() };
    sources.iter().map(name).collect()
}
