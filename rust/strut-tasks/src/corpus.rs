//! Labelled clips, read and retargeted to one body, for builds and evaluations.

use crate::error::{Outcome, TaskError};
use crate::files;
use crate::gather::Source;
use crate::progress::{Counter, OnProgress};
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;
use strut_core::database::build::SourceClip;
use strut_core::note::Note;
use strut_formats::corpus::{self, Clip, DEFAULT_PATTERN, Entry, Labels, Pattern, Table};
use strut_formats::joints::Reading;

/// Greatest size of a table, bytes.
const MAX_TABLE_BYTES: usize = 64 << 20;

/// A file that is not used in the database.
#[derive(Debug, Serialize)]
pub struct RefusedFile {
    /// Its path.
    pub file: String,
    /// Why it was left out.
    pub reason: String,
}

/// Clips that were read.
pub struct ReadClips {
    /// The clips, retargeted to one body.
    pub clips: Vec<SourceClip>,
    /// Warnings about files, by path. Files without warnings are omitted.
    pub notes: BTreeMap<String, Vec<Note>>,
}

/// Returns the refused clips with the reasons, one line each.
pub fn warnings(refused: &[RefusedFile]) -> String {
    refused.iter().fold(String::new(), |mut out, r| {
        // Writing to a string cannot fail.
        let _ = writeln!(out, "warning: refused {}: {}", r.file, r.reason);
        out
    })
}

/// Returns the labelled sources. Labels come from a table, a pattern, or otherwise the default pattern. Takes without a
/// number are counted within their class.
///
/// # Errors
/// If no source has labels, or the table is faulty.
pub fn label<'a>(
    sources: &'a [Source],
    pattern: Option<&Pattern>,
    table: Option<&Path>,
    refused: &mut Vec<RefusedFile>,
) -> Outcome<Vec<(&'a Source, Labels)>> {
    let paths: Vec<String> = sources.iter().map(|s| s.path.clone()).collect();
    let default = table.is_none().then(|| DEFAULT_PATTERN.parse().map_err(TaskError::new)).transpose()?;
    let pattern = pattern.or(default.as_ref());
    let labels = match table {
        None => corpus::assign(&paths, pattern, None).map_err(TaskError::new)?,
        Some(path) => Table::parse(&files::read(path, MAX_TABLE_BYTES)?)
            .and_then(|table| corpus::assign(&paths, pattern, Some(&table)))
            .map_err(|e| TaskError::in_file(path, e))?,
    };
    let mut labelled = Vec::new();
    for (source, labels) in sources.iter().zip(labels) {
        match labels {
            Ok(labels) => labelled.push((source, labels)),
            Err(reason) => refused.push(RefusedFile { file: source.path.clone(), reason: reason.to_string() }),
        }
    }
    if labelled.is_empty() {
        let advice = "give the labels with --pattern or --labels";
        let RefusedFile { file, reason } = &refused[0];
        return Err(TaskError::new(format_args!("{file}: {reason}")).with_hint(advice));
    }
    corpus::count_takes(labelled.iter_mut().map(|(_, labels)| labels));
    Ok(labelled)
}

/// Reads the clip of a source. The error does not name the file.
pub(crate) fn parse(source: &Source) -> Result<Clip, String> {
    read(source, &Reading::default())
}

/// Reads the clip of a source with explicit reading options.
fn read(source: &Source, reading: &Reading) -> Result<Clip, String> {
    let bytes = source.bytes().map_err(|e| e.reason_in(&source.path))?;
    Clip::read(&bytes, reading).map_err(|e| e.to_string())
}

/// Reads all clips with their reading options, and retargets them to the body of the first clip in the neutral style.
///
/// # Errors
/// If no clip can be read, or the caller cancels.
pub fn read_clips(
    neutral: Option<&str>,
    reading: &Reading,
    labelled: Vec<(&Source, Labels)>,
    refused: &mut Vec<RefusedFile>,
    on_progress: &OnProgress<'_>,
) -> Outcome<ReadClips> {
    let styles: Vec<&str> = labelled.iter().map(|(_, labels)| labels.style.as_str()).collect();
    let first = corpus::body_order(&styles, neutral).into_iter().find_map(|i| read(labelled[i].0, reading).ok());
    let Some(first) = first else {
        let (source, _) = &labelled[0];
        return Err(TaskError::new(format_args!(
            "{}: {}",
            source.path,
            read(source, reading).err().unwrap_or_default()
        )));
    };
    let body = first.binding.proportions;
    let counter = Counter::new("reading", labelled.len(), on_progress);
    let convert = |(source, labels): &(&Source, Labels)| {
        let clip = read(source, reading).map(|clip| {
            let entry = Entry { path: source.path.clone(), labels: labels.clone(), licence: source.licence() };
            (entry.source_clip(&clip, &body), clip.notes)
        });
        counter.step()?;
        Ok(clip.map_err(|reason| RefusedFile { file: source.path.clone(), reason }))
    };
    let results: Vec<_> = labelled.par_iter().map(convert).collect::<Outcome<_>>()?;
    let (mut clips, mut notes) = (Vec::new(), BTreeMap::new());
    for result in results {
        match result {
            Ok((clip, of_clip)) => {
                if !of_clip.is_empty() {
                    notes.insert(clip.source.clone(), of_clip);
                }
                clips.push(clip);
            }
            Err(fault) => refused.push(fault),
        }
    }
    corpus::name_apart(&mut clips);
    Ok(ReadClips { clips, notes })
}
