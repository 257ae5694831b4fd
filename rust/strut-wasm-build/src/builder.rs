//! Handle of a build: clips go in one at a time, a database comes out.

use crate::built::Built;
use crate::clip::bind;
use crate::progress::Progress;
use std::collections::HashMap;
use strut_core::database::TwoManners;
use strut_core::database::build::{self, Build, BuildOptions, BuildReport, SourceClip};
use strut_core::humanoid::Proportions;
use strut_core::incremental::IncrementalJob;
use strut_core::parallel::Sequential;
use strut_formats::corpus::{self, Clip, Entry, Labels};
use strut_wasm_common::{EngineError, sentence};
use wasm_bindgen::prelude::wasm_bindgen;

/// A build that takes its clips one at a time: what a file has besides its motion is gone when [`Builder::add`] returns.
#[wasm_bindgen]
pub struct Builder {
    entries: Vec<Entry>,
    neutral: Option<String>,
    body: Option<Proportions>,
    clips: Vec<SourceClip>,
}

#[wasm_bindgen]
impl Builder {
    /// A build of these files; `takes` below 0 are counted. Without `neutral` the style is found by its name.
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

    /// Paths in the order in which the files must be added: the first that can be read gives the database its body.
    pub fn order(&self) -> Vec<String> {
        let styles: Vec<&str> = self.entries.iter().map(|e| e.labels.style.as_str()).collect();
        let order = corpus::body_order(&styles, self.neutral.as_deref());
        order.into_iter().map(|i| self.entries[i].path.clone()).collect()
    }

    /// Adds a file. `roles` as for `Clip`.
    ///
    /// # Errors
    /// With why it cannot be used; the others can still be built without it.
    pub fn add(&mut self, path: &str, bytes: &[u8], roles: Option<Vec<i32>>) -> Result<(), EngineError> {
        let at = self.entries.binary_search_by(|e| e.path.as_str().cmp(path));
        let unknown = |_| EngineError::bad_input(format!("'{path}' is not among the files of this build"));
        let entry = &self.entries[at.map_err(unknown)?];
        let clip = Clip::with_binding(bytes, |motion| bind(motion, roles.as_deref()));
        let clip = clip.map_err(EngineError::unusable_file)?;
        let body = self.body.get_or_insert(clip.binding.proportions);
        self.clips.push(entry.source_clip(&clip, body));
        Ok(())
    }

    /// Begins to build the database of what was added.
    ///
    /// # Errors
    /// If nothing can be built from it.
    pub fn begin(mut self, rate_hz: f32) -> Result<Building, EngineError> {
        // As the command reads them: by their paths.
        self.clips.sort_by(|a, b| a.source.cmp(&b.source));
        corpus::name_apart(&mut self.clips);
        let options = BuildOptions { rate_hz, neutral: self.neutral, ..BuildOptions::default() };
        Ok(Building { build: Build::new(self.clips, &options).map_err(EngineError::unusable_file)? })
    }
}

/// A build that goes on in steps, between which messages are heard and the build may be left for a while.
#[wasm_bindgen]
pub struct Building {
    build: Build<SourceClip>,
}

#[wasm_bindgen]
impl Building {
    /// Goes on by a few clips; whether anything was left but to finish.
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

    /// The database, once nothing is left.
    ///
    /// # Errors
    /// If nothing could be built.
    pub fn finish(self, listener: &Progress) -> Result<Built, EngineError> {
        listener.progress("indexing", 0, 1);
        let sources = self.build.clips().iter().map(|c| (c.name.clone(), c.source.clone())).collect();
        let (database, report) = self.build.finish(&Sequential).map_err(EngineError::unusable_file)?;
        let built = Built::new(database, refused(&report, &sources), two_manners(&report, &sources));
        listener.progress("indexing", 1, 1);
        Ok(built)
    }
}

/// Path of the clip of a name.
fn path(name: &String, sources: &HashMap<String, String>) -> String {
    sources.get(name).unwrap_or(name).clone()
}

/// Path of and reason for every clip that the build left out.
fn refused(report: &BuildReport, sources: &HashMap<String, String>) -> Vec<String> {
    let entry = |clip: &build::ClipReport| Some([path(&clip.name, sources), sentence(clip.refused.as_ref()?)]);
    report.refused().filter_map(entry).flatten().collect()
}

/// The styles of two manners, with paths for the names of clips.
fn two_manners(report: &BuildReport, sources: &HashMap<String, String>) -> Vec<TwoManners> {
    let mut found = report.two_manners.clone();
    found.iter_mut().flat_map(|f| f.clips.iter_mut().flatten()).for_each(|name| *name = path(name, sources));
    found
}
