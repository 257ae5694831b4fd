//! Labelled BVH files as the clips of a build: action, style and take of each file, and its motion on the common body
//! of a database's clips.
//!
//! The command line reads files from disk on all CPUs, the page reads archives sequentially. Labels, order and body are
//! determined here, so that both build the same database from the same files.

mod guess;
mod pattern;
mod table;

pub use guess::guess_pattern;
pub use pattern::{LabelError, Labels, Pattern, PatternError};
pub use table::{Table, TableError, assign};

use crate::bvh::{self, Bvh, BvhError};
use crate::joints::Reading;
use std::collections::{BTreeMap, BTreeSet, HashMap};
use strut_core::database::build::SourceClip;
use strut_core::humanoid::Proportions;
use strut_core::motion::Motion;
use strut_core::note::Note;
use strut_core::retarget::{BindError, Binding, to_humanoid};
use thiserror::Error;

/// Default pattern of file names.
pub const DEFAULT_PATTERN: &str = "{action}_{style}_{take}.bvh";
/// Names of licence files in the folders of clips.
pub const LICENCE_NAMES: [&str; 4] = ["LICENSE", "LICENSE.txt", "LICENSE.md", "LICENCE"];
/// Greatest length of a licence's title, characters.
const MAX_TITLE_CHARS: usize = 100;

/// A BVH file, its motion, and the roles of its joints.
#[derive(Clone, Debug, PartialEq)]
pub struct Clip {
    /// The file.
    pub file: Bvh,
    /// Its motion, in the file's units.
    pub motion: Motion,
    /// Mapping of its skeleton to the humanoid.
    pub binding: Binding,
    /// Notes on guesses about the text and on possible errors of the binding; empty for a clean file.
    pub notes: Vec<Note>,
}

/// Reason why bytes are not a clip. The messages are shown to users.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum ClipError {
    /// The file is not a BVH file.
    #[error(transparent)]
    Bvh(#[from] BvhError),
    /// The skeleton is not a humanoid.
    #[error(transparent)]
    Bind(#[from] BindError),
}

impl Clip {
    /// Parses a clip.
    ///
    /// # Errors
    /// See [`ClipError`].
    pub fn parse(bytes: &[u8]) -> Result<Self, ClipError> {
        Self::with_binding(bytes, Binding::detect)
    }

    /// Parses a clip with user-specified reading options.
    ///
    /// # Errors
    /// See [`ClipError`].
    pub fn read(bytes: &[u8], reading: &Reading) -> Result<Self, ClipError> {
        Self::with_binding(bytes, |motion| reading.bind(motion))
    }

    /// Parses a clip, bound by `bind` instead of by detection.
    ///
    /// # Errors
    /// See [`ClipError`].
    pub fn with_binding(
        bytes: &[u8],
        bind: impl FnOnce(&Motion) -> Result<Binding, BindError>,
    ) -> Result<Self, ClipError> {
        let (file, mut notes) = bvh::parse_noted(bytes)?;
        let motion = file.to_motion()?;
        let binding = bind(&motion)?;
        notes.extend_from_slice(&binding.doubts);
        Ok(Self { file, motion, binding, notes })
    }
}

/// A file with its labels, before it is parsed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// Path with `/`; for a file in an archive the archive's path, then the path in it.
    pub path: String,
    /// Labels of the file.
    pub labels: Labels,
    /// Title of the licence, empty if unknown.
    pub licence: String,
}

impl Entry {
    /// Source clip of a build, made from this file's parsed clip and named after the file; see [`name_apart`].
    pub fn source_clip(&self, clip: &Clip, body: &Proportions) -> SourceClip {
        SourceClip {
            name: stem(&self.path).to_owned(),
            action: self.labels.action.clone(),
            style: self.labels.style.clone(),
            take: self.labels.take.unwrap_or(0),
            motion: to_humanoid(&clip.motion, &clip.binding, body),
            source: self.path.clone(),
            licence: self.licence.clone(),
            script: None,
        }
    }
}

