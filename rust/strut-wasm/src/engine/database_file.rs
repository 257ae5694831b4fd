//! Databases from files.

use crate::common::{Bytes, EngineError, SlicedFile, Slices};
use crate::engine::database::Database;
use js_sys::Uint8Array;
use strut_core::transfer::Model;
use strut_formats::container::Source;
use strut_formats::strutdb::{self, StrutdbError};
use wasm_bindgen::prelude::wasm_bindgen;

/// Memory limit of a database and its targets, of the 4 GiB address space of a package. The rest is for motions and
/// results.
const MOST_BYTES: u64 = 3_000_000_000;

#[wasm_bindgen]
impl Database {
    /// Reads a `.strutdb` file. Builds the search index if the file has none.
    ///
    /// # Errors
    /// If the bytes are invalid.
    #[wasm_bindgen(js_name = fromBytes)]
    pub fn from_bytes(bytes: Uint8Array) -> Result<Self, EngineError> {
        read(&Bytes(bytes))
    }

    /// Reads a `.strutdb` file of `bytes` bytes in slices, so that it need not be in memory as a whole.
    ///
    /// # Errors
    /// If the bytes are invalid, or some cannot be read.
    #[wasm_bindgen(js_name = fromSlices)]
    pub fn from_slices(file: SlicedFile, bytes: f64) -> Result<Self, EngineError> {
        // The cast saturates; a file of that size is refused for its length.
        let slices = Slices::new(file, bytes as usize);
        let database = read(&slices);
        if slices.failed() {
            return Err(EngineError::bad_file(
                "the file could not be read",
                "Open it again, or build a smaller database.",
            ));
        }
        database
    }
}

fn read(file: &dyn Source) -> Result<Database, EngineError> {
    let catalogue = strutdb::read_catalogue(file, Some(MOST_BYTES)).map_err(|error| {
        let hint = match error {
            StrutdbError::Memory { .. } => {
                "Build it from fewer takes or styles, or at a lower rate, as with 'strut build-db --rate 30'."
            }
            _ => "Copy the file once more, or build the database again with 'strut build-db'.",
        };
        EngineError::bad_file(error, hint)
    })?;
    Ok(Database::of(Model::of(catalogue)))
}
