//! `strut drive`: neutral motion of a database that goes where it is told to, in a style, into a BVH file.

mod orders;

use crate::clip::read_contents;
use crate::failure::{Failure, Outcome};
use crate::files::{Outputs, print};
use crate::weights::StyleWeights;
use orders::Orders;
use serde::Serialize;
use std::path::PathBuf;
use std::sync::Arc;
use strut_core::database::Database;
use strut_core::driving::{Driver, DrivingClips, NeutralClip};
use strut_core::humanoid::{HumanoidMotion, Pose};
use strut_core::math::Vec2;
use strut_core::transfer::{ClipJob, Model, NoClock, Options, Stylizer};
use strut_formats::bvh::{self, Bvh};

/// Longest drive, seconds.
const MAX_SECS: f32 = 600.0;
/// Distances from a path count from here on, seconds: the beginning is no part of it.
const UNDER_WAY_SECS: f32 = 2.0;

/// Drive a character along a path or by a log of controls, in a style
///
/// It plays neutral clips of the database by motion matching, and the styled character is the one that follows the path.
#[derive(clap::Args)]
#[command(group = clap::ArgGroup::new("way").args(["path", "controls"]).required(true))]
pub(crate) struct Args {
    /// The database
    #[arg(long, value_name = "DB")]
    db: PathBuf,
    /// A path to follow: a CSV file with the columns x,z[,gait], metres
    #[arg(long, value_name = "CSV")]
    path: Option<PathBuf>,
    /// What is asked and when: a CSV file with the columns time,gait,heading[,face], seconds and degrees
    #[arg(long, value_name = "CSV")]
    controls: Option<PathBuf>,
    /// Styles with their weights, as in stylize; neutral if left out
    #[arg(long, value_name = "NAME[=W][,NAME=W…]")]
    style: Option<StyleWeights>,
    /// How fast along a path: 0 stands, 1 walks, 2 runs
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
    /// Write figures of the drive
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
}

/// Figures of a drive.
#[derive(Serialize)]
struct Report {
    frames: usize,
    secs: f32,
    /// Rows and clips to choose from, mirror images included.
    rows: usize,
    clips: usize,
    /// Switches to another row than the next one, a second.
    transitions_per_sec: f32,
    /// Distance of the styled hips from the path, from two seconds on and up to its end, metres.
    path_error_m: Option<PathError>,
}

#[derive(Serialize)]
struct PathError {
    mean: f32,
    p95: f32,
}

pub(crate) fn run(args: &Args) -> Outcome {
    check(args)?;
    let contents = read_contents(&args.db)?;
    let in_db = |reason: String| Failure::in_file(&args.db, reason);
    let clips = neutral_clips(&contents.database);
    let clips = DrivingClips::new(contents.database.proportions, contents.database.rate_hz, &clips)
        .map_err(|reason| in_db(reason.to_string()))?;
    let orders = Orders::read(args.path.as_deref(), args.controls.as_deref(), args.gait)?;
    let (rows, number) = (clips.rows(), clips.clips().len());
    let mut driver = Driver::new(Arc::new(clips));
    let model = Arc::new(Model::of(contents.into_catalogue()));
    let mut stylizer = Stylizer::new(Arc::clone(&model), Options::default()).map_err(Failure::new)?;
    if let Some(style) = &args.style {
        stylizer.set_styles(&style.of(model.catalogue()).map_err(in_db)?).map_err(Failure::new)?;
    }
    let rate_hz = model.catalogue().rate_hz;
    let Driven { neutral, styled, transitions, arrived } = drive(&mut driver, stylizer, &orders, args.secs, rate_hz);

    let proportions = model.catalogue().proportions;
    let frames = neutral.len();
    let hips: Vec<Vec2> = styled.frames().iter().map(|frame| Vec2::new(frame.pose.root.x, frame.pose.root.z)).collect();
    let under_way = &hips[((UNDER_WAY_SECS * rate_hz) as usize).min(arrived)..arrived];
    let secs = frames as f32 / rate_hz;
    let report = Report {
        frames,
        secs,
        rows,
        clips: number,
        transitions_per_sec: transitions as f32 / secs,
        path_error_m: orders.path().filter(|_| !under_way.is_empty()).map(|path| path_error(path, under_way)),
    };
    let mut outputs = Outputs::default();
    let styled = styled.finish().on_body(&proportions, rate_hz).motion;
    let neutral = HumanoidMotion { proportions, rate_hz, poses: neutral };
    for (target, motion) in [(Some(&args.output), &styled), (args.input_out.as_ref(), &neutral)] {
        let Some(target) = target else { continue };
        outputs.stage(target, bvh::write(&Bvh::from_humanoid(motion).map_err(Failure::new)?).as_bytes())?;
    }
    outputs.stage_json(args.json.as_deref(), &report)?;
    outputs.commit()?;
    let off = report.path_error_m.map_or(String::new(), |e| format!(", {:.1} cm off the path", 100.0 * e.mean));
    print(&format!(
        "{}: {frames} frames, {secs:.1} s, {:.1} transitions a second{off}\n",
        args.output.display(),
        report.transitions_per_sec
    ));
    Ok(())
}

