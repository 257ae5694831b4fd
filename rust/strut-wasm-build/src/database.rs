//! Databases that come from JavaScript.

use crate::labels::text;
use strut_core::database::Database;
use strut_formats::strutdb;

/// The database in a `.strutdb` file or in packed motions.
pub(crate) fn read_database(bytes: &[u8]) -> Result<Database, String> {
    let read = if bytes.starts_with(&strutdb::packed::MAGIC) {
        strutdb::packed::read_database(bytes)
    } else {
        strutdb::read(bytes).map(|contents| contents.database)
    };
    read.map_err(text)
}
