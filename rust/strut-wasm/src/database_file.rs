//! Databases from files.

use crate::database::Database;
use js_sys::Uint8Array;
use strut_core::transfer::Model;
use strut_formats::container::Source;
use strut_formats::strutdb::{self, StrutdbError};
use strut_wasm_common::{Bytes, EngineError, SlicedFile, Slices};
use wasm_bindgen::prelude::wasm_bindgen;

/// Memory that a database and its targets may take, of the 4 GiB that a package can address: the rest is for motions, their
/// results, and what lies between.
const MOST_BYTES: u64 = 3_000_000_000;

#[wasm_bindgen]
impl Database {
    /// A `.strutdb` file. Its search index is made here if the file has none.
    ///
    /// # Errors
    /// With what is wrong with the bytes.
    #[wasm_bindgen(js_name = fromBytes)]
    pub fn from_bytes(bytes: Uint8Array) -> Result<Self, EngineError> {
        read(&Bytes(bytes))
    }

    /// The same of a file of so many bytes that is read in slices: it need not be in memory as a whole.
    ///
    /// # Errors
    /// With what is wrong with the bytes, or if some cannot be read.
    #[wasm_bindgen(js_name = fromSlices)]
    pub fn from_slices(file: SlicedFile, bytes: f64) -> Result<Self, EngineError> {
        // The cast saturates: a file of more bytes than can be counted is refused for its length.
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
                "Build it of fewer takes or styles, or at a lower rate, as with 'strut build-db --rate 30'."
            }
            _ => "Copy the file once more, or build the database again with 'strut build-db'.",
        };
        EngineError::bad_file(error, hint)
    })?;
    Ok(Database::of(Model::of(catalogue)))
}
