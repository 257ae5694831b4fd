//! `strut stylize`: a BVH file in another style.

use crate::clip::{read_clip, read_model};
use crate::failure::{Failure, Outcome};
use crate::files::{Outputs, print};
use crate::progress::Bar;
use crate::search::Search;
use crate::suggestion::unknown;
use crate::trace::{StageTimer, TraceLog, class_names};
use crate::weights::{PartWeights, StyleWeights};
use clap::ValueEnum;
use serde::Serialize;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use strut_core::catalogue::Catalogue;
use strut_core::database::build::MIN_CLIP_FRAMES;
use strut_core::humanoid::HumanoidMotion;
use strut_core::retarget::to_humanoid;
use strut_core::transfer::{ClipJob, Method, Model, Options, StyledMotion, Stylizer};
use strut_formats::bvh;
use strut_formats::corpus::Clip;

/// Names that [`Method::from_name`] knows.
const METHODS: [&str; 8] = ["mar", "lar", "nn", "knn", "gar", "lti", "lti-dof", "gp"];

/// Give a BVH file another style
///
/// The output keeps the input's skeleton, names, units, channel order and frame rate. Without --action and
/// --input-style the input may be of any action and style: the engine finds the most similar classes.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// The database
    #[arg(long, value_name = "DB")]
    db: PathBuf,
    /// The .bvh file to style
    #[arg(long, value_name = "IN.bvh")]
    input: PathBuf,
    /// Styles with their weights; a name alone has weight 1, the remainder to 1 is neutral, weights below 0 or above 1
    /// extrapolate
    #[arg(long, value_name = "NAME[=W][,NAME=W…]")]
    style: StyleWeights,
    /// The .bvh file to write
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
    /// Write how every frame was computed, as JSON lines
    #[arg(long, value_name = "FILE")]
    trace: Option<PathBuf>,
}

/// On or off.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Switch {
    On,
    Off,
}

pub(crate) fn run(args: &Args) -> Outcome {
    Outputs::check([Some(args.output.as_path()), args.trace.as_deref()].into_iter().flatten())?;
    numeric_options(args).validate().map_err(Failure::usage)?;
    let clip = read_clip(&args.input)?;
    let model = Arc::new(read_model(&args.db, args.search)?);
    let db = model.catalogue();
    let stylizer = stylizer(args, &model)?;
    let input = input_of(&clip, db).map_err(|reason| Failure::in_file(&args.input, reason))?;

    let classes = class_names(db);
    let mut summary = Summary::new(classes.len());
    let mut log = args.trace.is_some().then(|| TraceLog::new(db, &classes));
    let styled = {
        let bar = Bar::new("styling", input.poses.len());
        let mut job = ClipJob::new(stylizer);
        let mut timer = StageTimer::default();
        for pose in &input.poses {
            let trace = job.push(pose, &mut timer);
            summary.add(trace.class_weights);
            if let Some(log) = &mut log {
                log.push(&trace, timer.take());
            }
            bar.step();
        }
        job.finish()
    };

    let output = output_of(&clip, db, &styled).map_err(Failure::new)?;
    let mut outputs = Outputs::default();
    outputs.stage(&args.output, bvh::write(&output).as_bytes())?;
    if let (Some(log), Some(target)) = (log, &args.trace) {
        outputs.stage(target, &log.into_json_lines(&styled.frames).map_err(Failure::new)?)?;
    }
    outputs.commit()?;
    print(&summary.text(&args.output, &clip, &output, &styled, &classes));
    Ok(())
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

/// The clip on the database's body and at its rate, or why it cannot be styled.
fn input_of(clip: &Clip, db: &Catalogue) -> Result<HumanoidMotion, String> {
    let input =
        to_humanoid(&clip.motion, &clip.binding, &db.proportions).resampled(db.rate_hz).map_err(|e| e.to_string())?;
    if input.poses.len() < MIN_CLIP_FRAMES {
        let frames = if clip.file.frames == 1 { "1 frame".into() } else { format!("{} frames", clip.file.frames) };
        return Err(format!(
            "the motion has {frames} ({:.2} s); at least {:.2} s are needed",
            clip.motion.duration_secs(),
            MIN_CLIP_FRAMES as f32 / db.rate_hz
        ));
    }
    Ok(input)
}

/// The styled clip on the input's skeleton and at its rate.
fn output_of(clip: &Clip, db: &Catalogue, styled: &StyledMotion) -> Result<bvh::Bvh, bvh::BvhError> {
    clip.file.with_motion(&styled.on_skeleton(db.rate_hz, &clip.motion, &clip.binding))
}

/// Summary that is printed at the end.
struct Summary {
    weights: Vec<f64>,
    frames: usize,
}

impl Summary {
    fn new(classes: usize) -> Self {
        Self { weights: vec![0.0; classes], frames: 0 }
    }

    fn add(&mut self, class_weights: &[f32]) {
        self.frames += 1;
        for (sum, w) in self.weights.iter_mut().zip(class_weights) {
            *sum += f64::from(*w);
        }
    }

    fn text(&self, path: &Path, clip: &Clip, output: &bvh::Bvh, styled: &StyledMotion, classes: &[String]) -> String {
        let seconds = |file: &bvh::Bvh| file.frames as f64 * file.frame_time_secs;
        let (out, before) = (seconds(output), seconds(&clip.file));
        let mut ranked: Vec<(&String, f64)> =
            classes.iter().zip(self.weights.iter().map(|w| w / self.frames.max(1) as f64)).collect();
        ranked.sort_by(|a, b| b.1.total_cmp(&a.1));
        let reads_as: Vec<String> = ranked.iter().take(3).map(|(name, w)| format!("{name} {w:.2}")).collect();
        let repaired = match styled.frames.last().map_or(0, |f| f.repaired_total) {
            0 => String::new(),
            n => format!("note: {n} input frames were unusable and were replaced\n"),
        };
        format!(
            "{}: {} frames, {out:.2} s ({:.2} of the input's); the input reads as {}\n{repaired}",
            path.display(),
            output.frames,
            out / before,
            reads_as.join(", ")
        )
    }
}
