//! Clips and databases in files.

use crate::failure::{Failure, Outcome};
use crate::files::{self, print_warnings};
use crate::search::Search;
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;
use strut_core::database::Database;
use strut_core::search::Index;
use strut_core::transfer::Model;
use strut_formats::corpus::Clip;
use strut_formats::{bvh, strutdb};

/// The clip in a BVH file.
pub(crate) fn read_clip(path: &Path) -> Outcome<Clip> {
    Clip::parse(&files::read(path, bvh::MAX_BYTES)?).map_err(|reason| Failure::in_file(path, reason))
}

/// The database in a file.
pub(crate) fn read_database(path: &Path) -> Outcome<Database> {
    strutdb::read(&files::read(path, strutdb::MAX_BYTES)?).map_err(|reason| Failure::in_file(path, reason))
}

/// The search index of the plan in a database's file, if there is a good one.
pub(crate) fn stored_index(bytes: &[u8], database: &Database) -> Option<Index> {
    Index::from_plan(database, &strutdb::read_plan(bytes)?).ok()
}

/// The database in a file, ready for use and to be searched so; says so if its search index had to be made.
pub(crate) fn read_model(path: &Path, search: Search) -> Outcome<Model> {
    let bytes = files::read(path, strutdb::MAX_BYTES)?;
    let database = strutdb::read(&bytes).map_err(|reason| Failure::in_file(path, reason))?;
    let index = stored_index(&bytes, &database).unwrap_or_else(|| {
        let begin = Instant::now();
        let index = Index::build(&database);
        let (path, ms) = (path.display(), begin.elapsed().as_millis());
        print_warnings(&format!(
            "note: {path} has no search index of this version; it was built in {ms} ms. 'strut build-db' stores one.\n"
        ));
        index
    });
    Ok(Model::with_index(Arc::new(database), search.of(index)))
}
