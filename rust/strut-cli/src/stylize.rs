//! `strut stylize`: styles BVH files.

use crate::model::read_model;
use crate::print::{print, print_notes};
use crate::progress::Bar;
use crate::read_args::ReadArgs;
use crate::style_args::StyleArgs;
use serde::Serialize;
use std::collections::BTreeMap;
use std::fs;
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use strut_core::transfer::Model;
use strut_formats::bvh;
use strut_formats::corpus::Clip;
use strut_tasks::files::{self, Outputs};
use strut_tasks::gather::{self, Source, gather};
use strut_tasks::note_report::NoteReport;
use strut_tasks::progress::unwatched;
use strut_tasks::stylize::{Spread, StyleSettings, Styled, Styling, TraceLog};
use strut_tasks::threads::{check_threads, map_until_failure};
use strut_tasks::weights::StyleWeights;
use strut_tasks::{Outcome, TaskError};

/// Style BVH files
///
/// Each output keeps the skeleton, names, units, channel order and frame rate of its input. Without --action and
/// --input-style, the engine recognises the action and the style of the input.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// The database
    #[arg(long, value_name = "DB")]
    db: PathBuf,
    /// The .bvh files to style, or folders or .zip archives of them
    #[arg(long, value_name = "IN.bvh", required = true, num_args = 1..)]
    input: Vec<PathBuf>,
    /// Styles with their weights. A name alone has weight 1. If the sum is less than 1, the rest is neutral. Weights below
    /// 0 or above 1 extrapolate
    #[arg(long, value_name = "NAME[=W][,NAME=W…]")]
    style: StyleWeights,
    /// The .bvh file to write; for several inputs, the folder to write files of the same names into
    #[arg(short, long, value_name = "OUT.bvh")]
    output: PathBuf,
    #[command(flatten)]
    options: StyleArgs,
    #[command(flatten)]
    reading: ReadArgs,
    /// Write how every frame of a single input was computed, as JSON lines
    #[arg(long, value_name = "FILE")]
    trace: Option<PathBuf>,
    /// Write a report on every input as JSON, with notes on possible problems
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Number of threads [default: one per processor core]. The outputs do not depend on it
    #[arg(long, value_name = "N")]
    threads: Option<NonZero<usize>>,
}

pub(crate) fn run(args: &Args) -> Outcome {
    let settings = StyleSettings { reading: args.reading.reading()?, ..args.options.settings(args.style.clone())? };
    use_threads(args.threads)?;
    match &args.input[..] {
        [input] if !gather::holds_several(input) => style_one(args, &settings, input),
        _ => style_several(args, &settings),
    }
}

/// Sets the number of threads for the rest of the process.
fn use_threads(threads: Option<NonZero<usize>>) -> Outcome {
    let Some(threads) = threads else { return Ok(()) };
    check_threads(threads.get())?;
    rayon::ThreadPoolBuilder::new().num_threads(threads.get()).build_global().map_err(TaskError::new)
}

fn style_one(args: &Args, settings: &StyleSettings, input: &Path) -> Outcome {
    let also = [args.trace.as_deref(), args.json.as_deref()];
    Outputs::check([Some(args.output.as_path())].into_iter().chain(also).flatten())?;
    let source = Source::file(input);
    let model = Arc::new(read_model(&args.db, settings.search)?);
    let styling = styling_of(args, settings, &model)?;
    let clip = styling.read(&source.path, &source.bytes()?)?;
    let spool = args.trace.as_deref().map(files::unnamed_beside).transpose()?;
    let mut log = spool.map(|spool| TraceLog::new(model.catalogue(), styling.classes(), spool));
    let styled =
        Bar::watching(|on_progress| styling.style(&source.path, &clip, log.as_mut(), Spread::Frames, on_progress))?;
    let mut outputs = Outputs::default();
    outputs.stage(&args.output, &bvh::write(&styled.file))?;
    if let (Some(log), Some(target)) = (log, &args.trace) {
        outputs.stage_with(target, |file| log.write_json_lines(&styled.motion.frames, file))?;
    }
    let report = StyledReport::new(&source, &args.output, &styled, &styling);
    outputs.stage_json(args.json.as_deref(), &report)?;
    outputs.commit()?;
    print(&text(&args.output, &clip, &styled, &styling));
    print_notes(&report.input, &report.notes);
    Ok(())
}

