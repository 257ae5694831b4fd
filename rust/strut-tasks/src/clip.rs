//! Reading of clips and databases from files.

use crate::error::{Outcome, TaskError};
use crate::files;
use crate::search::Search;
use std::path::Path;
use std::time::{Duration, Instant};
use strut_core::catalogue::Catalogue;
use strut_core::database::Database;
use strut_core::search::Index;
use strut_core::transfer::Model;
use strut_formats::bvh;
use strut_formats::corpus::Clip;
use strut_formats::strutdb::{self, Contents};

/// Reads the clip in a BVH file.
///
/// # Errors
/// If it cannot be read.
pub fn read_clip(path: &Path) -> Outcome<Clip> {
    Clip::parse(&files::read(path, bvh::MAX_BYTES)?).map_err(|reason| TaskError::in_file(path, reason))
}

/// Reads the database in a file.
///
/// # Errors
/// If it cannot be read.
pub fn read_database(path: &Path) -> Outcome<Database> {
    Ok(read_contents(path)?.database)
}

/// Reads the database in a file with the plan of its search index.
///
/// # Errors
/// If it cannot be read.
pub fn read_contents(path: &Path) -> Outcome<Contents> {
    strutdb::read(&files::read(path, strutdb::KIND.max_bytes)?).map_err(|reason| TaskError::in_file(path, reason))
}

/// A database ready for use.
pub struct Opened {
    /// The database with its search index.
    pub model: Model,
    /// Time that it took to build the index, if the file has no index of this version.
    pub indexed_in: Option<Duration>,
}

impl Opened {
    /// Opens the contents of a file with this search.
    pub fn new(contents: Contents, search: Search) -> Self {
        let Contents { database, plan } = contents;
        let planned = plan.and_then(|plan| Index::from_plan(&database, plan).ok());
        let mut indexed_in = None;
        let index = planned.unwrap_or_else(|| {
            let begin = Instant::now();
            let index = Index::build(&database);
            indexed_in = Some(begin.elapsed());
            index
        });
        Self { model: Model::of(Catalogue::with_index(database, search.of(index))), indexed_in }
    }
}
