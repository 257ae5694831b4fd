//! Handle of a database build.

use crate::build::built::Built;
use crate::build::clip::bind;
use crate::build::progress::Progress;
use crate::common::{EngineError, sentence};
use std::collections::HashMap;
use strut_core::database::BimodalStyle;
use strut_core::database::build::{self, Build, BuildOptions, BuildReport, SourceClip};
use strut_core::humanoid::Proportions;
use strut_core::incremental::IncrementalJob;
use strut_core::parallel::Sequential;
use strut_formats::corpus::{self, Clip, Entry, Labels};
use wasm_bindgen::prelude::wasm_bindgen;

/// A build to which clips are added one at a time. [`Builder::add`] keeps only the motion of a file.
#[wasm_bindgen]
pub struct Builder {
    entries: Vec<Entry>,
    neutral: Option<String>,
    body: Option<Proportions>,
    clips: Vec<SourceClip>,
}

#[wasm_bindgen]
impl Builder {
    /// Creates a build of these files. Takes below 0 are numbered automatically. Without `neutral` the neutral style is
    /// found by its name.
    ///
    /// # Errors
    /// If the lists differ in length.
    #[wasm_bindgen(constructor)]
    pub fn new(
        paths: Vec<String>,
        actions: Vec<String>,
        styles: Vec<String>,
        takes: Vec<i32>,
        licences: Vec<String>,
        neutral: Option<String>,
    ) -> Result<Self, EngineError> {
        let of_lists = [actions.len(), styles.len(), takes.len(), licences.len()];
        if let Some(found) = of_lists.into_iter().find(|length| *length != paths.len()) {
            let expected = paths.len();
            return Err(EngineError::bad_input(format!("{found} labels were given for {expected} files")));
        }
        let labels = actions.into_iter().zip(styles).zip(takes);
        let labels = labels.map(|((action, style), take)| Labels { action, style, take: u32::try_from(take).ok() });
        let entry = |((path, labels), licence)| Entry { path, labels, licence };
        let mut entries: Vec<Entry> = paths.into_iter().zip(labels).zip(licences).map(entry).collect();
        entries.sort_by(|a, b| a.path.cmp(&b.path));
        corpus::count_takes(entries.iter_mut().map(|e| &mut e.labels));
        Ok(Self { entries, neutral, body: None, clips: Vec::new() })
    }

    /// Returns the paths in the order in which the files must be added. The first readable file determines the
    /// database's body.
    pub fn order(&self) -> Vec<String> {
        let styles: Vec<&str> = self.entries.iter().map(|e| e.labels.style.as_str()).collect();
        let order = corpus::body_order(&styles, self.neutral.as_deref());
        order.into_iter().map(|i| self.entries[i].path.clone()).collect()
    }

    /// Adds a file. `roles` as for `Clip`.
    ///
    /// # Errors
    /// If the file cannot be used, with the reason. The database can still be built from the other files.
    pub fn add(&mut self, path: &str, bytes: &[u8], roles: Option<Vec<i32>>) -> Result<(), EngineError> {
        let at = self.entries.binary_search_by(|e| e.path.as_str().cmp(path));
        let unknown = |_| EngineError::bad_input(format!("'{path:.80}' is not among the files of this build"));
        let entry = &self.entries[at.map_err(unknown)?];
        let clip = Clip::with_binding(bytes, |motion| bind(motion, roles.as_deref()));
        let clip = clip.map_err(EngineError::unusable_file)?;
        let body = self.body.get_or_insert(clip.binding.proportions);
        self.clips.push(entry.source_clip(&clip, body));
        Ok(())
    }

    /// Starts the build of the database from the added files.
    ///
    /// # Errors
    /// If nothing can be built from them.
    pub fn begin(mut self, rate_hz: f32) -> Result<Building, EngineError> {
        // The same order as the command's: by path.
        self.clips.sort_by(|a, b| a.source.cmp(&b.source));
        corpus::name_apart(&mut self.clips);
        let options = BuildOptions { rate_hz, neutral: self.neutral, ..BuildOptions::default() };
        Ok(Building { build: Build::new(self.clips, &options).map_err(EngineError::unusable_file)? })
    }
}

/// A build in steps. Between two steps messages are handled, and the build may be paused.
#[wasm_bindgen]
pub struct Building {
    build: Build<SourceClip>,
}

#[wasm_bindgen]
impl Building {
    /// Processes a few clips. Returns whether steps remain before [`Building::finish`].
    ///
    /// # Errors
    /// If nothing can be built.
    pub fn step(&mut self, listener: &Progress) -> Result<bool, EngineError> {
        let come = self.build.step(&Sequential).map_err(EngineError::unusable_file)?;
        if let Some(p) = come {
            listener.progress(p.stage.name(), p.done, p.total);
        }
        Ok(come.is_some())
    }

    /// Returns the database, after the last step.
    ///
    /// # Errors
    /// If nothing could be built.
    pub fn finish(self, listener: &Progress) -> Result<Built, EngineError> {
        listener.progress("indexing", 0, 1);
        let sources = self.build.clips().iter().map(|c| (c.name.clone(), c.source.clone())).collect();
        let (database, report) = self.build.finish(&Sequential).map_err(EngineError::unusable_file)?;
        let built = Built::new(database, refused(&report, &sources), bimodal_styles(&report, &sources));
        listener.progress("indexing", 1, 1);
        Ok(built)
    }
}

/// Returns the path of the clip with this name.
fn path(name: &String, sources: &HashMap<String, String>) -> String {
    sources.get(name).unwrap_or(name).clone()
}

/// Returns path and reason of every clip that the build refused.
fn refused(report: &BuildReport, sources: &HashMap<String, String>) -> Vec<String> {
    let entry = |clip: &build::ClipReport| Some([path(&clip.name, sources), sentence(clip.refused.as_ref()?)]);
    report.refused().filter_map(entry).flatten().collect()
}

/// Returns the bimodal styles, with paths in place of the names of clips.
fn bimodal_styles(report: &BuildReport, sources: &HashMap<String, String>) -> Vec<BimodalStyle> {
    let mut found = report.bimodal_styles.clone();
    found.iter_mut().flat_map(|f| f.clips.iter_mut().flatten()).for_each(|name| *name = path(name, sources));
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_of_different_lengths_are_refused() {
        let texts = |count: usize| vec!["a".to_owned(); count];
        let of = |[paths, actions, styles, takes, licences]: [usize; 5]| {
            let takes = vec![-1; takes];
            Builder::new(texts(paths), texts(actions), texts(styles), takes, texts(licences), None).is_ok()
        };
        assert!(of([3; 5]));
        for list in 0..5 {
            for length in [2, 4] {
                let mut lengths = [3; 5];
                lengths[list] = length;
                assert!(!of(lengths), "{lengths:?}");
            }
        }
    }
}
