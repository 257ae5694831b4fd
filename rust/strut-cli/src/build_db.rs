//! `strut build-db`: builds a database from labelled clips.

use crate::annotation::CanonicalContact;
use crate::label_args::LabelArgs;
use crate::manners::{self, BimodalEntry};
use crate::print::{print, print_notes, print_warnings};
use crate::progress::Bar;
use crate::read_args::ReadArgs;
use serde::Serialize;
use std::collections::HashMap;
use std::fmt::Write;
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::time::Instant;
use strut_core::database::build::{self, BuildOptions, BuildReport};
use strut_core::database::{Database, residuals};
use strut_core::math::stats::median;
use strut_core::registration::{self, Method};
use strut_core::search::Index;
use strut_formats::strutdb;
use strut_tasks::corpus::{self, ReadClips, RefusedFile};
use strut_tasks::counted;
use strut_tasks::evaluate::Registration;
use strut_tasks::files::Outputs;
use strut_tasks::gather::gather;
use strut_tasks::note_report::NoteReport;
use strut_tasks::threads::ThreadPool;
use strut_tasks::{OnProgress, Outcome, TaskError};

/// Output of `--json`.
const JSON_HELP: &str = "\
The report of --json:
  database, seconds, rate_hz, neutral, styles
  actions  [{action, method, reference_clip, canonical_frames, canonical_contact {left, right}:
           for every canonical frame, the share of clips or cycles in which the foot is planted}]
  totals   {clips, frames, cycles, refused, bytes}
  two_manners  [{action, style, separation, clips [[name], [name]]}]: styles whose clips form two
               groups of at least 2 clips; separation is the distance of the groups, as a multiple
               of the usual distance of two takes of a class
  clips    [{file, name, action, style, take, frames, cycles, mean_cycle_secs, turn_degrees,
           registration_cost, residual_cm, residual_ratio (to the median of its action and style;
           to that of its action if there are fewer than 3 clips), contact_agreement_percent (with
           canonical_contact), faulty_cycles [{first_frame, frames, fault}], notes [{code, text}]:
           possible problems in reading the file}]
  refused  [{file, reason}]";

/// Build a database from labelled clips
///
/// Clips that cannot be used are skipped with a warning.
#[derive(clap::Args)]
#[command(after_long_help = JSON_HELP)]
pub(crate) struct Args {
    /// .bvh files, folders (searched recursively) and .zip archives
    #[arg(required = true, value_name = "INPUT")]
    inputs: Vec<PathBuf>,
    /// The database to write
    #[arg(short, long, value_name = "DB")]
    output: PathBuf,
    #[command(flatten)]
    labels: LabelArgs,
    /// The neutral style [default: 'neutral' or 'normal', else the first style]
    #[arg(long, value_name = "NAME")]
    neutral: Option<String>,
    /// Frames per second of the database
    #[arg(long, value_name = "HZ", default_value_t = 60.0)]
    rate: f32,
    #[command(flatten)]
    reading: ReadArgs,
    /// How clips are aligned in time (registered)
    #[arg(long, value_enum, default_value_t = Registration::Dtw)]
    registration: Registration,
    /// Write a Markdown table of how well every clip was registered, worst first
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// Write a report as JSON
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
}

/// Smallest number of clips for which a class has its own median residual: an extreme style is farther from all others.
const MIN_CLASS_CLIPS: usize = 3;

pub(crate) fn run(args: &Args) -> Outcome {
    Outputs::check([Some(args.output.as_path()), args.json.as_deref(), args.report.as_deref()].into_iter().flatten())?;
    if !build::RATES_HZ.contains(&args.rate) {
        return Err(TaskError::usage(build::BuildError::Rate(args.rate)));
    }
    let begin = Instant::now();
    let sources = gather(&args.inputs)?;
    let mut refused = Vec::new();
    let labelled = corpus::label(&sources, args.labels.pattern.as_ref(), args.labels.labels.as_deref(), &mut refused)?;
    let reading = args.reading.reading()?;
    let read = |on_progress: &OnProgress<'_>| {
        corpus::read_clips(args.neutral.as_deref(), &reading, labelled, &mut refused, on_progress)
    };
    let ReadClips { clips, notes } = Bar::watching(read)?;
    let registration = registration::Options { warp: args.registration.warp(), ..registration::Options::default() };
    let options = BuildOptions { rate_hz: args.rate, neutral: args.neutral.clone(), registration };
    let (db, report) = {
        let bar = Bar::new("preparing", clips.len());
        let mut progress = |p: build::Progress| {
            bar.show(p.stage.name(), p.done, p.total);
            ControlFlow::Continue(())
        };
        build::build(&clips, &options, &ThreadPool, &mut progress).map_err(TaskError::new)?
    };
    let bytes = strutdb::write(&db, &Index::build(&db).plan(), strut_formats::GENERATOR);
    let files: HashMap<&str, &str> = clips.iter().map(|c| (c.name.as_str(), c.source.as_str())).collect();
    let mut report = Report::new(args, &db, &report, &files, refused, bytes.len(), begin.elapsed().as_secs_f64());
    for clip in &mut report.clips {
        clip.notes = NoteReport::of(notes.get(&clip.file).into_iter().flatten());
    }

    let mut outputs = Outputs::default();
    outputs.stage(&args.output, &bytes)?;
    outputs.stage_json(args.json.as_deref(), &report)?;
    if let Some(target) = &args.report {
        outputs.stage(target, report.markdown().as_bytes())?;
    }
    outputs.commit()?;
    print_warnings(&corpus::warnings(&report.refused));
    for clip in &report.clips {
        print_notes(&clip.file, &clip.notes);
    }
    print(&report.summary());
    Ok(())
}

