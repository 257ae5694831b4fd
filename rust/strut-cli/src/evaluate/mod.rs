//! `strut evaluate`: errors of styled motion against real motion, and its cost.

mod args;

use crate::print::{print, print_warnings};
use crate::progress::Bar;
pub(crate) use args::Args;
use strut_tasks::evaluate::{Protocol, Request, evaluate};
use strut_tasks::files::Outputs;
use strut_tasks::{Outcome, TaskError};

pub(crate) fn run(args: &Args) -> Outcome {
    Outputs::check([args.request.json.as_deref(), args.curves.as_deref()].into_iter().flatten())?;
    if args.progress && args.request.protocol == Protocol::OffDatabase {
        return Err(TaskError::usage("--progress needs --protocol loo"));
    }
    let request = Request { wants_curves: args.curves.is_some(), command: command_line(), ..args.request.clone() };
    let evaluation = Bar::watching(|on_progress| evaluate(&request, on_progress))?;
    for clip in &evaluation.left_out {
        print_warnings(&format!("warning: left out {}: {}\n", clip.file, clip.reason));
    }
    if let Some(note) = evaluation.note() {
        print_warnings(&format!("warning: {note}\n"));
    }
    let mut outputs = Outputs::default();
    outputs.stage_json(args.request.json.as_deref(), &evaluation.report)?;
    if let (Some(target), Some(curves)) = (&args.curves, &evaluation.curves) {
        outputs.stage(target, &serde_json::to_vec(curves).map_err(TaskError::new)?)?;
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