/// Numbers clips without a take within their class, in the given order, which is that of the paths. A clip's number is
/// its position in the class, or the next number that no other clip of the class has.
pub fn count_takes<'a>(labels: impl IntoIterator<Item = &'a mut Labels>) {
    let mut classes: BTreeMap<(String, String), Vec<&mut Option<u32>>> = BTreeMap::new();
    for labels in labels {
        classes.entry((labels.action.clone(), labels.style.clone())).or_default().push(&mut labels.take);
    }
    for takes in classes.into_values() {
        let mut known: BTreeSet<u32> = takes.iter().filter_map(|take| **take).collect();
        for (place, take) in (1_u32..).zip(takes) {
            if take.is_none() {
                *take = (place..=u32::MAX).find(|number| known.insert(*number));
            }
        }
    }
}

/// Order in which files, given in the order of their paths, are tried for the body of the database: it has the skeleton
/// of the first readable file. Files in the neutral style come first.
pub fn body_order(styles: &[&str], neutral: Option<&str>) -> Vec<usize> {
    let is_neutral = |style: &str| match neutral {
        Some(name) => style == name,
        None => matches!(style, "neutral" | "normal"),
    };
    let (mut order, others): (Vec<usize>, Vec<usize>) = (0..styles.len()).partition(|&i| is_neutral(styles[i]));
    order.extend(others);
    order
}

/// Renames clips with equal names after their paths, so that reports can distinguish them.
pub fn name_apart(clips: &mut [SourceClip]) {
    let mut count: HashMap<String, usize> = HashMap::new();
    for clip in &*clips {
        *count.entry(clip.name.clone()).or_default() += 1;
    }
    for clip in clips.iter_mut().filter(|clip| count[&clip.name] > 1) {
        clip.name.clone_from(&clip.source);
    }
}

/// First line of a licence's text if it is short enough to be a title; otherwise empty.
pub fn licence_title(text: &[u8]) -> String {
    let text = std::str::from_utf8(text).unwrap_or_default();
    let line = text.lines().map(str::trim).find(|line| !line.is_empty()).unwrap_or_default();
    if line.chars().count() <= MAX_TITLE_CHARS { line.to_owned() } else { String::new() }
}

/// Name of a file without folders and extension.
pub fn stem(path: &str) -> &str {
    let name = path.rsplit('/').next().unwrap_or(path);
    name.rsplit_once('.').map_or(name, |(stem, _)| stem)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn takes_are_counted_within_their_class_where_they_are_missing() {
        let of = |style: &str, take| Labels { action: "walk".into(), style: style.into(), take };
        let mut labels = [of("old", None), of("sad", None), of("old", Some(7)), of("old", None)];
        count_takes(&mut labels);
        assert_eq!(labels.map(|l| l.take), [Some(1), Some(1), Some(7), Some(3)]);
    }

    #[test]
    fn no_two_takes_of_a_class_get_one_number() {
        let of = |take| Labels { action: "walk".into(), style: "old".into(), take };
        for (given, expected) in [
            ([None, Some(1), None], [2, 1, 3]),
            ([Some(2), None, None], [2, 3, 4]),
            ([Some(1), None, None], [1, 2, 3]),
            ([None, None, Some(1)], [2, 3, 1]),
            ([None, Some(u32::MAX), Some(u32::MAX)], [1, u32::MAX, u32::MAX]),
        ] {
            let mut labels = given.map(of);
            count_takes(&mut labels);
            assert_eq!(labels.map(|l| l.take), expected.map(Some), "{given:?}");
        }
    }

    #[test]
    fn the_body_is_sought_among_neutral_clips_first() {
        let styles = ["angry", "normal", "old", "normal"];
        assert_eq!(body_order(&styles, None), [1, 3, 0, 2]);
        assert_eq!(body_order(&styles, Some("old")), [2, 0, 1, 3]);
        assert_eq!(body_order(&styles, Some("proud")), [0, 1, 2, 3]);
    }

    #[test]
    fn a_licence_is_named_by_its_title() {
        assert_eq!(licence_title(b"\n  CC BY 4.0 \n\nlong text"), "CC BY 4.0");
        assert_eq!(licence_title("x".repeat(101).as_bytes()), "");
        assert_eq!(licence_title(&[0xff, 0xfe]), "");
    }

    #[test]
    fn the_stem_is_the_name_alone() {
        assert_eq!(["a/b.c/d.e.bvh", "d", ".bvh", "a/"].map(stem), ["d.e", "d", "", ""]);
    }
}