#[derive(Serialize)]
struct Report {
    database: String,
    seconds: f64,
    rate_hz: f32,
    neutral: String,
    styles: Vec<String>,
    actions: Vec<ActionEntry>,
    totals: Totals,
    two_manners: Vec<BimodalEntry>,
    clips: Vec<ClipEntry>,
    refused: Vec<RefusedFile>,
}

#[derive(Serialize)]
struct ActionEntry {
    action: String,
    method: &'static str,
    reference_clip: String,
    canonical_frames: f32,
    canonical_contact: CanonicalContact,
}

#[derive(Serialize)]
struct Totals {
    clips: usize,
    frames: usize,
    cycles: usize,
    refused: usize,
    bytes: usize,
}

#[derive(Serialize)]
struct ClipEntry {
    file: String,
    name: String,
    action: String,
    style: String,
    take: u32,
    frames: usize,
    cycles: usize,
    mean_cycle_secs: Option<f32>,
    turn_degrees: f32,
    registration_cost: Option<f32>,
    residual_cm: f32,
    residual_ratio: f32,
    contact_agreement_percent: f32,
    faulty_cycles: Vec<FaultyCycle>,
    /// Warnings about how its file was read.
    notes: Vec<NoteReport>,
}

#[derive(Serialize)]
struct FaultyCycle {
    first_frame: usize,
    frames: usize,
    fault: String,
}

impl Report {
    fn new(
        args: &Args,
        db: &Database,
        report: &BuildReport,
        file_of: &HashMap<&str, &str>,
        mut refused: Vec<RefusedFile>,
        bytes: usize,
        seconds: f64,
    ) -> Self {
        let file = |name: &str| file_of.get(name).map_or_else(|| name.to_owned(), |f| (*f).to_owned());
        for clip in report.refused() {
            let reason = clip.refused.as_ref().map(ToString::to_string).unwrap_or_default();
            refused.push(RefusedFile { file: file(&clip.name), reason });
        }
        let action = |a: &build::ActionReport| {
            let (frames, cyclic) = (a.canonical_frames, a.method == Method::Cycles);
            // Every reported action is in the database, since its reference clip is.
            let index = db.action_index(&a.action).unwrap_or_default();
            ActionEntry {
                action: a.action.clone(),
                method: a.method.name(),
                reference_clip: a.reference_clip.clone(),
                canonical_frames: frames,
                canonical_contact: CanonicalContact::of(db, index, frames, cyclic),
            }
        };
        let actions: Vec<ActionEntry> = report.actions.iter().map(action).collect();
        let residuals = Residuals::of(db);
        let figures: HashMap<&str, (f32, f32, f32)> = db
            .clips
            .iter()
            .enumerate()
            .map(|(i, clip)| {
                let of_action = actions.iter().find(|a| a.action == db.actions[usize::from(clip.action)]);
                let agreement = of_action.map_or(0.0, |a| {
                    let cyclic = a.method == Method::Cycles.name();
                    a.canonical_contact.agreement(db, clip.rows(), a.canonical_frames, cyclic)
                });
                (clip.name.as_str(), (residuals.cm[i], residuals.ratio(db, i), agreement))
            })
            .collect();
        let figures = |name: &str| figures.get(name).copied().unwrap_or_default();
        let entry = |c: &build::ClipReport| ClipEntry {
            residual_cm: figures(&c.name).0,
            residual_ratio: figures(&c.name).1,
            contact_agreement_percent: figures(&c.name).2,
            file: file(&c.name),
            name: c.name.clone(),
            action: c.action.clone(),
            style: c.style.clone(),
            take: c.take,
            frames: c.frames,
            cycles: c.cycles,
            mean_cycle_secs: c.mean_cycle_secs,
            turn_degrees: c.turn.to_degrees(),
            registration_cost: c.registration_cost,
            faulty_cycles: c.faulty_cycles.iter().map(FaultyCycle::of).collect(),
            notes: Vec::new(),
        };
        Self {
            database: args.output.display().to_string(),
            seconds,
            rate_hz: db.rate_hz,
            neutral: db.styles[usize::from(db.neutral)].clone(),
            styles: db.styles.clone(),
            actions,
            totals: Totals {
                clips: db.clips.len(),
                frames: db.frames(),
                cycles: report.accepted().map(|c| c.cycles).sum(),
                refused: refused.len(),
                bytes,
            },
            two_manners: manners::entries(&report.bimodal_styles),
            clips: report.accepted().map(entry).collect(),
            refused,
        }
    }

