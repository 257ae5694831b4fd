//! `strut add-style`: adds a style to a database from one clip.

use crate::print::{print, print_warnings};
use std::path::PathBuf;
use strut_core::database::build::add_style_of;
use strut_core::registration;
use strut_core::search::Index;
use strut_formats::corpus::{Entry, Labels};
use strut_formats::strutdb;
use strut_tasks::clip::{read_clip, read_database};
use strut_tasks::files::Outputs;
use strut_tasks::suggestion::unknown;
use strut_tasks::threads::ThreadPool;
use strut_tasks::{Outcome, TaskError};

/// Make a single clip a style of a database
///
/// The clip is registered with the clips of its action; the clips of other actions do not change. The action given with
/// --action is used even if the clip looks different; a note then says so.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// The database
    #[arg(long, value_name = "DB")]
    db: PathBuf,
    /// The .bvh file, for example a walk of at least three seconds
    #[arg(long, value_name = "IN.bvh")]
    input: PathBuf,
    /// Name of the style
    #[arg(long, value_name = "NAME")]
    style: String,
    /// Action of the clip [default: the best-matching action of the database]
    #[arg(long, value_name = "NAME")]
    action: Option<String>,
    /// The database to write
    #[arg(short, long, value_name = "DB")]
    output: PathBuf,
}

pub(crate) fn run(args: &Args) -> Outcome {
    Outputs::check([args.output.as_path()])?;
    let db = read_database(&args.db)?;
    let clip = read_clip(&args.input)?;
    let path = args.input.display().to_string();
    let labels = Labels { action: String::new(), style: args.style.clone(), take: Some(1) };
    let clip = Entry { path, labels, licence: String::new() }.source_clip(&clip, &db.proportions);
    let index_of = |name: &String| {
        let index = db.actions.iter().position(|known| known == name);
        index.map(|index| index as u16).ok_or_else(|| TaskError::new(unknown("action", name, &db.actions)))
    };
    let action = args.action.as_ref().map(index_of).transpose()?;
    let added = add_style_of(&db, &clip, action, &registration::Options::default(), &ThreadPool)
        .map_err(|reason| TaskError::in_file(&args.input, reason))?;
    let mut outputs = Outputs::default();
    let plan = Index::build(&added.database).plan();
    outputs.stage(&args.output, &strutdb::write(&added.database, &plan, strut_formats::GENERATOR))?;
    outputs.commit()?;
    if let Some(doubt) = &added.doubt {
        print_warnings(&format!("note: {}: {doubt}\n", args.input.display()));
    }
    let action = &added.database.actions[usize::from(added.action)];
    let output = args.output.display();
    print(&format!(
        "{output}: added style '{}' to action '{action}', registration cost {:.1}\n",
        args.style, added.cost
    ));
    Ok(())
}
