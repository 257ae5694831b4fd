//! Databases as bytes from JavaScript.

use crate::common::{Bytes, EngineError};
use js_sys::Uint8Array;
use strut_core::database::Database;
use strut_formats::strutdb::{self, packed};

/// Hint for a damaged file.
const HINT: &str = "Copy the file once more, or build the database again with 'strut build-db'.";

/// Reads the database in a `.strutdb` file or in packed motions.
///
/// # Errors
/// If the bytes are invalid.
pub fn read_database(bytes: Uint8Array) -> Result<Database, EngineError> {
    let mut beginning = [0; packed::MAGIC.len()];
    let is_packed = bytes.length() as usize >= beginning.len() && {
        bytes.subarray(0, beginning.len() as u32).copy_to(&mut beginning);
        beginning == packed::MAGIC
    };
    let read = if is_packed {
        packed::read_database(&bytes.to_vec())
    } else {
        strutdb::read(&Bytes(bytes)).map(|contents| contents.database)
    };
    read.map_err(|error| EngineError::bad_file(error, HINT))
}