    /// Returns the refused clips with the reasons, the actions, the bimodal styles, then every clip and its faulty
    /// cycles, worst first.
    fn markdown(&self) -> String {
        let mut out = format!("# Registration of {}\n\n## Refused clips\n\n", self.database);
        // Writing to a string cannot fail.
        if self.refused.is_empty() {
            out.push_str("None.\n");
        }
        for r in &self.refused {
            let _ = writeln!(out, "- `{}`: {}", r.file, r.reason);
        }
        out.push_str(
            "\n## Actions\n\nDuty: per cent of the canonical timeline that a foot is planted. Planted: where most clips or cycles\n\
             have it planted, in per cent of the timeline.\n\n\
             | action | registered by | left duty % | left planted % | right duty % | right planted % |\n\
             |---|---|---:|---|---:|---|\n",
        );
        for a in &self.actions {
            let _ = writeln!(out, "| {} | {} {}|", a.action, a.method, a.canonical_contact.cells());
        }
        out.push_str("\n## Styles whose takes form two groups\n\n");
        if self.two_manners.is_empty() {
            out.push_str("None.\n");
        }
        for found in &self.two_manners {
            let [first, second] = found.clips.each_ref().map(|names| names.join(", "));
            let _ = writeln!(out, "- {}\n  - {first}\n  - {second}", found.sentence());
        }
        out.push_str(
            "\n## Clips\n\nResidual: mean distance of the joints from those of the counterparts in all styles, without the\n\
             style's mean offset; and as a multiple of the median of its action and style (of the action, if that has\n\
             fewer than 3 clips). Contacts: per cent of its labels that agree with the action's. Worst first.\n\n\
             | clip | residual cm | × median | contacts % | cycles | faulty cycles |\n|---|---:|---:|---:|---:|---|\n",
        );
        let mut clips: Vec<&ClipEntry> = self.clips.iter().collect();
        clips.sort_by(|a, b| b.residual_ratio.total_cmp(&a.residual_ratio));
        for c in clips {
            let fault = |f: &FaultyCycle| format!("frames {}–{}: {}", f.first_frame, f.first_frame + f.frames, f.fault);
            let faults: Vec<String> = c.faulty_cycles.iter().map(fault).collect();
            let (cm, ratio, contacts) = (c.residual_cm, c.residual_ratio, c.contact_agreement_percent);
            let faults = faults.join("; ");
            let _ = writeln!(out, "| {} | {cm:.2} | {ratio:.2} | {contacts:.1} | {} | {faults} |", c.name, c.cycles);
        }
        out
    }

    fn summary(&self) -> String {
        let t = &self.totals;
        let refused = if t.refused > 0 { format!(" ({} refused)", t.refused) } else { String::new() };
        let built = format!(
            "{}: {}{refused}, {} at {} Hz, {}, {}, {} (neutral: {}), {:.1} MB, {:.1} s\n",
            self.database,
            counted(t.clips, "clip"),
            counted(t.frames, "frame"),
            self.rate_hz,
            counted(t.cycles, "gait cycle"),
            counted(self.actions.len(), "action"),
            counted(self.styles.len(), "style"),
            self.neutral,
            t.bytes as f64 / 1e6,
            self.seconds
        );
        built + &manners::text(&self.two_manners)
    }
}

/// Residual distance of every clip from its counterparts.
struct Residuals {
    cm: Vec<f32>,
}

impl Residuals {
    fn of(db: &Database) -> Self {
        Self { cm: residuals(db).iter().map(|r| 100.0 * r).collect() }
    }

    /// Returns a clip's residual relative to the median of its class, or of its action if the class is small.
    fn ratio(&self, db: &Database, clip: usize) -> f32 {
        let here = &db.clips[clip];
        let peers = |same_style: bool| {
            let peers = db.clips.iter().zip(&self.cm);
            let peers = peers.filter(move |(c, _)| c.action == here.action && (!same_style || c.style == here.style));
            peers.map(|(_, cm)| f64::from(*cm))
        };
        let is_large = peers(true).count() >= MIN_CLASS_CLIPS;
        let usual = median(peers(is_large)).unwrap_or_default() as f32;
        self.cm[clip] / usual.max(1e-6)
    }
}

impl FaultyCycle {
    fn of(fault: &strut_core::registration::FaultyCycle) -> Self {
        Self { first_frame: fault.frames.start, frames: fault.frames.len(), fault: fault.fault.to_string() }
    }
}
