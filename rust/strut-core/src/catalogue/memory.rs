//! Memory of a catalogue, estimated before it is created.

use super::quantised::QuantisedRows;
use super::runtime::Catalogue;
use super::target_table::TargetTable;
use crate::database::Clip;
use crate::search::Index;

/// Quantities that determine the memory of a catalogue.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CatalogueSize {
    /// Number of rows of all clips.
    pub frames: u64,
    /// Number of styles.
    pub styles: u64,
    /// M of [`DatabaseParts`](crate::database::DatabaseParts).
    pub counterparts_per_style: u64,
    /// Number of clips.
    pub clips: u64,
    /// Number of classes.
    pub classes: u64,
    /// Number of rows of the largest class.
    pub frames_of_class: u64,
}

/// Memory of a clip, bytes: names, source and licence, in the file's form and in the catalogue's.
const CLIP: u64 = 1200;
/// Memory that does not depend on the size, bytes: directions of windows, and working memory.
const FIXED: u64 = 400_000;

impl CatalogueSize {
    /// Size of clips sorted by class; their values may be invalid.
    pub fn of_clips(clips: &[Clip], styles: usize, counterparts_per_style: usize) -> Self {
        let by_class = clips.chunk_by(|a, b| (a.action, a.style) == (b.action, b.style));
        let frames = |clips: &[Clip]| clips.iter().fold(0_u64, |n, clip| n.saturating_add(clip.frames as u64));
        Self {
            frames: frames(clips),
            styles: styles as u64,
            counterparts_per_style: counterparts_per_style as u64,
            clips: clips.len() as u64,
            classes: by_class.clone().count() as u64,
            frames_of_class: by_class.map(frames).max().unwrap_or_default(),
        }
    }

    /// Size of a catalogue.
    pub fn of(catalogue: &Catalogue) -> Self {
        Self::of_clips(&catalogue.clips, catalogue.styles.len(), catalogue.counterparts_per_style)
    }

    /// Maximum memory of a [`CatalogueBuilder`](super::CatalogueBuilder), bytes, including the data that it reads and
    /// creates, with a plan of the search index or without. At least the true number, and at most a fifth more.
    pub fn bytes(&self, has_plan: bool) -> u64 {
        let counterparts = self.styles.saturating_mul(self.counterparts_per_style).saturating_mul(4);
        // Durations, phases and contacts; and the order of a plan, or that of the windows to be built.
        let row = counterparts.saturating_add(4 + 8 + 2 + 8);
        let index = Index::bytes(self.frames, self.classes, (!has_plan).then_some(self.frames_of_class));
        [self.frames.saturating_mul(row), CLIP.saturating_mul(self.clips), index, FIXED]
            .into_iter()
            .fold(QuantisedRows::bytes(self.frames), u64::saturating_add)
    }

    /// Memory of the [table of targets](super::TargetTable) of a style after every target has been read, bytes.
    pub fn table_bytes(&self) -> u64 {
        TargetTable::bytes(self.frames)
    }
}
