//! `strut walk`: synthesises a walk and writes a BVH file.

use crate::print::print;
use std::path::PathBuf;
use std::sync::Arc;
use strut_core::hsmm::{RATE_HZ, RuntimeWalkModel};
use strut_formats::bvh::{self, Bvh};
use strut_formats::walk_model;
use strut_tasks::counted;
use strut_tasks::files::{self, Outputs};
use strut_tasks::progress::unwatched;
use strut_tasks::walk::{Gait, MAX_STEPS, Transition, WalkOrder};
use strut_tasks::weights::StyleWeights;
use strut_tasks::{Outcome, TaskError};

/// Synthesise a walk in a style or a mixture of styles
///
/// Weights are relative to the average of all styles: old=0.5 is half as old, old=1.5 exaggerates, old=-1 is the
/// opposite. If the model has 'proud A' and 'proud B', 'proud' means both in equal parts.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// A model that train-walk wrote
    #[arg(long, value_name = "M")]
    model: PathBuf,
    /// Weights of styles; a name alone is 1
    #[arg(long, value_name = "NAME[=W],…", allow_hyphen_values = true)]
    style: StyleWeights,
    /// Number of steps
    #[arg(long, value_name = "N", default_value_t = 12, value_parser = clap::value_parser!(u64).range(1..=MAX_STEPS))]
    steps: u64,
    /// Change to a style: begin at STEP (the first step is 0), finish LENGTH steps later; may be repeated
    #[arg(long, value_name = "NAME@STEP:LENGTH")]
    transition: Vec<Transition>,
    /// Steps per minute [default: the style's own]
    #[arg(long, value_name = "N")]
    cadence: Option<f32>,
    /// Step length relative to the style's, 0.6 to 1.3
    #[arg(long, value_name = "SHARE", default_value_t = 1.0)]
    stride: f32,
    /// Stop at the end within two more steps, and stand still
    #[arg(long)]
    stop: bool,
    /// Turn per step, degrees to the left, -10 to 10
    #[arg(long, value_name = "DEGREES", default_value_t = 0.0, allow_hyphen_values = true)]
    turn: f32,
    /// Whether joints are limited to the range of the recorded walks
    #[arg(long, default_value = "on", value_parser = ["on", "off"])]
    limits: String,
    /// The BVH file to write
    #[arg(short, long, value_name = "OUT.bvh")]
    output: PathBuf,
}

pub(crate) fn run(args: &Args) -> Outcome {
    Outputs::check([args.output.as_path()])?;
    let gait = Gait { cadence: args.cadence, stride: args.stride, turn: args.turn, limits: args.limits == "on" };
    // Checked before the model is read.
    gait.check()?;
    let file = files::read(&args.model, walk_model::KIND.max_bytes)?;
    let model = walk_model::read(&file).map_err(|e| TaskError::in_file(&args.model, e))?;
    let order = WalkOrder {
        styles: args.style.clone(),
        steps: args.steps,
        transitions: args.transition.clone(),
        gait,
        stop: args.stop,
    };
    let motion = order.walk(&model, Arc::new(RuntimeWalkModel::new(&model)), &unwatched)?.motion;
    let bvh = Bvh::from_humanoid(&motion).map_err(TaskError::new)?;
    let mut outputs = Outputs::default();
    outputs.stage(&args.output, &bvh::write(&bvh))?;
    outputs.commit()?;
    let way = motion.poses.iter().zip(&motion.poses[1..]).map(|(a, b)| (b.root - a.root).length()).sum::<f32>();
    let secs = motion.poses.len() as f32 / RATE_HZ;
    let output = args.output.display();
    let walked = format!("{}, {}", counted(args.steps as usize, "step"), counted(motion.poses.len(), "frame"));
    print(&format!("{output}: {walked}, {way:.1} m in {secs:.1} s\n"));
    Ok(())
}
