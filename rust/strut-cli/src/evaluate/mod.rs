//! `strut evaluate`: errors of styled motion against real motion, and its cost.

mod args;

use crate::failure::{Failure, Outcome};
use crate::print::{print, print_warnings};
use crate::progress::Bar;
pub(crate) use args::Args;
use strut_tasks::evaluate::{Protocol, evaluate};
use strut_tasks::files::Outputs;

pub(crate) fn run(args: &Args) -> Outcome {
    Outputs::check([args.json.as_deref(), args.curves.as_deref()].into_iter().flatten())?;
    if args.progress && args.protocol == Protocol::OffDatabase {
        return Err(Failure::usage("--progress needs --protocol loo"));
    }
    let evaluation = Bar::watching(|on_progress| evaluate(&args.request(command_line()), on_progress))?;
    for clip in &evaluation.left_out {
        print_warnings(&format!("warning: left out {}: {}\n", clip.file, clip.reason));
    }
    if let Some(note) = evaluation.note() {
        print_warnings(&format!("warning: {note}\n"));
    }
    let mut outputs = Outputs::default();
    outputs.stage_json(args.json.as_deref(), &evaluation.report)?;
    if let (Some(target), Some(curves)) = (&args.curves, &evaluation.curves) {
        outputs.stage(target, &serde_json::to_vec(curves).map_err(Failure::new)?)?;
    }
    outputs.commit()?;
    print(&if args.progress { evaluation.report.progress_markdown() } else { evaluation.report.markdown() });
    evaluation.conclude();
    Ok(())
}

/// Returns the arguments as typed, which are recorded with results and checkpoints.
fn command_line() -> String {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    format!("strut {}", arguments.join(" "))
}
