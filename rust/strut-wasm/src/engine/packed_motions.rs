//! Handle of packed motions.

use crate::common::EngineError;
use strut_core::database::Database;
use strut_core::humanoid::HumanoidMotion;
use strut_formats::strutdb::{StrutdbError, packed};
use wasm_bindgen::prelude::wasm_bindgen;

/// A database and inputs in the packed format. Their bytes are in memory once, however many objects are opened from
/// them.
#[wasm_bindgen]
pub struct PackedMotions {
    bytes: Vec<u8>,
}

#[wasm_bindgen]
impl PackedMotions {
    /// Creates the handle from the bytes of a file. They are checked when an object is opened.
    #[wasm_bindgen(constructor)]
    pub fn new(bytes: Vec<u8>) -> Self {
        Self { bytes }
    }

    /// Returns the names of the inputs, the default first.
    ///
    /// # Errors
    /// If the bytes are invalid.
    pub fn inputs(&self) -> Result<Vec<String>, EngineError> {
        packed::input_names(&self.bytes).map_err(unpackable)
    }
}

impl PackedMotions {
    /// The database.
    ///
    /// # Errors
    /// With what is wrong with the bytes.
    pub(crate) fn database(&self) -> Result<Database, EngineError> {
        packed::read_database(&self.bytes).map_err(unpackable)
    }

    /// Returns the input with this name.
    ///
    /// # Errors
    /// If there is no input with this name, or the bytes are invalid.
    pub(crate) fn input(&self, name: &str) -> Result<HumanoidMotion, EngineError> {
        let motion = packed::read_input(&self.bytes, name).map_err(unpackable)?;
        motion.ok_or_else(|| EngineError::bad_input(format!("there is no built-in input '{name:.40}'")))
    }
}

/// Packed motions that cannot be read.
fn unpackable(error: StrutdbError) -> EngineError {
    EngineError::bad_file(error, "Reload the page; if that does not help, the site was not deployed completely.")
}