fn check(args: &Args) -> Outcome {
    let targets = [Some(&args.output), args.input_out.as_ref(), args.json.as_ref()];
    Outputs::check(targets.into_iter().flatten().map(PathBuf::as_path))?;
    if !(0.0..=2.0).contains(&args.gait) {
        return Err(Failure::usage(format_args!("the gait is {}; 0 (stand) to 2 (run) was expected", args.gait)));
    }
    if let Some(secs) = args.secs.filter(|secs| !(*secs > 0.0 && *secs <= MAX_SECS)) {
        return Err(Failure::usage(format_args!("{secs} s are to be driven; more than 0 to {MAX_SECS} were expected")));
    }
    Ok(())
}

/// The neutral clips of a database, in the world.
fn neutral_clips(db: &Database) -> Vec<NeutralClip> {
    let neutral = (0..db.clips.len()).filter(|&clip| db.clips[clip].style == db.neutral);
    neutral
        .map(|clip| NeutralClip {
            name: db.clips[clip].name.clone(),
            poses: db.motion_of_clip(clip).poses,
            contacts: db.contact[db.clips[clip].rows()].iter().map(|c| c.map(|planted| planted != 0)).collect(),
        })
        .collect()
}

struct Driven {
    neutral: Vec<Pose>,
    styled: ClipJob,
    transitions: usize,
    /// Frames until nothing further was asked.
    arrived: usize,
}

fn drive(driver: &mut Driver, stylizer: Stylizer, orders: &Orders, secs: Option<f32>, rate_hz: f32) -> Driven {
    let mut driven = Driven { neutral: Vec::new(), styled: ClipJob::new(stylizer), transitions: 0, arrived: 0 };
    if let Some(path) = orders.path() {
        driver.set_path(path);
    }
    let most = (secs.unwrap_or(MAX_SECS) * rate_hz) as usize;
    let mut over = false;
    while driven.neutral.len() < most && (secs.is_some() || !over) {
        let now_secs = driven.neutral.len() as f32 / rate_hz;
        let control = orders.at(now_secs, driver.progress());
        let styled_hips = driven.styled.frames().last().map(|frame| frame.pose.root);
        let frame = driver.next(&control, styled_hips);
        driven.transitions += usize::from(frame.switched);
        driven.neutral.push(frame.pose);
        driven.styled.push(&frame.pose, &mut NoClock);
        over |= orders.is_over(now_secs, driver);
        driven.arrived += usize::from(!over);
    }
    driven
}

/// Mean and 95th percentile of the distances of places from a line.
fn path_error(path: &[Vec2], places: &[Vec2]) -> PathError {
    let distance = |place: Vec2| {
        let to = |piece: &[Vec2]| {
            let (along, off) = (piece[1] - piece[0], place - piece[0]);
            let t = (off.dot(along) / along.length_squared().max(f32::MIN_POSITIVE)).clamp(0.0, 1.0);
            off.distance(along * t)
        };
        path.windows(2).map(to).fold(f32::INFINITY, f32::min)
    };
    let mut distances: Vec<f32> = places.iter().map(|&place| distance(place)).collect();
    distances.sort_by(f32::total_cmp);
    let mean = distances.iter().sum::<f32>() / distances.len() as f32;
    PathError { mean, p95: distances[(0.95 * (distances.len() - 1) as f32) as usize] }
}
