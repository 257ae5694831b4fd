//! `strut stylize`: BVH files in another style.

mod frames;
mod styling;
mod summary;

use crate::clip::read_model;
use crate::failure::{Failure, Outcome};
use crate::files::{self, Outputs, print};
use crate::gather::{self, Source, gather};
use crate::progress::Bar;
use crate::search::Search;
use crate::suggestion::unknown;
use crate::weights::{PartWeights, StyleWeights};
use clap::ValueEnum;
use rayon::iter::{IndexedParallelIterator, IntoParallelRefIterator, ParallelIterator};
use serde::Serialize;
use std::fs;
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use strut_core::transfer::{Method, Model, Options, Stylizer};
use styling::{Spread, Styled, Styling};

/// Names that [`Method::from_name`] knows.
const METHODS: [&str; 8] = ["mar", "lar", "nn", "knn", "gar", "lti", "lti-dof", "gp"];

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
    /// The input's action, if known
    #[arg(long, value_name = "NAME")]
    action: Option<String>,
    /// The input's own style, if known
    #[arg(long, value_name = "NAME")]
    input_style: Option<String>,
    /// Neighbours in each class
    #[arg(short, default_value_t = Options::DEFAULT.k)]
    k: usize,
    /// Ridge of the regressions, as a share of K
    #[arg(long, value_name = "F", default_value_t = Options::DEFAULT.lambda)]
    lambda: f32,
    /// Share of the bias that is kept in the output: 0 to 1
    #[arg(long, value_name = "F", default_value_t = Options::DEFAULT.rho)]
    rho: f32,
    /// How much of the tempo of a walk or a run becomes the style's own: 0 keeps yours, 1 forgets it
    #[arg(long, value_name = "F", default_value_t = Options::DEFAULT.tempo)]
    tempo: f32,
    /// Standard deviations from the neighbours beyond which input is bias
    #[arg(long, value_name = "F", default_value_t = Options::DEFAULT.kappa)]
    kappa: f32,
    /// How slowly the weight of a class falls with its distance
    #[arg(long, value_name = "F", default_value_t = Options::DEFAULT.delta)]
    delta: f32,
    /// Whether output is smoothed where the input is unlike the database
    #[arg(long, default_value = "on")]
    coherence: Switch,
    /// Whether the style changes durations
    #[arg(long, default_value = "on")]
    timing: Switch,
    /// Whether planted feet are held in place
    #[arg(long, default_value = "on")]
    footplant: Switch,
    /// mar: mixture of autoregressive models; lar: one local autoregression; nn: nearest neighbour; knn: mean
    /// of the K nearest; gar: one autoregression for all; lti: linear time-invariant system for the whole
    /// body; lti-dof: one a degree of freedom; gp: Gaussian process
    #[arg(long, default_value = "mar", value_parser = METHODS)]
    method: String,
    /// Other weights for a part of the body: head, torso, left-arm, right-arm, arms or legs
    #[arg(long, value_name = "PART:NAME=W[,…]")]
    part: Vec<PartWeights>,
    /// How neighbours are found: exact, or kdtree:M, among M candidates of a kd-tree in each class
    #[arg(long, value_name = "SEARCH", default_value = "exact")]
    search: Search,
    /// Write how every frame of a single input was computed, as JSON lines
    #[arg(long, value_name = "FILE")]
    trace: Option<PathBuf>,
    /// Threads that work; one a processor unless given. The outputs do not depend on it
    #[arg(long, value_name = "N")]
    threads: Option<NonZero<usize>>,
}

/// On or off.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Switch {
    On,
    Off,
}

pub(crate) fn run(args: &Args) -> Outcome {
    numeric_options(args).validate().map_err(Failure::usage)?;
    use_threads(args.threads)?;
    match &args.input[..] {
        [input] if !gather::holds_several(input) => style_one(args, input),
        _ => style_several(args),
    }
}

/// Sets the number of threads for the rest of the process.
fn use_threads(threads: Option<NonZero<usize>>) -> Outcome {
    let Some(threads) = threads else { return Ok(()) };
    rayon::ThreadPoolBuilder::new().num_threads(threads.get()).build_global().map_err(Failure::new)
}

fn style_one(args: &Args, input: &Path) -> Outcome {
    Outputs::check([Some(args.output.as_path()), args.trace.as_deref()].into_iter().flatten())?;
    let source = Source::file(input);
    let clip = styling::read(&source)?;
    let model = Arc::new(read_model(&args.db, args.search)?);
    let styling = Styling::new(stylizer(args, &model)?);
    let style = |bar| styling.style(&source, &clip, &args.output, args.trace.as_deref(), &Spread::Frames(bar));
    let Styled { outputs, text } = style(Bar::new("styling", 0))?;
    outputs.commit()?;
    print(&text);
    Ok(())
}

