//! Handle of a database.

use crate::error::EngineError;
use js_sys::Uint8Array;
use std::sync::Arc;
use strut_core::math::Vec3;
use strut_core::search::Index;
use strut_core::transfer::Model;
use strut_formats::strutdb::{self, Source, StrutdbError, packed};
use wasm_bindgen::prelude::wasm_bindgen;

/// A database with its search index; shared with all that was made from it.
#[wasm_bindgen]
pub struct Database {
    model: Arc<Model>,
}

#[wasm_bindgen]
impl Database {
    /// The database of packed motions.
    ///
    /// # Errors
    /// With what is wrong with the bytes.
    #[wasm_bindgen(js_name = fromPacked)]
    pub fn from_packed(bytes: Vec<u8>) -> Result<Self, EngineError> {
        packed::read_database(&bytes).map(Self::new).map_err(unpackable)
    }

    /// A `.strutdb` file. Its search index is made here if the file has none.
    ///
    /// # Errors
    /// With what is wrong with the bytes.
    #[wasm_bindgen(js_name = fromBytes)]
    pub fn from_bytes(bytes: Uint8Array) -> Result<Self, EngineError> {
        let mut contents = strutdb::read(&Bytes(bytes)).map_err(|e| {
            EngineError::bad_file(e, "Copy the file once more, or build the database again with 'strut build-db'.")
        })?;
        let index = contents.planned_index().unwrap_or_else(|| Index::build(&contents.database));
        Ok(Self { model: Arc::new(Model::with_index(contents.database, index)) })
    }

    /// Number of rows.
    pub fn frames(&self) -> usize {
        self.model.database().frames()
    }

    /// Frames per second.
    #[wasm_bindgen(js_name = rateHz)]
    pub fn rate_hz(&self) -> f32 {
        self.model.database().rate_hz
    }

    /// Names of the actions.
    pub fn actions(&self) -> Vec<String> {
        self.model.database().actions.clone()
    }

    /// Names of the styles.
    pub fn styles(&self) -> Vec<String> {
        self.model.database().styles.clone()
    }

    /// Index of the neutral style.
    pub fn neutral(&self) -> u16 {
        self.model.database().neutral
    }

    /// Offset of each joint from its parent in the T-pose, metres: 21 × xyz.
    pub fn proportions(&self) -> Vec<f32> {
        self.model.database().proportions.offsets.iter().flat_map(Vec3::to_array).collect()
    }

    /// For each class the index of its action, the index of its style and its number of rows.
    pub fn classes(&self) -> Vec<u32> {
        let classes = self.model.database().classes();
        classes.iter().flat_map(|c| [c.action.into(), c.style.into(), c.rows.len() as u32]).collect()
    }
}

/// Bytes in the heap of JavaScript: memory that this module takes is never given back.
struct Bytes(Uint8Array);

impl Source for Bytes {
    fn len(&self) -> usize {
        self.0.length() as usize
    }

    fn copy(&self, begin: usize, to: &mut [u8]) {
        self.0.subarray(begin as u32, (begin + to.len()) as u32).copy_to(to);
    }
}

impl Database {
    pub(crate) fn new(database: strut_core::database::Database) -> Self {
        Self { model: Arc::new(Model::new(database)) }
    }

    pub(crate) fn model(&self) -> &Arc<Model> {
        &self.model
    }
}

/// Packed motions that cannot be read.
pub(crate) fn unpackable(error: StrutdbError) -> EngineError {
    EngineError::bad_file(error, "Reload the page; if that does not help, the site was not deployed completely.")
}
