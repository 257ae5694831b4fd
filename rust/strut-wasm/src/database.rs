//! Handle of a database.

use js_sys::Uint8Array;
use std::sync::Arc;
use strut_core::transfer::Model;
use strut_formats::container::Source;
use strut_formats::strutdb::{self, StrutdbError, packed};
use strut_wasm_common::{Bytes, EngineError, SlicedFile, Slices, offsets_of};
use wasm_bindgen::prelude::wasm_bindgen;

/// Memory that a database and its targets may take, of the 4 GiB that a package can address: the rest is for motions, their
/// results, and what lies between.
const MOST_BYTES: u64 = 3_000_000_000;

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
        Self::read(&Bytes(bytes))
    }

    /// The same of a file that is read in slices: it need not be in memory as a whole.
    ///
    /// # Errors
    /// With what is wrong with the bytes, or if some cannot be read.
    #[wasm_bindgen(js_name = fromSlices)]
    pub fn from_slices(file: SlicedFile) -> Result<Self, EngineError> {
        let slices = Slices::new(file);
        let database = Self::read(&slices);
        if slices.failed() {
            return Err(EngineError::bad_file(
                "the file could not be read",
                "Open it again, or build a smaller database.",
            ));
        }
        database
    }

    /// Number of rows.
    pub fn frames(&self) -> usize {
        self.model.catalogue().frames()
    }

    /// Frames per second.
    #[wasm_bindgen(js_name = rateHz)]
    pub fn rate_hz(&self) -> f32 {
        self.model.catalogue().rate_hz
    }

    /// Names of the actions.
    pub fn actions(&self) -> Vec<String> {
        self.model.catalogue().actions.clone()
    }

    /// Names of the styles.
    pub fn styles(&self) -> Vec<String> {
        self.model.catalogue().styles.clone()
    }

    /// Index of the neutral style.
    pub fn neutral(&self) -> u16 {
        self.model.catalogue().neutral
    }

    /// Offset of each joint from its parent in the T-pose, metres: 21 × xyz.
    pub fn proportions(&self) -> Vec<f32> {
        offsets_of(&self.model.catalogue().proportions)
    }

    /// For each class the index of its action, the index of its style and its number of rows.
    pub fn classes(&self) -> Vec<u32> {
        let classes = self.model.catalogue().classes();
        classes.iter().flat_map(|c| [c.action.into(), c.style.into(), c.rows.len() as u32]).collect()
    }
}

impl Database {
    pub(crate) fn new(database: strut_core::database::Database) -> Self {
        Self { model: Arc::new(Model::new(database)) }
    }

    fn read(file: &dyn Source) -> Result<Self, EngineError> {
        let catalogue = strutdb::read_catalogue(file, Some(MOST_BYTES)).map_err(|error| {
            let hint = match error {
                StrutdbError::Memory { .. } => {
                    "Build it of fewer takes or styles, or at a lower rate, as with 'strut build-db --rate 30'."
                }
                _ => "Copy the file once more, or build the database again with 'strut build-db'.",
            };
            EngineError::bad_file(error, hint)
        })?;
        Ok(Self { model: Arc::new(Model::of(catalogue)) })
    }

    pub(crate) fn model(&self) -> &Arc<Model> {
        &self.model
    }
}

/// Packed motions that cannot be read.
pub(crate) fn unpackable(error: StrutdbError) -> EngineError {
    EngineError::bad_file(error, "Reload the page; if that does not help, the site was not deployed completely.")
}
