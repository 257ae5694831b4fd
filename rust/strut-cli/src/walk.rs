//! `strut walk`: a model of walk styles walks into a BVH file.

use crate::failure::{Failure, Outcome};
use crate::print::print;
use std::path::PathBuf;
use std::str::FromStr;
use std::sync::Arc;
use strut_core::hsmm::{MAX_TURN, RATE_HZ, RuntimeWalkModel, SIDES, STRIDE, Walker};
use strut_core::humanoid::HumanoidMotion;
use strut_core::math::Vec3;
use strut_formats::bvh::{self, Bvh};
use strut_formats::walk_model;
use strut_tasks::files::{self, Outputs};
use strut_tasks::weights::StyleWeights;

/// Most steps of a walk: over three hours.
const MAX_STEPS: u64 = 20_000;

/// Steps of a walk that stops: two in which it does and one of standing.
const STOPPING_STEPS: u64 = 3;

/// Walk in a style or a mixture of styles
///
/// What weights lack to a sum of 1 is the average of all styles: old=0.5 is half as old, old=1.5 exaggerates, old=-1 is the
/// opposite. Where the model has 'proud A' and 'proud B', proud is both in equal parts.
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
    /// Change to a style at a step (the first is 0), over so many steps in between; may be repeated
    #[arg(long, value_name = "NAME@STEP:LENGTH")]
    transition: Vec<Transition>,
    /// Steps a minute [default: the style's own]
    #[arg(long, value_name = "N")]
    cadence: Option<f32>,
    /// Length of steps as a share of the style's, 0.6 to 1.3
    #[arg(long, value_name = "SHARE", default_value_t = 1.0)]
    stride: f32,
    /// Stop at the end, within two more steps, and stand
    #[arg(long)]
    stop: bool,
    /// Turn of every step, degrees to the left; at most 10 either way
    #[arg(long, value_name = "DEGREES", default_value_t = 0.0, allow_hyphen_values = true)]
    turn: f32,
    /// Whether joints keep within the range of the recorded walks
    #[arg(long, default_value = "on", value_parser = ["on", "off"])]
    limits: String,
    /// The BVH file to write
    #[arg(short, long, value_name = "OUT.bvh")]
    output: PathBuf,
}

/// `NAME[=W]@STEP:LENGTH`.
#[derive(Clone, Debug)]
struct Transition {
    style: StyleWeights,
    step: u64,
    between: u32,
}

impl FromStr for Transition {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let expected = || format!("'{text}' is no transition; NAME@STEP:LENGTH was expected, as in old@6:4");
        let (style, at) = text.rsplit_once('@').ok_or_else(expected)?;
        let (step, between) = at.split_once(':').ok_or_else(expected)?;
        let (step, between) = (step.trim().parse(), between.trim().parse());
        let (Ok(step), Ok(between)) = (step, between) else { return Err(expected()) };
        Ok(Self { style: style.parse()?, step, between })
    }
}

pub(crate) fn run(args: &Args) -> Outcome {
    Outputs::check([args.output.as_path()])?;
    let limit = MAX_TURN.to_degrees();
    if args.turn.is_nan() || args.turn.abs() > limit {
        return Err(Failure::usage(format_args!(
            "the turn is {}; -{limit:.0} to {limit:.0} degrees were expected",
            args.turn
        )));
    }
    let [shortest, longest] = STRIDE;
    if !(shortest..=longest).contains(&args.stride) {
        return Err(Failure::usage(format_args!(
            "the stride is {}; {shortest} to {longest} of the style's was expected",
            args.stride
        )));
    }
    if let Some(cadence) = args.cadence.filter(|c| !(*c > 0.0 && c.is_finite())) {
        return Err(Failure::usage(format_args!("the cadence is {cadence}; a positive number was expected")));
    }
    let file = files::read(&args.model, walk_model::KIND.max_bytes)?;
    let model = walk_model::read(&file).map_err(|e| Failure::in_file(&args.model, e))?;
    let weights = |style: &StyleWeights| style.of_walks(&model.styles).map_err(Failure::new);
    let mut walker = Walker::new(Arc::new(RuntimeWalkModel::new(&model)));
    walker.set_styles(&weights(&args.style)?).map_err(Failure::new)?;
    for Transition { style, step, between } in &args.transition {
        let weights = weights(style)?;
        walker.plan_transition(*step, *between, [&weights; SIDES]).map_err(Failure::new)?;
    }
    walker.set_cadence(args.cadence);
    walker.set_turn(args.turn.to_radians());
    walker.set_stride(args.stride);
    walker.set_limits(args.limits == "on");
    // The walk does not begin with what was before these were set.
    walker.reset(Vec3::ZERO, 0.0);

    let mut poses = Vec::new();
    let mut walk = |walker: &mut Walker, until: u64| {
        while walker.next_step() < until {
            poses.push(*walker.advance());
        }
    };
    walk(&mut walker, args.steps);
    if args.stop {
        walker.set_walking(false);
        walk(&mut walker, args.steps + STOPPING_STEPS);
    }
    let motion = HumanoidMotion { proportions: model.proportions, rate_hz: RATE_HZ, poses };
    let bvh = Bvh::from_humanoid(&motion).map_err(Failure::new)?;
    let mut outputs = Outputs::default();
    outputs.stage(&args.output, bvh::write(&bvh).as_bytes())?;
    outputs.commit()?;
    let way = motion.poses.iter().zip(&motion.poses[1..]).map(|(a, b)| (b.root - a.root).length()).sum::<f32>();
    let secs = motion.poses.len() as f32 / RATE_HZ;
    let output = args.output.display();
    print(&format!("{output}: {} steps, {} frames, {way:.1} m in {secs:.1} s\n", args.steps, motion.poses.len()));
    Ok(())
}
