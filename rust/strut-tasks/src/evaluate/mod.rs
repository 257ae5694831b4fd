//! Measures the errors of styled motion against real motion, and the cost of styling: `strut evaluate`.

mod checkpoint;
mod choices;
mod cross_validation;
mod curves;
mod off_database;
mod request;
mod results;
mod settings;

use crate::corpus::{self, RefusedFile};
use crate::error::{Outcome, TaskError};
use crate::gather::gather;
use crate::progress::OnProgress;
use crate::suggestion::unknown;
use checkpoint::{Checkpoint, Work, digest_of};
pub use choices::{Labels, Part, PassMode, Registration};
pub use curves::TrialCurves;
pub use request::{Protocol, Request};
pub use results::Report;
use results::Sample;
use settings::Grid;
use std::collections::BTreeSet;
use std::sync::{Mutex, PoisonError};
use strut_core::database::build::SourceClip;
use strut_formats::corpus::DEFAULT_PATTERN;
use strut_formats::joints::Reading;

/// Patterns of file names, tried in this order if no pattern is given.
const PATTERNS: [&str; 4] = [
    DEFAULT_PATTERN,
    "{set}_{action}_{style}_{take}.bvh",
    "{style}_{action}_{take}.bvh",
    "{set}_{style}_{action}_{take}.bvh",
];

/// Results of an evaluation.
pub struct Evaluation {
    /// The means.
    pub report: Report,
    /// Curves of the first fold, if requested.
    pub curves: Option<Vec<TrialCurves>>,
    /// Files that could not be used.
    pub left_out: Vec<RefusedFile>,
    checkpoint: Checkpoint,
}

impl Evaluation {
    /// Returns a note about a discarded checkpoint.
    pub fn note(&self) -> Option<&str> {
        self.checkpoint.note()
    }

    /// Removes the checkpoint once the results are written.
    pub fn conclude(self) {
        self.checkpoint.remove();
    }
}

/// Runs the requested evaluation.
///
/// # Errors
/// If the request is contradictory, names something that the data lack or leaves nothing to compare; or the caller
/// cancels.
pub fn evaluate(request: &Request, on_progress: &OnProgress<'_>) -> Outcome<Evaluation> {
    let grid = Grid::new(request)?;
    match request.protocol {
        Protocol::Loo if !request.inputs.is_empty() => {
            return Err(TaskError::usage("--inputs needs --protocol off-database"));
        }
        Protocol::OffDatabase if request.inputs.is_empty() => {
            return Err(TaskError::usage("--protocol off-database needs --inputs"));
        }
        Protocol::OffDatabase if request.wants_curves => {
            return Err(TaskError::usage("--curves needs --protocol loo"));
        }
        _ => {}
    }
    let mut left_out = Vec::new();
    let clips = read(request, &mut left_out, on_progress)?;
    let left_out = Mutex::new(left_out);
    let inputs = if request.inputs.is_empty() { Vec::new() } else { gather(&request.inputs)? };
    // The digest is needed only for a checkpoint.
    let data = if request.json.is_some() { digest_of(&clips, &inputs) } else { String::new() };
    let work = Work { command: request.command.clone(), data };
    let checkpoint = Checkpoint::open(request.json.as_deref(), work)?;
    let samples: Vec<Sample> = match request.protocol {
        Protocol::Loo => cross_validation::run(request, &grid, &clips, &checkpoint, on_progress)?,
        Protocol::OffDatabase => {
            off_database::run(request, &grid, (&clips, &inputs), &checkpoint, &left_out, on_progress)?
        }
    };
    if samples.is_empty() {
        let advice = "a take of the source style and a take of a target style with the same number were expected";
        return Err(TaskError::in_file(&request.data, format_args!("there is nothing to compare; {advice}")));
    }
    let report = Report::new(request.protocol.name(), &request.source, &grid, &samples, &request.command);
    let curves = request.wants_curves.then(|| curves::of_first_fold(request, &grid, &clips)).transpose()?;
    let left_out = left_out.into_inner().unwrap_or_else(PoisonError::into_inner);
    Ok(Evaluation { report, curves, left_out, checkpoint })
}

/// Reads the labelled clips of the requested actions. Unreadable clips are omitted.
fn read(request: &Request, left_out: &mut Vec<RefusedFile>, on_progress: &OnProgress<'_>) -> Outcome<Vec<SourceClip>> {
    let sources = gather(std::slice::from_ref(&request.data))?;
    let labelled = match &request.pattern {
        Some(pattern) => corpus::label(&sources, Some(pattern), None, left_out)?,
        None => PATTERNS
            .iter()
            .find_map(|p| {
                let pattern = p.parse().ok()?;
                let labelled = corpus::label(&sources, Some(&pattern), None, &mut Vec::new()).ok()?;
                labelled.iter().any(|(_, l)| l.style == request.source).then_some(labelled)
            })
            .ok_or_else(|| {
                let missing = format_args!("no clip has the style '{}'", request.source);
                TaskError::in_file(&request.data, missing).with_hint("give the labels with --pattern")
            })?,
    };
    let known = |name: fn(&strut_formats::corpus::Labels) -> &String| -> Vec<String> {
        labelled.iter().map(|(_, l)| name(l).clone()).collect::<BTreeSet<_>>().into_iter().collect()
    };
    let (actions, styles) = (known(|l| &l.action), known(|l| &l.style));
    for (what, names, of) in [
        ("action", &request.actions, &actions),
        ("action", &request.database_actions, &actions),
        ("style", &request.targets, &styles),
        ("style", &vec![request.source.clone()], &styles),
    ] {
        if let Some(name) = names.iter().find(|n| !of.contains(n)) {
            return Err(TaskError::in_file(&request.data, unknown(what, name, of)));
        }
    }
    let wanted = |action: &String| {
        request.actions.is_empty() || request.actions.contains(action) || request.database_actions.contains(action)
    };
    let labelled = labelled.into_iter().filter(|(_, l)| wanted(&l.action)).collect();
    Ok(corpus::read_clips(Some(&request.source), &Reading::default(), labelled, left_out, on_progress)?.clips)
}