/// Report on an input.
#[derive(Serialize)]
struct StyledReport {
    input: String,
    output: String,
    frames: usize,
    duration_secs: f64,
    /// Recognised classes of the input: the mean weight of each class, "action/style".
    class_weights: BTreeMap<String, f64>,
    /// Mean distance of its poses from the nearest ones of the database, metres.
    distance_metres: f64,
    /// Horizontal distances that the input and the styled motion travel, on the database's body, metres.
    travel_metres: [f32; 2],
    /// Warnings; empty for a clean clip.
    notes: Vec<NoteReport>,
}

impl StyledReport {
    fn new(source: &Source, target: &Path, styled: &Styled, styling: &Styling) -> Self {
        Self {
            input: source.path.clone(),
            output: target.display().to_string(),
            frames: styled.file.frames,
            duration_secs: styled.file.frames as f64 * styled.file.frame_time_secs,
            class_weights: styling.classes().iter().cloned().zip(styled.summary.mean_weights()).collect(),
            distance_metres: styled.motion.familiarity.distance_metres(),
            travel_metres: [
                styled.motion.input_travel_metres,
                styled.motion.travel_metres(styling.catalogue().rate_hz),
            ],
            notes: NoteReport::of(&styled.notes),
        }
    }
}

fn styling_of(args: &Args, settings: &StyleSettings, model: &Arc<Model>) -> Outcome<Styling> {
    Ok(Styling::new(settings.stylizer(model, &args.db)?).with_reading(&settings.reading))
}

/// Returns the summary of a clip.
fn text(target: &Path, clip: &Clip, styled: &Styled, styling: &Styling) -> String {
    styled.summary.text(target, clip, &styled.file, styling.classes())
}

/// Styles all inputs, or none if one cannot be styled.
fn style_several(args: &Args, settings: &StyleSettings) -> Outcome {
    if args.trace.is_some() {
        return Err(TaskError::usage("--trace is for a single input"));
    }
    let folder = &args.output;
    let sources = gather(&args.input)?;
    let is_new = !folder.exists();
    if is_new {
        fs::create_dir(folder).map_err(|e| TaskError::io(folder, &e))?;
    }
    let styled = style_into(args, settings, &sources, folder);
    if styled.is_err() && is_new {
        // The earlier failure is the one to report.
        let _ = fs::remove_dir(folder);
    }
    let (texts, reports): (Vec<String>, Vec<StyledReport>) = styled?.into_iter().unzip();
    let mut outputs = Outputs::default();
    outputs.stage_json(args.json.as_deref(), &reports)?;
    outputs.commit()?;
    print(&texts.concat());
    for report in &reports {
        print_notes(&report.input, &report.notes);
    }
    Ok(())
}

/// Styles all sources into an existing folder. Returns a summary and a report of each.
fn style_into(
    args: &Args,
    settings: &StyleSettings,
    sources: &[Source],
    folder: &Path,
) -> Outcome<Vec<(String, StyledReport)>> {
    if !folder.is_dir() {
        return Err(TaskError::in_file(folder, "a folder for the outputs of several inputs was expected"));
    }
    let targets: Vec<PathBuf> = sources.iter().map(|s| folder.join(s.file_name())).collect();
    Outputs::check(targets.iter().chain(&args.json).map(PathBuf::as_path))?;
    if let Some(target) = sources.iter().zip(&targets).find_map(|(s, target)| s.is_at(target).then_some(target)) {
        return Err(TaskError::in_file(target, "this is an input; another folder was expected"));
    }
    let model = Arc::new(read_model(&args.db, settings.search)?);
    let styling = styling_of(args, settings, &model)?;
    let bar = Bar::new("styling", sources.len());
    // With many clips, one clip per thread uses all threads; with few, the frames are spread over the threads.
    let few = sources.len() < rayon::current_num_threads();
    let spread = if few { Spread::Frames } else { Spread::Clips };
    let style = |(source, target): &(&Source, &PathBuf)| -> Outcome<(Outputs, (String, StyledReport))> {
        let clip = styling.read(&source.path, &source.bytes()?)?;
        let styled = styling.style(&source.path, &clip, None, spread, &unwatched)?;
        let mut outputs = Outputs::default();
        outputs.stage(target, &bvh::write(&styled.file))?;
        bar.step();
        let report = StyledReport::new(source, target, &styled, &styling);
        Ok((outputs, (text(target, &clip, &styled, &styling), report)))
    };
    // One clip at a time per thread, since clips differ in length.
    let pairs: Vec<(&Source, &PathBuf)> = sources.iter().zip(&targets).collect();
    let styled = map_until_failure(&pairs, style)?;
    let commit = |(outputs, said): (Outputs, _)| outputs.commit().map(|()| said);
    styled.into_iter().map(commit).collect()
}
