//! Handle of a built database.

use crate::common::sentence;
use strut_core::database::build::Doubt;
use strut_core::database::{BimodalStyle, Database};
use strut_core::search::Index;
use strut_formats::strutdb;
use wasm_bindgen::prelude::wasm_bindgen;

/// A built database.
#[wasm_bindgen]
pub struct Built {
    database: Database,
    file: Vec<u8>,
    refused: Vec<String>,
    bimodal_styles: Vec<BimodalStyle>,
    doubt: String,
}

impl Built {
    /// Creates the handle. `bimodal_styles` names clips by their paths.
    pub(crate) fn new(database: Database, refused: Vec<String>, bimodal_styles: Vec<BimodalStyle>) -> Self {
        let file = strutdb::write(&database, &Index::build(&database).plan(), strut_formats::GENERATOR);
        Self { database, file, refused, bimodal_styles, doubt: String::new() }
    }

    /// Adds the reason why the style of one clip may look wrong.
    pub(crate) fn with_doubt(self, doubt: Option<Doubt>) -> Self {
        Self { doubt: doubt.map_or_else(String::new, sentence), ..self }
    }
}

#[wasm_bindgen]
impl Built {
    /// Returns the `.strutdb` file and releases it: a second call returns an empty array.
    #[wasm_bindgen(js_name = takeFile)]
    pub fn take_file(&mut self) -> Vec<u8> {
        std::mem::take(&mut self.file)
    }

    /// Returns the number of clips.
    pub fn clips(&self) -> usize {
        self.database.clips.len()
    }

    /// Returns the number of frames.
    pub fn frames(&self) -> usize {
        self.database.frames()
    }

    /// Returns the names of the actions.
    pub fn actions(&self) -> Vec<String> {
        self.database.actions.clone()
    }

    /// Returns the names of the styles.
    pub fn styles(&self) -> Vec<String> {
        self.database.styles.clone()
    }

    /// Returns the name of the neutral style.
    pub fn neutral(&self) -> String {
        self.database.styles[usize::from(self.database.neutral)].clone()
    }

    /// Returns path and reason of every refused clip, alternately.
    pub fn refused(&self) -> Vec<String> {
        self.refused.clone()
    }

    /// Returns why the style of one clip may look wrong, as a sentence; empty if there is no such warning.
    pub fn doubt(&self) -> String {
        self.doubt.clone()
    }

    /// Returns the clips of bimodal styles: action, style, cluster (0 or 1) and path of each, in turn.
    #[wasm_bindgen(js_name = twoManners)]
    pub fn bimodal_styles(&self) -> Vec<String> {
        let clips = |found: &BimodalStyle| {
            let BimodalStyle { action, style, clips, .. } = found;
            let entry =
                |manner: usize, path: &String| [action.clone(), style.clone(), manner.to_string(), path.clone()];
            let of = |manner: usize| clips[manner].iter().flat_map(move |path| entry(manner, path));
            of(0).chain(of(1)).collect::<Vec<_>>()
        };
        self.bimodal_styles.iter().flat_map(clips).collect()
    }
}
