//! `strut live`: styles a live performer's motion and sends it to other programs.

mod address;
mod figures;
mod output;
mod receiver;
mod sender;
mod session;
mod stop;

use crate::model::read_model;
use crate::print::{print, print_warnings};
use address::Address;
use clap::ValueEnum;
use figures::Figures;
use output::Output;
use receiver::Receiver;
use session::{Session, Settings};
use std::io::IsTerminal;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;
use strut_core::humanoid::{HumanoidMotion, Pose};
use strut_core::stream::{Delay, LiveStylizer, MAX_DELAY_SECS, Place};
use strut_core::transfer::{Options, Stylizer};
use strut_formats::bvh::{self, Bvh};
use strut_tasks::files::Outputs;
use strut_tasks::search::Search;
use strut_tasks::weights::StyleWeights;
use strut_tasks::{Outcome, TaskError};

/// Default ports of VMC programs: of performers and of avatars.
const PERFORMER_PORT: u16 = 39_539;
const AVATAR_PORT: u16 = 39_540;
/// Longest calibration, seconds.
const MAX_CALIBRATION_SECS: f64 = 60.0;
/// Number of packets that are received before the time is checked, so that a flood of packets does not block sending.
const MOST_AT_ONCE: usize = 1024;
/// Delay beyond which frames are skipped, seconds.
const MOST_BEHIND_SECS: f64 = 0.25;

/// Style a performer's motion live
///
/// Receives motion from a motion capture program by the VMC protocol (Open Sound Control over UDP), styles it, and sends
/// it to programs that show it. Press Ctrl-C to stop.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// The database
    #[arg(long, value_name = "DB", required_unless_present = "send")]
    db: Option<PathBuf>,
    /// Styles with their weights, as in stylize; neutral by default. A message /strut/style NAME W changes a weight
    #[arg(long, value_name = "NAME[=W][,NAME=W…]")]
    style: Option<StyleWeights>,
    /// Address on which the performer's motion is received [default: 127.0.0.1:39539]
    #[arg(long = "in", value_name = "ADDR", conflicts_with = "send")]
    input: Option<Address>,
    /// Address to send to; may be repeated [default: 127.0.0.1:39540; with --send 127.0.0.1:39539]
    #[arg(long = "out", value_name = "ADDR")]
    outputs: Vec<Address>,
    /// Delay of the jitter buffer: auto, or milliseconds from 0 to 200
    #[arg(long, value_name = "auto|MS", default_value = "auto", value_parser = parse_delay)]
    buffer: Delay,
    /// Whether the styled character follows the performer's position
    #[arg(long, value_enum, default_value = "follow")]
    place: PlaceName,
    /// Seconds of T-pose at the start, for senders whose bones are rotated in the T-pose
    #[arg(long, value_name = "SECS")]
    calibrate: Option<f64>,
    /// Record the styled motion, at most one hour, and write it to a .bvh file at the end
    #[arg(long, value_name = "OUT.bvh")]
    record: Option<PathBuf>,
    /// Record the performer's motion as well
    #[arg(long, value_name = "IN.bvh")]
    record_input: Option<PathBuf>,
    /// Stop after this number of seconds
    #[arg(long, value_name = "N")]
    secs: Option<f64>,
    /// Allow connections with other computers
    #[arg(long)]
    allow_network: bool,
    /// Write measurements of the stream as JSON
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Send a .bvh file as a performer instead, once or for --secs seconds
    #[arg(long, value_name = "IN.bvh", conflicts_with_all = ["db", "style", "record", "record_input", "calibrate", "json"])]
    send: Option<PathBuf>,
}

impl Args {
    /// Returns the address to listen on.
    fn source(&self) -> Address {
        self.input.unwrap_or(Address::on_this_computer(PERFORMER_PORT))
    }

    /// Returns the addresses to send to.
    fn targets(&self) -> Vec<Address> {
        let port = if self.send.is_some() { PERFORMER_PORT } else { AVATAR_PORT };
        if self.outputs.is_empty() { vec![Address::on_this_computer(port)] } else { self.outputs.clone() }
    }
}

#[derive(Clone, Copy, ValueEnum)]
enum PlaceName {
    /// It is pulled towards the performer's position while it walks
    Follow,
    /// It moves as far as its steps go
    Free,
}

fn parse_delay(text: &str) -> Result<Delay, String> {
    if text == "auto" {
        return Ok(Delay::Auto);
    }
    let most = 1000.0 * MAX_DELAY_SECS;
    let ms = text.parse().ok().filter(|ms: &f64| (0.0..=most).contains(ms));
    ms.map(|ms| Delay::Fixed(ms / 1000.0)).ok_or_else(|| format!("auto or a number from 0 to {most} was expected"))
}

pub(crate) fn run(args: &Args) -> Outcome {
    check(args)?;
    match (&args.send, &args.db) {
        (Some(file), _) => sender::send(file, &mut Output::open(&args.targets())?, args.secs),
        (None, Some(db)) => style(args, db),
        (None, None) => Err(TaskError::usage("--db or --send was expected")),
    }
}

