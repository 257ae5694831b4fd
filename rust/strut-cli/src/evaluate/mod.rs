//! `strut evaluate`: errors of styled motion against real motion, and its cost.

mod args;
mod checkpoint;
mod choices;
mod cross_validation;
mod curves;
mod off_database;
mod results;
mod settings;

use crate::corpus;
use crate::failure::{Failure, Outcome};
use crate::files::{Outputs, print, print_warnings};
use crate::gather::gather;
use crate::suggestion::unknown;
pub(crate) use args::Args;
use args::Protocol;
use checkpoint::Checkpoint;
use results::{Report, Sample};
use settings::Grid;
use std::collections::BTreeSet;
use strut_core::database::build::SourceClip;
use strut_formats::corpus::DEFAULT_PATTERN;

/// Patterns of file names, tried in this order unless one is given.
const PATTERNS: [&str; 4] = [
    DEFAULT_PATTERN,
    "{set}_{action}_{style}_{take}.bvh",
    "{style}_{action}_{take}.bvh",
    "{set}_{style}_{action}_{take}.bvh",
];

pub(crate) fn run(args: &Args) -> Outcome {
    Outputs::check([args.json.as_deref(), args.curves.as_deref()].into_iter().flatten())?;
    let grid = Grid::new(args)?;
    match args.protocol {
        Protocol::Loo if !args.inputs.is_empty() => {
            return Err(Failure::usage("--inputs goes with --protocol off-database"));
        }
        Protocol::OffDatabase if args.inputs.is_empty() => {
            return Err(Failure::usage("--protocol off-database needs --inputs"));
        }
        Protocol::OffDatabase if args.curves.is_some() => {
            return Err(Failure::usage("--curves goes with --protocol loo"));
        }
        Protocol::OffDatabase if args.progress => {
            return Err(Failure::usage("--progress goes with --protocol loo"));
        }
        _ => {}
    }
    let clips = read(args)?;
    let checkpoint = Checkpoint::open(args.json.as_deref(), &command_line())?;
    let samples: Vec<Sample> = match args.protocol {
        Protocol::Loo => cross_validation::run(args, &grid, &clips, &checkpoint)?,
        Protocol::OffDatabase => off_database::run(args, &grid, &clips, &checkpoint)?,
    };
    if samples.is_empty() {
        let advice = "a take of the source style with the same number as one of a target style was expected";
        return Err(Failure::in_file(&args.data, format_args!("there is nothing to compare: {advice}")));
    }
    let report = Report::new(args.protocol.name(), &args.source, &grid, &samples, &command_line());
    let mut outputs = Outputs::default();
    outputs.stage_json(args.json.as_deref(), &report)?;
    if let Some(target) = &args.curves {
        let curves = curves::of_first_fold(args, &grid, &clips)?;
        outputs.stage(target, &serde_json::to_vec(&curves).map_err(Failure::new)?)?;
    }
    outputs.commit()?;
    checkpoint.remove();
    print(&if args.progress { report.progress_markdown() } else { report.markdown() });
    Ok(())
}

/// The arguments as typed, recorded with results and checkpoints.
fn command_line() -> String {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    format!("strut {}", arguments.join(" "))
}

/// The labelled clips of the actions asked for; those that cannot be read are named and left out.
fn read(args: &Args) -> Outcome<Vec<SourceClip>> {
    let sources = gather(std::slice::from_ref(&args.data))?;
    let mut refused = Vec::new();
    let labelled = match &args.pattern {
        Some(pattern) => corpus::label(&sources, Some(pattern), None, &mut refused)?,
        None => PATTERNS
            .iter()
            .find_map(|p| {
                let pattern = p.parse().ok()?;
                let labelled = corpus::label(&sources, Some(&pattern), None, &mut Vec::new()).ok()?;
                labelled.iter().any(|(_, l)| l.style == args.source).then_some(labelled)
            })
            .ok_or_else(|| {
                let advice = "say how clips are labelled with --pattern";
                Failure::in_file(&args.data, format_args!("no clip has the style '{}'; {advice}", args.source))
            })?,
    };
    let known = |name: fn(&strut_formats::corpus::Labels) -> &String| -> Vec<String> {
        labelled.iter().map(|(_, l)| name(l).clone()).collect::<BTreeSet<_>>().into_iter().collect()
    };
    let (actions, styles) = (known(|l| &l.action), known(|l| &l.style));
    let in_data = |reason| Failure::in_file(&args.data, reason);
    for (what, names, of) in [
        ("action", &args.actions, &actions),
        ("action", &args.database_actions, &actions),
        ("style", &args.targets, &styles),
        ("style", &vec![args.source.clone()], &styles),
    ] {
        if let Some(name) = names.iter().find(|n| !of.contains(n)) {
            return Err(in_data(unknown(what, name, of)));
        }
    }
    let wanted = |action: &String| {
        args.actions.is_empty() || args.actions.contains(action) || args.database_actions.contains(action)
    };
    let labelled = labelled.into_iter().filter(|(_, l)| wanted(&l.action)).collect();
    let clips = corpus::read_clips(Some(&args.source), labelled, &mut refused)?;
    for clip in refused {
        print_warnings(&format!("warning: left out {}: {}\n", clip.file, clip.reason));
    }
    Ok(clips)
}
