//! `strut train-walk`: trains a walk model on labelled walks.

use crate::label_args::LabelArgs;
use crate::print::{print, print_warnings};
use crate::progress::Bar;
use serde::Serialize;
use std::path::PathBuf;
use std::time::Instant;
use strut_formats::walk_model;
use strut_tasks::Outcome;
use strut_tasks::corpus::{self, RefusedFile};
use strut_tasks::counted;
use strut_tasks::files::Outputs;
use strut_tasks::walks::train_walks;

/// Train a model of walk styles on labelled clips
///
/// If there are clips of the action 'walk', only these are used. Clips that cannot be used are skipped with a warning.
/// Takes of a style that differ by more than 6 degrees per joint become separate styles: 'proud A', 'proud B'.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// .bvh files, folders (searched recursively) and .zip archives
    #[arg(required = true, value_name = "INPUT")]
    inputs: Vec<PathBuf>,
    /// The model to write
    #[arg(short, long, value_name = "M")]
    output: PathBuf,
    #[command(flatten)]
    labels: LabelArgs,
    /// Write a report as JSON: {model, seconds, styles: [{style, clips, steps, `step_secs`}], refused: [{file, reason}]}
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
}

#[derive(Serialize)]
struct Report {
    model: String,
    seconds: f64,
    styles: Vec<StyleEntry>,
    refused: Vec<RefusedFile>,
}

#[derive(Serialize)]
struct StyleEntry {
    style: String,
    clips: usize,
    steps: usize,
    step_secs: f64,
}

pub(crate) fn run(args: &Args) -> Outcome {
    Outputs::check([Some(args.output.as_path()), args.json.as_deref()].into_iter().flatten())?;
    let begin = Instant::now();
    let mut refused = Vec::new();
    let (model, walks) = Bar::watching(|on_progress| {
        train_walks(
            &args.inputs,
            args.labels.pattern.as_ref(),
            args.labels.labels.as_deref(),
            &mut refused,
            on_progress,
        )
    })?;
    let bytes = walk_model::write(&model, strut_formats::GENERATOR);

    let styles = model.styles.iter().zip(&model.means).map(|(style, means)| {
        let of = || walks.iter().filter(|w| w.style == *style);
        let frames: f64 = means.durations.as_flattened().iter().sum();
        let step_secs = frames / 2.0 / f64::from(strut_core::hsmm::RATE_HZ);
        StyleEntry { style: style.clone(), clips: of().count(), steps: of().map(|w| w.steps).sum(), step_secs }
    });
    let report = Report {
        model: args.output.display().to_string(),
        styles: styles.collect(),
        seconds: begin.elapsed().as_secs_f64(),
        refused,
    };
    let mut outputs = Outputs::default();
    outputs.stage(&args.output, &bytes)?;
    outputs.stage_json(args.json.as_deref(), &report)?;
    outputs.commit()?;
    print_warnings(&corpus::warnings(&report.refused));
    let steps: usize = report.styles.iter().map(|s| s.steps).sum();
    let names: Vec<&str> = report.styles.iter().map(|s| s.style.as_str()).collect();
    print(&format!(
        "{}: {} ({}) from {} of {} in {:.1} s, {} kB\n",
        report.model,
        counted(names.len(), "style"),
        names.join(", "),
        counted(steps, "step"),
        counted(walks.len(), "clip"),
        report.seconds,
        bytes.len().div_ceil(1000),
    ));
    Ok(())
}
