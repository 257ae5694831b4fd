//! Opening of databases.

use crate::print::print_warnings;
use std::path::Path;
use strut_core::transfer::Model;
use strut_tasks::Outcome;
use strut_tasks::clip::{Opened, read_contents};
use strut_tasks::search::Search;

/// Opens the database in a file with this search. Prints a message if its search index had to be built.
pub(crate) fn read_model(path: &Path, search: Search) -> Outcome<Model> {
    let Opened { model, indexed_in } = Opened::new(read_contents(path)?, search);
    if let Some(took) = indexed_in {
        let (path, ms) = (path.display(), took.as_millis());
        print_warnings(&format!(
            "note: {path} has no search index for this version of Strut; it was built in {ms} ms. 'strut build-db' \
             stores \
             it in the file.\n"
        ));
    }
    Ok(model)
}
