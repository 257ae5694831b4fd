//! `strut demo-db`: writes the built-in motions to files.

use crate::demo_report;
use crate::print::print;
use std::path::PathBuf;
use strut_core::search::Index;
use strut_formats::bvh::{self, Bvh};
use strut_formats::strutdb;
use strut_tasks::counted;
use strut_tasks::files::Outputs;
use strut_tasks::{Outcome, TaskError};

/// Write the built-in procedural database
#[derive(clap::Args)]
pub(crate) struct Args {
    /// The database to write
    #[arg(short, long, value_name = "DB")]
    output: PathBuf,
    /// Also write the clips as BVH files named {action}_{style}_{take}.bvh into this folder
    #[arg(long, value_name = "DIR")]
    bvh: Option<PathBuf>,
    /// Write the smaller set that the web page loads: 60 Hz, every action, fewer takes, no transitions
    #[arg(long)]
    page: bool,
    /// Write measures of the motions as Markdown into this file
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// A folder with `xia/` and `bandai-namco-2/`: the report compares the motions with these recordings
    #[arg(long, value_name = "DIR", requires = "report")]
    recordings: Option<PathBuf>,
}

pub(crate) fn run(args: &Args) -> Outcome {
    Outputs::check([Some(args.output.as_path()), args.report.as_deref()].into_iter().flatten())?;
    let db = if args.page { strut_demo::database() } else { strut_demo::full_database() }.map_err(TaskError::new)?;
    let mut outputs = Outputs::default();
    let mut clips = 0;
    if let Some(folder) = &args.bvh {
        let full = || strut_demo::full_clips().into_iter().map(|c| c.clip).collect();
        let motions = if args.page { strut_demo::clips() } else { full() };
        std::fs::create_dir_all(folder).map_err(|e| TaskError::io(folder, &e))?;
        for clip in motions {
            let path = folder.join(format!("{}_{}_{:03}.bvh", clip.action, clip.style, clip.take));
            let file = Bvh::from_humanoid(&clip.motion).map_err(|e| TaskError::in_file(&path, e))?;
            outputs.stage(&path, &bvh::write(&file))?;
            clips += 1;
        }
    }
    if let Some(path) = &args.report {
        outputs.stage(path, demo_report::report(args.recordings.as_deref())?.as_bytes())?;
    }
    outputs.stage(&args.output, &strutdb::write(&db, &Index::build(&db).plan(), strut_formats::GENERATOR))?;
    outputs.commit()?;
    print(&format!(
        "{}: {}, {} at {} Hz, styles {}\n",
        args.output.display(),
        counted(db.clips.len(), "clip"),
        counted(db.frames(), "frame"),
        db.rate_hz,
        db.styles.join(", ")
    ));
    if let Some(folder) = &args.bvh {
        print(&format!("{}: {clips} BVH files\n", folder.display()));
    }
    Ok(())
}
