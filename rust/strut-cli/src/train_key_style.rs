//! `strut train-key-style`: trains a map from a few style variables to poses.

use crate::print::{print, print_warnings};
use crate::progress::Bar;
use serde::Serialize;
use std::path::PathBuf;
use std::time::Instant;
use strut_core::somn::{EM_RIDGE, KeyStyleModel, Learning, MAX_COMPONENTS, Measure, Options, SEED};
use strut_formats::key_style_model;
use strut_tasks::Outcome;
use strut_tasks::corpus::{self, RefusedFile};
use strut_tasks::counted;
use strut_tasks::files::Outputs;
use strut_tasks::key_styles::{parse_axes, train_key_styles};
use strut_tasks::recordings::read_recordings;

/// Train a model that maps a few style variables, measured on poses, to whole poses
///
/// Axes in cm: hips_height reach_left reach_right hand_height_left hand_height_right foot_separation
/// foot_height_difference hands_apart. Others: torso_lean knee_bend_left knee_bend_right (degrees), speed (cm/s). An axis
/// may also be an expression such as 'hand_l.y - shoulder_l.y': joints by role with x, y, z in cm to the left, up and
/// forward, + - * / ( ), abs min max sqrt, and atan2 in degrees. Clips that cannot be used are skipped with a warning.
#[derive(clap::Args)]
#[allow(clippy::doc_markdown)] // The comments are the help.
pub(crate) struct Args {
    /// .bvh files, folders (searched recursively) and .zip archives
    #[arg(required = true, value_name = "INPUT")]
    inputs: Vec<PathBuf>,
    /// One to three style variables
    #[arg(long, value_name = "A[,B[,C]]", allow_hyphen_values = true)]
    axes: String,
    /// The model to write
    #[arg(short, long, value_name = "M")]
    output: PathBuf,
    /// Random seed: the same seed gives the same model
    #[arg(long, value_name = "N", default_value_t = SEED)]
    seed: u64,
    /// Number of linear maps [default: one per 40 frames, 4 to 16]
    #[arg(long, value_name = "K", value_parser = clap::value_parser!(u64).range(1..=MAX_COMPONENTS as u64))]
    components: Option<u64>,
    /// How the model is trained: som, a self-organising mixture network; em, expectation maximisation, for comparison
    #[arg(long, value_name = "METHOD", default_value = "som", value_parser = ["som", "em"])]
    method: String,
    /// Write a report as JSON: {model, seconds, components, `unexplained_share`, axes: [{axis, unit, mean, deviation}],
    /// clips: [{clip, frames}], refused: [{file, reason}]}
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
}

#[derive(Serialize)]
struct Report {
    model: String,
    seconds: f64,
    components: usize,
    unexplained_share: f64,
    axes: Vec<AxisEntry>,
    clips: Vec<ClipEntry>,
    refused: Vec<RefusedFile>,
}

#[derive(Serialize)]
struct AxisEntry {
    axis: String,
    unit: String,
    mean: f64,
    deviation: f64,
}

#[derive(Serialize)]
struct ClipEntry {
    clip: String,
    frames: usize,
}

pub(crate) fn run(args: &Args) -> Outcome {
    Outputs::check([Some(args.output.as_path()), args.json.as_deref()].into_iter().flatten())?;
    let axes = parse_axes(&args.axes)?;
    let begin = Instant::now();
    let mut refused = Vec::new();
    let recordings = Bar::watching(|on_progress| read_recordings(&args.inputs, &mut refused, on_progress))?;
    let learning = if args.method == "em" { Learning::Em { ridge: EM_RIDGE } } else { Learning::Som };
    let options = Options { components: args.components.map(|k| k as usize), seed: args.seed, learning };
    let model = Bar::watching(|on_progress| train_key_styles(&recordings, &axes, options, on_progress))?;
    let bytes = key_style_model::write(&model, strut_formats::GENERATOR);
    let entry = |(j, axis): (usize, &Measure)| AxisEntry {
        axis: axis.to_string(),
        unit: axis.unit().to_string(),
        mean: model.style_mean[j],
        deviation: model.style_deviation[j],
    };
    let report = Report {
        model: args.output.display().to_string(),
        seconds: begin.elapsed().as_secs_f64(),
        components: model.components.len(),
        unexplained_share: model.unexplained_share(),
        axes: model.axes.iter().enumerate().map(entry).collect(),
        clips: model.clips.iter().map(|c| ClipEntry { clip: c.name.clone(), frames: c.frames }).collect(),
        refused,
    };
    let mut outputs = Outputs::default();
    outputs.stage(&args.output, &bytes)?;
    outputs.stage_json(args.json.as_deref(), &report)?;
    outputs.commit()?;
    print_warnings(&corpus::warnings(&report.refused));
    if report.unexplained_share > KeyStyleModel::MAX_UNEXPLAINED_SHARE {
        print_warnings(&format!(
            "note: these style variables do not explain {:.0} % of the poses' variance, so poses are averages of \
             different ones; try other variables\n",
            100.0 * report.unexplained_share
        ));
    }
    let axes = report.axes.iter().map(|a| format!("{} {:.1} ± {:.1} {}", a.axis, a.mean, a.deviation, a.unit));
    print(&format!(
        "{}: {} from {} of {} in {:.1} s, {} kB; {}\n",
        report.model,
        counted(report.components, "component"),
        counted(model.rows.len(), "frame"),
        counted(report.clips.len(), "clip"),
        report.seconds,
        bytes.len().div_ceil(1000),
        axes.collect::<Vec<_>>().join(", "),
    ));
    Ok(())
}
