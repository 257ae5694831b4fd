//! Clips and databases in files.

use crate::failure::{Failure, Outcome};
use crate::files::{self, print_warnings};
use crate::search::Search;
use std::path::Path;
use std::time::Instant;
use strut_core::catalogue::Catalogue;
use strut_core::database::Database;
use strut_core::search::Index;
use strut_core::transfer::Model;
use strut_formats::bvh;
use strut_formats::corpus::Clip;
use strut_formats::strutdb::{self, Contents};

/// The clip in a BVH file.
pub(crate) fn read_clip(path: &Path) -> Outcome<Clip> {
    Clip::parse(&files::read(path, bvh::MAX_BYTES)?).map_err(|reason| Failure::in_file(path, reason))
}

/// The database in a file.
pub(crate) fn read_database(path: &Path) -> Outcome<Database> {
    Ok(read_contents(path)?.database)
}

/// The database in a file with the plan of its search index.
pub(crate) fn read_contents(path: &Path) -> Outcome<Contents> {
    strutdb::read(&files::read(path, strutdb::KIND.max_bytes)?).map_err(|reason| Failure::in_file(path, reason))
}

/// The database in a file, ready for use and to be searched so; says so if its search index had to be made.
pub(crate) fn read_model(path: &Path, search: Search) -> Outcome<Model> {
    let Contents { database, plan } = read_contents(path)?;
    let planned = plan.and_then(|plan| Index::from_plan(&database, plan).ok());
    let index = planned.unwrap_or_else(|| {
        let begin = Instant::now();
        let index = Index::build(&database);
        let (path, ms) = (path.display(), begin.elapsed().as_millis());
        print_warnings(&format!(
            "note: {path} has no search index of this version; it was built in {ms} ms. 'strut build-db' stores one.\n"
        ));
        index
    });
    Ok(Model::of(Catalogue::with_index(database, search.of(index))))
}
