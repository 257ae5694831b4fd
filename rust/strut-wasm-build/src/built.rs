//! Handle of a database that was built.

use strut_core::database::build::Doubt;
use strut_core::database::{Database, TwoManners};
use strut_core::search::Index;
use strut_formats::strutdb;
use strut_wasm_common::sentence;
use wasm_bindgen::prelude::wasm_bindgen;

/// A database that was built.
#[wasm_bindgen]
pub struct Built {
    database: Database,
    file: Vec<u8>,
    refused: Vec<String>,
    two_manners: Vec<TwoManners>,
    doubt: String,
}

impl Built {
    /// `two_manners` names clips by their paths.
    pub(crate) fn new(database: Database, refused: Vec<String>, two_manners: Vec<TwoManners>) -> Self {
        let file = strutdb::write(&database, &Index::build(&database).plan(), strut_formats::GENERATOR);
        Self { database, file, refused, two_manners, doubt: String::new() }
    }

    /// With why the style of one clip may look wrong.
    pub(crate) fn with_doubt(self, doubt: Option<Doubt>) -> Self {
        Self { doubt: doubt.map_or_else(String::new, sentence), ..self }
    }
}

#[wasm_bindgen]
impl Built {
    /// The `.strutdb` file, which is handed over: a second call gives none.
    #[wasm_bindgen(js_name = takeFile)]
    pub fn take_file(&mut self) -> Vec<u8> {
        std::mem::take(&mut self.file)
    }

    /// Number of clips.
    pub fn clips(&self) -> usize {
        self.database.clips.len()
    }

    /// Number of frames.
    pub fn frames(&self) -> usize {
        self.database.frames()
    }

    /// Names of the actions.
    pub fn actions(&self) -> Vec<String> {
        self.database.actions.clone()
    }

    /// Names of the styles.
    pub fn styles(&self) -> Vec<String> {
        self.database.styles.clone()
    }

    /// Name of the neutral style.
    pub fn neutral(&self) -> String {
        self.database.styles[usize::from(self.database.neutral)].clone()
    }

    /// Path of and reason for every clip that the build left out, in turn.
    pub fn refused(&self) -> Vec<String> {
        self.refused.clone()
    }

    /// Why the style of one clip may look wrong, a sentence; empty if nothing is known against it.
    pub fn doubt(&self) -> String {
        self.doubt.clone()
    }

    /// The clips of styles that are performed in two manners: action, style, manner (0 or 1) and path of each, in turn.
    #[wasm_bindgen(js_name = twoManners)]
    pub fn two_manners(&self) -> Vec<String> {
        let clips = |found: &TwoManners| {
            let TwoManners { action, style, clips, .. } = found;
            let entry =
                |manner: usize, path: &String| [action.clone(), style.clone(), manner.to_string(), path.clone()];
            let of = |manner: usize| clips[manner].iter().flat_map(move |path| entry(manner, path));
            of(0).chain(of(1)).collect::<Vec<_>>()
        };
        self.two_manners.iter().flat_map(clips).collect()
    }
}