/// Styles all inputs, or none if one cannot be styled.
fn style_several(args: &Args) -> Outcome {
    if args.trace.is_some() {
        return Err(Failure::usage("--trace is for a single input"));
    }
    let folder = &args.output;
    let sources = gather(&args.input)?;
    let is_new = !folder.exists();
    if is_new {
        fs::create_dir(folder).map_err(|e| Failure::in_file(folder, files::reason(&e)))?;
    }
    let texts = style_into(args, &sources, folder);
    if texts.is_err() && is_new {
        // The failure is what there is to report.
        let _ = fs::remove_dir(folder);
    }
    print(&texts?.concat());
    Ok(())
}

/// Styles all sources into an existing folder; what there is to say of each.
fn style_into(args: &Args, sources: &[Source], folder: &Path) -> Outcome<Vec<String>> {
    if !folder.is_dir() {
        return Err(Failure::in_file(folder, "a folder for the outputs of several inputs was expected"));
    }
    let targets: Vec<PathBuf> = sources.iter().map(|s| folder.join(s.file_name())).collect();
    Outputs::check(targets.iter().map(PathBuf::as_path))?;
    if let Some(target) = sources.iter().zip(&targets).find_map(|(s, target)| s.is_at(target).then_some(target)) {
        return Err(Failure::in_file(target, "this is an input; another folder was expected"));
    }
    let model = Arc::new(read_model(&args.db, args.search)?);
    let styling = Styling::new(stylizer(args, &model)?);
    let bar = Bar::new("styling", sources.len());
    // Whole clips keep all threads busy where there are as many; frames do where there are fewer.
    let few = sources.len() < rayon::current_num_threads();
    let spread = if few { Spread::Frames(Bar::hidden()) } else { Spread::Clips };
    let style = |(source, target): &(&Source, &PathBuf)| {
        let styled = styling::read(source).and_then(|clip| styling.style(source, &clip, target, None, &spread));
        bar.step();
        styled
    };
    // One by one: clips differ in length.
    let pairs: Vec<(&Source, &PathBuf)> = sources.iter().zip(&targets).collect();
    let styled: Vec<Outcome<Styled>> = pairs.par_iter().with_max_len(1).map(style).collect();
    // The first failure in the order of the inputs, whichever came first.
    let styled = styled.into_iter().collect::<Outcome<Vec<Styled>>>()?;
    let mut texts = Vec::with_capacity(styled.len());
    for Styled { outputs, text } in styled {
        outputs.commit()?;
        texts.push(text);
    }
    Ok(texts)
}

/// Options that do not depend on the database.
fn numeric_options(args: &Args) -> Options {
    Options {
        k: args.k,
        delta: args.delta,
        lambda: args.lambda,
        kappa: args.kappa,
        rho: args.rho,
        tempo: args.tempo,
        coherence: args.coherence == Switch::On,
        timing: args.timing == Switch::On,
        footplant: args.footplant == Switch::On,
        method: Method::from_name(&args.method).unwrap_or_default(),
        ..Options::DEFAULT
    }
}

fn stylizer(args: &Args, model: &Arc<Model>) -> Outcome<Stylizer> {
    let db = model.catalogue();
    let in_db = |reason: String| Failure::in_file(&args.db, reason);
    let mut options = numeric_options(args);
    if let Some(name) = &args.action {
        options.action = Some(db.action_index(name).ok_or_else(|| in_db(unknown("action", name, &db.actions)))?);
    }
    if let Some(name) = &args.input_style {
        options.input_style = Some(db.style_index(name).ok_or_else(|| in_db(unknown("style", name, &db.styles)))?);
    }
    let weights = args.style.of(db).map_err(in_db)?;
    let mut parts = Vec::new();
    for PartWeights { parts: of, weights } in &args.part {
        let weights = weights.of(db).map_err(in_db)?;
        parts.extend(of.iter().map(|&part| (part, weights.clone())));
    }
    let mut stylizer = Stylizer::new(Arc::clone(model), options).map_err(|_| {
        // The numbers were checked before; only the labels can be wrong.
        let label = |name: &Option<String>| name.clone().unwrap_or_else(|| "any".into());
        let (action, style) = (label(&args.action), label(&args.input_style));
        in_db(format!("there is no clip of action '{action}' in style '{style}'"))
    })?;
    stylizer.set_styles(&weights).map_err(Failure::new)?;
    for (part, weights) in parts {
        stylizer.set_part_styles(part, Some(&weights)).map_err(Failure::new)?;
    }
    Ok(stylizer)
}
