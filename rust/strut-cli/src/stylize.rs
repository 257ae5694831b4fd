//! `strut stylize`: BVH files in another style.

use crate::failure::{Failure, Outcome};
use crate::model::read_model;
use crate::print::print;
use crate::progress::Bar;
use crate::style_args::StyleArgs;
use rayon::iter::{IndexedParallelIterator, IntoParallelRefIterator, ParallelIterator};
use std::fs;
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use strut_formats::bvh;
use strut_formats::corpus::Clip;
use strut_tasks::TaskError;
use strut_tasks::files::Outputs;
use strut_tasks::gather::{self, Source, gather};
use strut_tasks::progress::unwatched;
use strut_tasks::stylize::{self, Spread, StyleSettings, Styled, Styling, TraceLog};
use strut_tasks::weights::StyleWeights;

/// Give BVH files another style
///
/// An output keeps its input's skeleton, names, units, channel order and frame rate. Without --action and
/// --input-style the input may be of any action and style: the engine finds the most similar classes.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// The database
    #[arg(long, value_name = "DB")]
    db: PathBuf,
    /// The .bvh file to style; or several, or folders and .zip archives of them
    #[arg(long, value_name = "IN.bvh", required = true, num_args = 1..)]
    input: Vec<PathBuf>,
    /// Styles with their weights; a name alone has weight 1, the remainder to 1 is neutral, weights below 0 or above 1
    /// extrapolate
    #[arg(long, value_name = "NAME[=W][,NAME=W…]")]
    style: StyleWeights,
    /// The .bvh file to write; for several inputs, the folder for files of the same names
    #[arg(short, long, value_name = "OUT.bvh")]
    output: PathBuf,
    #[command(flatten)]
    options: StyleArgs,
    /// Write how every frame of a single input was computed, as JSON lines
    #[arg(long, value_name = "FILE")]
    trace: Option<PathBuf>,
    /// Threads that work; one a processor unless given. The outputs do not depend on it
    #[arg(long, value_name = "N")]
    threads: Option<NonZero<usize>>,
}

pub(crate) fn run(args: &Args) -> Outcome {
    let settings = args.options.settings(args.style.clone())?;
    use_threads(args.threads)?;
    match &args.input[..] {
        [input] if !gather::holds_several(input) => style_one(args, &settings, input),
        _ => style_several(args, &settings),
    }
}

/// Sets the number of threads for the rest of the process.
fn use_threads(threads: Option<NonZero<usize>>) -> Outcome {
    let Some(threads) = threads else { return Ok(()) };
    rayon::ThreadPoolBuilder::new().num_threads(threads.get()).build_global().map_err(Failure::new)
}

fn style_one(args: &Args, settings: &StyleSettings, input: &Path) -> Outcome {
    Outputs::check([Some(args.output.as_path()), args.trace.as_deref()].into_iter().flatten())?;
    let source = Source::file(input);
    let clip = stylize::read(&source)?;
    let model = Arc::new(read_model(&args.db, settings.search)?);
    let styling = Styling::new(settings.stylizer(&model, &args.db)?);
    let mut log = args.trace.as_ref().map(|_| TraceLog::new(model.catalogue(), styling.classes()));
    let styled =
        Bar::watching(|on_progress| styling.style(&source.path, &clip, log.as_mut(), Spread::Frames, on_progress))?;
    let mut outputs = Outputs::default();
    outputs.stage(&args.output, bvh::write(&styled.file).as_bytes())?;
    if let (Some(log), Some(target)) = (log, &args.trace) {
        outputs.stage(target, &log.into_json_lines(&styled.motion.frames).map_err(Failure::new)?)?;
    }
    outputs.commit()?;
    print(&text(&args.output, &clip, &styled, &styling));
    Ok(())
}

/// What there is to say of a clip.
fn text(target: &Path, clip: &Clip, styled: &Styled, styling: &Styling) -> String {
    styled.summary.text(target, clip, &styled.file, &styled.motion, styling.classes())
}

/// Styles all inputs, or none if one cannot be styled.
fn style_several(args: &Args, settings: &StyleSettings) -> Outcome {
    if args.trace.is_some() {
        return Err(Failure::usage("--trace is for a single input"));
    }
    let folder = &args.output;
    let sources = gather(&args.input)?;
    let is_new = !folder.exists();
    if is_new {
        fs::create_dir(folder).map_err(|e| TaskError::io(folder, &e))?;
    }
    let texts = style_into(args, settings, &sources, folder);
    if texts.is_err() && is_new {
        // The failure is what there is to report.
        let _ = fs::remove_dir(folder);
    }
    print(&texts?.concat());
    Ok(())
}

/// Styles all sources into an existing folder; what there is to say of each.
fn style_into(args: &Args, settings: &StyleSettings, sources: &[Source], folder: &Path) -> Outcome<Vec<String>> {
    if !folder.is_dir() {
        return Err(Failure::in_file(folder, "a folder for the outputs of several inputs was expected"));
    }
    let targets: Vec<PathBuf> = sources.iter().map(|s| folder.join(s.file_name())).collect();
    Outputs::check(targets.iter().map(PathBuf::as_path))?;
    if let Some(target) = sources.iter().zip(&targets).find_map(|(s, target)| s.is_at(target).then_some(target)) {
        return Err(Failure::in_file(target, "this is an input; another folder was expected"));
    }
    let model = Arc::new(read_model(&args.db, settings.search)?);
    let styling = Styling::new(settings.stylizer(&model, &args.db)?);
    let bar = Bar::new("styling", sources.len());
    // Whole clips keep all threads busy where there are as many; frames do where there are fewer.
    let few = sources.len() < rayon::current_num_threads();
    let spread = if few { Spread::Frames } else { Spread::Clips };
    let style = |(source, target): &(&Source, &PathBuf)| -> Outcome<(Outputs, String)> {
        let clip = stylize::read(source)?;
        let styled = styling.style(&source.path, &clip, None, spread, &unwatched)?;
        let mut outputs = Outputs::default();
        outputs.stage(target, bvh::write(&styled.file).as_bytes())?;
        bar.step();
        Ok((outputs, text(target, &clip, &styled, &styling)))
    };
    // One by one: clips differ in length.
    let pairs: Vec<(&Source, &PathBuf)> = sources.iter().zip(&targets).collect();
    let styled: Vec<Outcome<(Outputs, String)>> = pairs.par_iter().with_max_len(1).map(style).collect();
    // The first failure in the order of the inputs, whichever came first.
    let styled = styled.into_iter().collect::<Outcome<Vec<_>>>()?;
    let mut texts = Vec::with_capacity(styled.len());
    for (outputs, text) in styled {
        outputs.commit()?;
        texts.push(text);
    }
    Ok(texts)
}
