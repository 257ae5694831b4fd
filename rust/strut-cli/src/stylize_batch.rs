//! `strut stylize-batch`: many clips in many styles, exactly once each.

use crate::print::{print, print_warnings};
use crate::progress::Bar;
use crate::read_args::ReadArgs;
use crate::style_args::StyleArgs;
use clap::ArgGroup;
use std::fmt::Write;
use std::num::NonZero;
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use strut_tasks::batch::{BatchReport, BatchRequest, Retry, Shard, Status, Variant, read_variants, run as run_batch};
use strut_tasks::files::Outputs;
use strut_tasks::stylize::StyleSettings;
use strut_tasks::weights::StyleWeights;
use strut_tasks::{Outcome, TaskError};

/// Greatest number of printed problems; the manifest has all.
const MOST_PRINTED: usize = 10;

/// Help on the outputs and the exit codes.
const LONG_HELP: &str = "\
Outputs: DIR/VARIANT/PATH.bvh. PATH is the path of the input below the given folder or in the
given archive. With --style, VARIANT is the text of that option, with + for commas. A table of
--variants has the columns variant,style[,option…]. An option column has the name of a long option
of this command. For an empty cell, the option of the command line is used.

DIR/manifest.jsonl has one line for every job that ended: job, key (SHA-256 of version, database,
options and input), input, input_sha256, variant, output, output_sha256, bytes, frames, repaired,
notes, status, code, message, version, time_ms. The last line of a job is valid. Run the same
command again to do the missing jobs: after Ctrl-C, a crash or new inputs.

A job ends as done; as skipped, if the input cannot be styled; or as failed, after an error of the
system or a bug: reading or writing failed twice, a panic, or three starts without an end. The
other jobs continue. --retry repeats such jobs.

--shard I/N runs the I-th of N shares of the jobs and writes a separate manifest, for example for
each task of a Slurm array.

The report of --json: jobs, done, styled (by this run), skipped, failed, frames, seconds, problems
[{job, input, status, code, message}]. Exit codes: 0 done, also with skipped jobs unless --strict;
1 with failed jobs; 130 after Ctrl-C.";

/// Style many BVH files in one or several styles, each exactly once
///
/// If it was interrupted, run the same command again to continue.
#[derive(clap::Args)]
#[command(after_long_help = LONG_HELP)]
#[command(group = ArgGroup::new("what").args(["style", "variants"]).required(true))]
pub(crate) struct Args {
    /// .bvh files, folders (searched recursively) and .zip archives
    #[arg(required = true, value_name = "INPUT")]
    inputs: Vec<PathBuf>,
    /// The database
    #[arg(long, value_name = "DB")]
    db: PathBuf,
    /// Styles with their weights, as in stylize
    #[arg(long, value_name = "NAME[=W][,NAME=W…]")]
    style: Option<String>,
    /// A table of variants; every input is styled in every variant
    #[arg(long, value_name = "CSV")]
    variants: Option<PathBuf>,
    /// The folder to write into
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    #[command(flatten)]
    options: StyleArgs,
    #[command(flatten)]
    reading: ReadArgs,
    /// Run one of several shares of the jobs
    #[arg(long, value_name = "I/N", default_value = "1/1")]
    shard: Shard,
    /// Number of threads [default: one per processor core]. The outputs do not depend on it
    #[arg(long, value_name = "N")]
    threads: Option<NonZero<usize>>,
    /// Repeat jobs that failed or were skipped
    #[arg(long)]
    retry: Option<Retry>,
    /// Check that existing outputs are unchanged since they were written
    #[arg(long)]
    verify: bool,
    /// Exit with 1 if a job was skipped
    #[arg(long)]
    strict: bool,
    /// Write a report as JSON
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
}

/// Whether the user or the system has requested a stop.
static STOPPED: AtomicBool = AtomicBool::new(false);

pub(crate) fn run(args: &Args) -> Outcome {
    Outputs::check(args.json.as_deref())?;
    let request = BatchRequest {
        inputs: args.inputs.clone(),
        database: args.db.clone(),
        variants: variants(args)?,
        output: args.output.clone(),
        shard: args.shard,
        threads: args.threads,
        retry: args.retry,
        verify: args.verify,
    };
    ctrlc::set_handler(|| STOPPED.store(true, Ordering::Relaxed)).map_err(TaskError::new)?;
    let report = Bar::watching(|on_progress| {
        run_batch(&request, &|progress| {
            if STOPPED.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { on_progress(progress) }
        })
    })?;
    let mut outputs = Outputs::default();
    outputs.stage_json(args.json.as_deref(), &report)?;
    outputs.commit()?;
    print(&summary(args, &report));
    print_warnings(&problems(&report));
    verdict(args, &report)
}

fn variants(args: &Args) -> Outcome<Vec<Variant>> {
    let reading = args.reading.reading()?;
    let settings = |styles| Ok(StyleSettings { reading: reading.clone(), ..args.options.settings(styles)? });
    if let Some(table) = &args.variants {
        return read_variants(table, settings);
    }
    let typed = args.style.as_deref().unwrap_or_default();
    let styles: StyleWeights = typed.parse().map_err(TaskError::usage)?;
    Ok(vec![Variant::of_styles(typed, settings(styles)?)?])
}

fn summary(args: &Args, report: &BatchReport) -> String {
    let BatchReport { jobs, done, styled, skipped, failed, frames, seconds, .. } = report;
    let without = match (skipped, failed) {
        (0, 0) => String::new(),
        _ => format!(", {skipped} skipped, {failed} failed"),
    };
    let output = args.output.display();
    format!("{output}: {done} of {jobs} jobs done{without}; {styled} now, {frames} frames in {seconds:.1} s\n")
}

fn problems(report: &BatchReport) -> String {
    let mut text = String::new();
    for problem in report.problems.iter().take(MOST_PRINTED) {
        let status = if problem.status == Status::Skipped { "skipped" } else { "failed" };
        // Writing to a string cannot fail.
        let _ = writeln!(text, "warning: {status} {}: {}", problem.job, problem.message);
    }
    match report.problems.len().saturating_sub(MOST_PRINTED) {
        0 => text,
        more => text + &format!("warning: the manifest names {more} more\n"),
    }
}

/// Returns an error if the outcome is not as requested.
fn verdict(args: &Args, report: &BatchReport) -> Outcome {
    let BatchReport { jobs, skipped, failed, .. } = report;
    let fail = |reason: String| Err(TaskError::in_file(&args.output, reason));
    if *failed > 0 {
        return fail(format!("{failed} of {jobs} jobs failed; repeat them with --retry failed"));
    }
    if *skipped > 0 && args.strict {
        return fail(format!("{skipped} of {jobs} jobs were skipped, which --strict does not allow"));
    }
    Ok(())
}
