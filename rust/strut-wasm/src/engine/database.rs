//! Handle of a database.

use crate::common::{EngineError, offsets_of};
use crate::engine::packed_motions::PackedMotions;
use std::sync::Arc;
use strut_core::transfer::Model;
use wasm_bindgen::prelude::wasm_bindgen;

/// A database with its search index, shared with all objects that are created from it.
#[wasm_bindgen]
pub struct Database {
    model: Arc<Model>,
}

#[wasm_bindgen]
impl Database {
    /// Reads the database of packed motions.
    ///
    /// # Errors
    /// If the bytes are invalid.
    #[wasm_bindgen(js_name = fromPacked)]
    pub fn from_packed(motions: &PackedMotions) -> Result<Self, EngineError> {
        motions.database().map(Self::new)
    }

    /// Returns the number of rows.
    pub fn frames(&self) -> usize {
        self.model.catalogue().frames()
    }

    /// Returns the frame rate, frames per second.
    #[wasm_bindgen(js_name = rateHz)]
    pub fn rate_hz(&self) -> f32 {
        self.model.catalogue().rate_hz
    }

    /// Returns the names of the actions.
    pub fn actions(&self) -> Vec<String> {
        self.model.catalogue().actions.clone()
    }

    /// Returns the names of the styles.
    pub fn styles(&self) -> Vec<String> {
        self.model.catalogue().styles.clone()
    }

    /// Returns the index of the neutral style.
    pub fn neutral(&self) -> u16 {
        self.model.catalogue().neutral
    }

    /// Returns the offset of each joint from its parent in the T-pose, metres: 21 × xyz.
    pub fn proportions(&self) -> Vec<f32> {
        offsets_of(&self.model.catalogue().proportions)
    }

    /// Returns for each class the index of its action, the index of its style and its number of rows.
    pub fn classes(&self) -> Vec<u32> {
        let classes = self.model.catalogue().classes();
        classes.iter().flat_map(|c| [c.action.into(), c.style.into(), c.rows.len() as u32]).collect()
    }
}

impl Database {
    pub(crate) fn new(database: strut_core::database::Database) -> Self {
        Self { model: Arc::new(Model::new(database)) }
    }

    #[cfg(feature = "files")]
    pub(crate) fn of(model: Model) -> Self {
        Self { model: Arc::new(model) }
    }

    pub(crate) fn model(&self) -> &Arc<Model> {
        &self.model
    }
}
