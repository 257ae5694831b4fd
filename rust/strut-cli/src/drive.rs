//! `strut drive`: drives a styled character along a path or by controls, and writes a BVH file.

mod figures;
mod orders;

use crate::print::print;
use figures::{Log, report};
use orders::Orders;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;
use strut_core::database::Database;
use strut_core::driving::{Driver, DrivingClips, DrivingError, NeutralClip};
use strut_core::humanoid::HumanoidMotion;
use strut_core::transfer::{Model, Options, StyledFrame, StyledMotion, Stylizer};
use strut_formats::bvh::{self, Bvh};
use strut_tasks::clip::read_contents;
use strut_tasks::counted;
use strut_tasks::files::Outputs;
use strut_tasks::weights::StyleWeights;
use strut_tasks::{Outcome, TaskError};

/// Longest drive, seconds.
const MAX_SECS: f32 = 600.0;

/// Drive a styled character along a path or by recorded controls
///
/// Motion matching chooses neutral clips of the database, which are then styled. The styled character follows the path.
#[derive(clap::Args)]
#[command(group = clap::ArgGroup::new("way").args(["path", "controls"]).required(true))]
pub(crate) struct Args {
    /// The database
    #[arg(long, value_name = "DB")]
    db: PathBuf,
    /// A path to follow: a CSV file with the columns x,z[,gait], metres
    #[arg(long, value_name = "CSV")]
    path: Option<PathBuf>,
    /// Recorded controls: a CSV file with the columns time,gait,heading[,face][,action], seconds and degrees; actions
    /// are jump, punch and kick
    #[arg(long, value_name = "CSV")]
    controls: Option<PathBuf>,
    /// Styles with their weights, as in stylize; neutral by default
    #[arg(long, value_name = "NAME[=W][,NAME=W…]")]
    style: Option<StyleWeights>,
    /// Gait along a path: 0 stand, 1 walk, 2 run
    #[arg(long, value_name = "G", default_value_t = 1.0)]
    gait: f32,
    /// Seconds to drive [default: to the end of the path, or of the controls]
    #[arg(long, value_name = "N")]
    secs: Option<f32>,
    /// The .bvh file to write
    #[arg(short, long, value_name = "OUT.bvh")]
    output: PathBuf,
    /// Write the neutral motion as well
    #[arg(long, value_name = "IN.bvh")]
    input_out: Option<PathBuf>,
    /// Write measurements of the drive as JSON
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
}

pub(crate) fn run(args: &Args) -> Outcome {
    check(args)?;
    let contents = read_contents(&args.db)?;
    let in_db = |reason: String| TaskError::in_file(&args.db, reason);
    let (clips, note) = driving_clips(&contents.database).map_err(in_db)?;
    let clips = Arc::new(clips);
    if let Some(note) = &note {
        eprintln!("note: {note}");
    }
    let orders = Orders::read(args.path.as_deref(), args.controls.as_deref(), args.gait)?;
    let mut driver = Driver::new(Arc::clone(&clips));
    let model = Arc::new(Model::of(contents.into_catalogue()));
    // The input is in the database's neutral style if all clips are from the database.
    let input_style = note.is_none().then_some(model.catalogue().neutral);
    let options = Options { input_style, ..Options::default() };
    let mut stylizer = Stylizer::new(Arc::clone(&model), options).map_err(TaskError::new)?;
    if let Some(style) = &args.style {
        stylizer.set_styles(&style.of(model.catalogue()).map_err(in_db)?).map_err(TaskError::new)?;
    }
    let rate_hz = model.catalogue().rate_hz;
    let Driven { log, styled, arrived } = drive(&mut driver, stylizer, &orders, args.secs, rate_hz);

    let proportions = model.catalogue().proportions;
    let styled = StyledMotion::new(proportions, styled);
    let finished = styled.resampled(rate_hz).motion;
    let report = report(&clips, driver.speeds(), &log, (&styled.frames, &finished), &orders, arrived);
    let mut outputs = Outputs::default();
    let neutral = HumanoidMotion { proportions, rate_hz, poses: log.poses };
    for (target, motion) in [(Some(&args.output), &finished), (args.input_out.as_ref(), &neutral)] {
        let Some(target) = target else { continue };
        outputs.stage(target, &bvh::write(&Bvh::from_humanoid(motion).map_err(TaskError::new)?))?;
    }
    outputs.stage_json(args.json.as_deref(), &report)?;
    outputs.commit()?;
    let off = report.path_error_m.map_or(String::new(), |e| format!(", {:.1} cm off the path", 100.0 * e.mean));
    print(&format!(
        "{}: {}, {:.1} s, {:.1} transitions a second{off}\n",
        args.output.display(),
        counted(report.frames, "frame"),
        report.secs,
        report.transitions_per_sec
    ));
    Ok(())
}

