//! Labelled clips, read and retargeted to one body, for builds and evaluations.

use crate::failure::{Failure, Outcome};
use crate::files;
use crate::gather::Source;
use crate::progress::Bar;
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};
use serde::Serialize;
use std::fmt::Write;
use std::path::Path;
use strut_core::database::build::SourceClip;
use strut_formats::corpus::{self, Clip, DEFAULT_PATTERN, Entry, Labels, Pattern, Table};

/// Greatest size of a table, bytes.
const MAX_TABLE_BYTES: usize = 64 << 20;

/// A file that did not enter the database.
#[derive(Debug, Serialize)]
pub(crate) struct RefusedFile {
    pub(crate) file: String,
    pub(crate) reason: String,
}

/// Refused clips with the reason, one line each.
pub(crate) fn warnings(refused: &[RefusedFile]) -> String {
    refused.iter().fold(String::new(), |mut out, r| {
        // Writing to a string cannot fail.
        let _ = writeln!(out, "warning: refused {}: {}", r.file, r.reason);
        out
    })
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
    let pattern = pattern.or(default.as_ref());
    let labels = match table {
        None => corpus::assign(&paths, pattern, None).map_err(Failure::new)?,
        Some(path) => Table::parse(&files::read(path, MAX_TABLE_BYTES)?)
            .and_then(|table| corpus::assign(&paths, pattern, Some(&table)))
            .map_err(|e| Failure::in_file(path, e))?,
    };
    let mut labelled = Vec::new();
    for (source, labels) in sources.iter().zip(labels) {
        match labels {
            Ok(labels) => labelled.push((source, labels)),
            Err(reason) => refused.push(RefusedFile { file: source.path.clone(), reason: reason.to_string() }),
        }
    }
    if labelled.is_empty() {
        let advice = "say how clips are labelled with --pattern or --labels";
        let RefusedFile { file, reason } = &refused[0];
        return Err(Failure::new(format_args!("{file}: {reason}; {advice}")));
    }
    corpus::count_takes(labelled.iter_mut().map(|(_, labels)| labels));
    Ok(labelled)
}

/// Reads all clips and retargets them to the body of the first clip in the neutral style.
pub(crate) fn read_clips(
    neutral: Option<&str>,
    labelled: Vec<(&Source, Labels)>,
    refused: &mut Vec<RefusedFile>,
) -> Outcome<Vec<SourceClip>> {
    let read = |source: &Source| source.bytes().and_then(|b| Clip::parse(&b).map_err(|e| e.to_string()));
    let styles: Vec<&str> = labelled.iter().map(|(_, labels)| labels.style.as_str()).collect();
    let first = corpus::body_order(&styles, neutral).into_iter().find_map(|i| read(labelled[i].0).ok());
    let Some(first) = first else {
        let (source, _) = &labelled[0];
        return Err(Failure::new(format_args!("{}: {}", source.path, read(source).err().unwrap_or_default())));
    };
    let body = first.binding.proportions;
    let bar = Bar::new("reading", labelled.len());
    let convert = |(source, labels): &(&Source, Labels)| {
        let clip = read(source).map(|clip| {
            let entry = Entry { path: source.path.clone(), labels: labels.clone(), licence: source.licence() };
            entry.source_clip(&clip, &body)
        });
        bar.step();
        clip.map_err(|reason| RefusedFile { file: source.path.clone(), reason })
    };
    let results: Vec<_> = labelled.par_iter().map(convert).collect();
    let mut clips = Vec::new();
    for result in results {
        match result {
            Ok(clip) => clips.push(clip),
            Err(fault) => refused.push(fault),
        }
    }
    corpus::name_apart(&mut clips);
    Ok(clips)
}