fn check(args: &Args) -> Outcome {
    let targets = [&args.record, &args.record_input, &args.json];
    Outputs::check(targets.into_iter().flatten().map(PathBuf::as_path))?;
    let (source, targets) = (args.source(), args.targets());
    for address in targets.iter().chain([&source]) {
        address.check(args.allow_network)?;
    }
    if let Some(same) = targets.iter().find(|target| args.send.is_none() && source.hears(target)) {
        return Err(TaskError::usage(format_args!(
            "--in and --out are both {same}; Strut would receive its own output"
        )));
    }
    if let Some(secs) = args.secs.filter(|secs| !(*secs > 0.0 && secs.is_finite())) {
        return Err(TaskError::usage(format_args!("--secs is {secs}; more than 0 was expected")));
    }
    if let Some(secs) = args.calibrate.filter(|secs| !(*secs > 0.0 && *secs <= MAX_CALIBRATION_SECS)) {
        return Err(TaskError::usage(format_args!(
            "--calibrate is {secs}; more than 0 to {MAX_CALIBRATION_SECS} seconds were expected"
        )));
    }
    Ok(())
}

fn style(args: &Args, db: &Path) -> Outcome {
    let model = Arc::new(read_model(db, Search::Exact)?);
    let mut stylizer = Stylizer::new(Arc::clone(&model), Options::default()).map_err(TaskError::new)?;
    let mut weights = vec![0.0; model.catalogue().styles.len()];
    if let Some(style) = &args.style {
        weights = style.of(model.catalogue()).map_err(|reason| TaskError::in_file(db, reason))?;
        stylizer.set_styles(&weights).map_err(TaskError::new)?;
    }
    let place = match args.place {
        PlaceName::Follow => Place::Follow,
        PlaceName::Free => Place::Free,
    };
    let live = LiveStylizer::new(stylizer, place).map_err(TaskError::new)?;
    let records = args.record.is_some() || args.record_input.is_some();
    let settings = Settings { delay: args.buffer, calibrate_secs: args.calibrate, records };
    let mut session = Session::new(model, live, weights, settings);

    let mut output = Output::open(&args.targets())?;
    let receiver = Receiver::listen(&args.source())?;
    print(&format!("listening on {}, sending to {output}\n", receiver.address()));
    stream(&mut session, &receiver, &mut output, args.secs)?;
    finish(args, &session)
}

/// Receives packets and sends a frame at every tick of the database's rate, until it is stopped.
fn stream(session: &mut Session, receiver: &Receiver, output: &mut Output, secs: Option<f64>) -> Outcome {
    let stopped = stop::on_signals()?;
    let shows = std::io::stderr().is_terminal();
    let period_secs = 1.0 / f64::from(session.rate_hz());
    let mut tick = 0_u64;
    loop {
        let due_secs = tick as f64 * period_secs;
        if stopped() || secs.is_some_and(|secs| due_secs > secs) {
            break;
        }
        // All packets that have arrived are processed before the tick, since they may complete a frame.
        for _ in 0..MOST_AT_ONCE {
            let wait = Duration::from_secs_f64((due_secs - receiver.now_secs()).max(0.0));
            let Some(packet) = receiver.next(wait)? else { break };
            session.receive(&packet.bytes, packet.from, packet.arrived_secs);
        }
        let now_secs = receiver.now_secs();
        if now_secs < due_secs {
            continue;
        }
        for packet in session.tick(due_secs) {
            output.send(&packet);
        }
        session.sent(now_secs, receiver.now_secs());
        tick += 1;
        if now_secs - due_secs > MOST_BEHIND_SECS {
            tick = (now_secs / period_secs) as u64;
        }
        if shows && tick.is_multiple_of(session.rate_hz() as u64) {
            print_warnings(&format!("\r{}  ", session.figures()));
        }
    }
    if shows {
        print_warnings("\n");
    }
    Ok(())
}

/// Writes the recordings and the statistics.
fn finish(args: &Args, session: &Session) -> Outcome {
    let figures: Figures = session.figures();
    let mut outputs = Outputs::default();
    let recorded = session.recorded();
    for (target, poses) in [&args.record, &args.record_input].into_iter().zip([&recorded.styled, &recorded.input]) {
        let Some(target) = target else { continue };
        outputs.stage(target, &bvh_of(session, poses).map_err(|reason| TaskError::in_file(target, reason))?)?;
    }
    outputs.stage_json(args.json.as_deref(), &figures)?;
    outputs.commit()?;
    print(&format!("{figures}\n"));
    Ok(())
}

/// Returns poses on the database's body as a BVH file.
fn bvh_of(session: &Session, poses: &[Pose]) -> Result<Vec<u8>, String> {
    if poses.is_empty() {
        return Err("no motion arrived, so nothing could be recorded".into());
    }
    let motion =
        HumanoidMotion { proportions: session.proportions(), rate_hz: session.rate_hz(), poses: poses.to_vec() };
    Ok(bvh::write(&Bvh::from_humanoid(&motion).map_err(|reason| reason.to_string())?))
}