fn check(args: &Args) -> Outcome {
    let targets = [Some(&args.output), args.input_out.as_ref(), args.json.as_ref()];
    Outputs::check(targets.into_iter().flatten().map(PathBuf::as_path))?;
    if !(0.0..=2.0).contains(&args.gait) {
        return Err(TaskError::usage(format_args!("the gait is {}; 0 (stand) to 2 (run) was expected", args.gait)));
    }
    if let Some(secs) = args.secs.filter(|secs| !(*secs > 0.0 && *secs <= MAX_SECS)) {
        return Err(TaskError::usage(format_args!(
            "--secs is {secs}; more than 0 to {MAX_SECS} seconds were expected"
        )));
    }
    Ok(())
}

/// Returns the clips for driving: the neutral ones of a database, and the built-in takes that it lacks. If the database
/// has too little walking, built-in walks are used, with a note.
fn driving_clips(db: &Database) -> Result<(DrivingClips, Option<String>), String> {
    let (body, rate_hz) = (db.proportions, db.rate_hz);
    let carried =
        |takes: &Database| NeutralClip::all_carried(takes, &body, rate_hz).map_err(|reason| reason.to_string());
    let takes = carried(&strut_demo::driving_database().map_err(|reason| reason.to_string())?)?;
    let own = NeutralClip::all_of(db);
    match DrivingClips::new(body, rate_hz, &own, &[], &takes) {
        Ok(clips) => Ok((clips, None)),
        Err(reason @ DrivingError::TooShort { .. }) => {
            let spare = carried(&strut_demo::database().map_err(|reason| reason.to_string())?)?;
            let clips = DrivingClips::new(body, rate_hz, &own, &spare, &takes).map_err(|reason| reason.to_string())?;
            Ok((clips, Some(format!("{reason}; built-in walks are used instead"))))
        }
        Err(reason) => Err(reason.to_string()),
    }
}

struct Driven {
    log: Log,
    /// The styled frames as displayed: footplant does not use later frames.
    styled: Vec<StyledFrame>,
    /// Number of frames until the last order was done.
    arrived: usize,
}

fn drive(driver: &mut Driver, mut stylizer: Stylizer, orders: &Orders, secs: Option<f32>, rate_hz: f32) -> Driven {
    let mut driven = Driven { log: Log::default(), styled: Vec::new(), arrived: 0 };
    if let Some(path) = orders.path() {
        driver.set_path(path);
    }
    // A motion has at least one frame.
    let most = ((secs.unwrap_or(MAX_SECS) * rate_hz) as usize).max(1);
    let mut over = false;
    while driven.log.poses.len() < most && (secs.is_some() || !over) {
        let now_secs = driven.log.poses.len() as f32 / rate_hz;
        let control = orders.at(now_secs, driver.progress());
        let styled_hips = driven.styled.last().map(|frame| frame.pose.root);
        let began = Instant::now();
        let frame = driver.next(&control, styled_hips);
        driven.log.driver_us.push(began.elapsed().as_secs_f32() * 1e6);
        driven.log.push(frame);
        stylizer.set_style_share(frame.style_share);
        driven.styled.push(*stylizer.push(&frame.pose));
        over |= orders.is_over(now_secs, driver);
        driven.arrived += usize::from(!over);
    }
    driven
}
