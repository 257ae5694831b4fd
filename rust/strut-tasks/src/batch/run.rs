//! A run of a batch, which does the pending jobs.

use super::attempts::Attempts;
use super::check::Check;
use super::jobs::{Job, jobs};
use super::manifest::{self, Manifest, Record, Status};
use super::outputs;
use super::perform::{Known, Performer, Written, record};
use super::request::BatchRequest;
use super::styling::{VariantStyling, stylings};
use super::workers::{Ending, work};
use crate::clip::Opened;
use crate::digest::sha256_hex;
use crate::error::{Code, Outcome, TaskError};
use crate::files;
use crate::gather::{Source, gather};
use crate::progress::{Counter, OnProgress};
use crate::threads::check_threads;
use serde::Serialize;
use std::collections::HashMap;
use std::fs;
use std::num::NonZero;
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;
use strut_formats::strutdb;

/// Number of frames between two checks for cancellation.
const FRAMES_BETWEEN_CHECKS: usize = 32;

/// A job without an output.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Problem {
    /// Name of the job.
    pub job: String,
    /// Path of the input.
    pub input: String,
    /// Skipped or failed.
    pub status: Status,
    /// Code of the error.
    pub code: String,
    /// Message of the error.
    pub message: String,
}

/// State of the shard after a run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BatchReport {
    /// Number of jobs of the shard.
    pub jobs: usize,
    /// Number of jobs whose outputs exist.
    pub done: usize,
    /// Number of those that this run did.
    pub styled: usize,
    /// Number of jobs whose input cannot be styled.
    pub skipped: usize,
    /// Number of jobs that failed because of the system or the program.
    pub failed: usize,
    /// Number of frames that this run wrote.
    pub frames: u64,
    /// Duration of the run, seconds.
    pub seconds: f64,
    /// The jobs without an output, by name.
    pub problems: Vec<Problem>,
}

/// Does all pending jobs.
///
/// # Errors
/// If the request cannot be carried out: missing inputs, variants or styles, colliding outputs, another writer; if the
/// disk is full; or if the caller cancels. Jobs that were done until then stay done.
pub fn run(request: &BatchRequest, on_progress: &OnProgress<'_>) -> Outcome<BatchReport> {
    let begin = Instant::now();
    let folder = request.output.as_path();
    let sources = gather(&request.inputs)?;
    let jobs = jobs(&sources, &request.variants, request.shard)?;
    request.refuse_outputs_among_inputs()?;
    let database = files::read(&request.database, strutdb::KIND.max_bytes)?;
    let stylings = stylings(request, &sha256_hex(&database), |search| {
        let contents = strutdb::read(&*database).map_err(|reason| TaskError::in_file(&request.database, reason))?;
        Ok(Arc::new(Opened::new(contents, search).model))
    })?;
    drop(database);
    // The request is validated completely before anything is written.
    fs::create_dir_all(folder).map_err(|e| TaskError::io(folder, &e))?;
    let mut manifest = Manifest::open(folder, request.shard)?;
    manifest::for_each_idle(folder, request.shard, |name| outputs::sweep(folder, name))?;

    let known = manifest::latest(folder)?;
    let pending = {
        let check = Check { request, sources: &sources, stylings: &stylings, known: &known };
        check.pending(&jobs, on_progress)?
    };
    if !pending.is_empty() {
        let batch = Batch { request, sources: &sources, stylings: &stylings };
        let result = batch.perform(&pending, &mut manifest, on_progress);
        manifest.flush()?;
        result.map_err(|error| with_rest(error, folder, &jobs))?;
    }
    Ok(report(&jobs, &pending, &manifest::latest(folder)?, begin.elapsed().as_secs_f64()))
}

/// Adds a hint with the number of finished jobs to an error that ends a batch.
fn with_rest(error: TaskError, folder: &Path, jobs: &[Job]) -> TaskError {
    if !matches!(error.code, Code::Cancelled | Code::Io(_)) {
        return error;
    }
    let done = manifest::latest(folder).map_or(0, |known| jobs.iter().filter(|job| is_done(&known, job)).count());
    error.with_hint(format_args!("{done} of {} jobs are done; run the same command again to continue", jobs.len()))
}

fn is_done(known: &HashMap<String, Record>, job: &Job) -> bool {
    known.get(&job.output).is_some_and(|record| record.status == Status::Done)
}

/// A batch with pending jobs.
struct Batch<'a> {
    request: &'a BatchRequest,
    sources: &'a [Source],
    stylings: &'a [VariantStyling],
}

impl Batch<'_> {
    fn perform(&self, pending: &[&Job], manifest: &mut Manifest, on_progress: &OnProgress<'_>) -> Outcome {
        let folder = self.request.output.as_path();
        let attempts = Attempts::open(folder)?;
        let performer = Performer { folder, manifest: self.request.shard.manifest(), attempts };
        let available = || std::thread::available_parallelism().unwrap_or(NonZero::<usize>::MIN);
        let threads = self.request.threads.unwrap_or_else(available);
        check_threads(threads.get())?;
        let counter = Counter::new("styling", pending.len(), on_progress);
        counter.check()?;
        let manifest = Mutex::new(manifest);
        let perform = |number: usize, known: &mut Known| {
            let Job { output, source, variant } = pending[number];
            performer.perform((&self.sources[*source], output), &self.stylings[*variant], known, &|frame| match frame
                .done
                % FRAMES_BETWEEN_CHECKS
            {
                0 => counter.check().map_or(std::ops::ControlFlow::Break(()), std::ops::ControlFlow::Continue),
                _ => std::ops::ControlFlow::Continue(()),
            })
        };
        let conclude = |number: usize, known: Known, ending: Ending<Written>| {
            let job = pending[number];
            let (input, variant) = (&self.sources[job.source].path, &self.stylings[job.variant].name);
            let record = record((&job.output, input, variant), known, ending);
            // Before the record: a process that is killed in between does the job again, and leaves no start behind.
            performer.attempts.end(&job.output);
            manifest.lock().unwrap_or_else(PoisonError::into_inner).add(&record)?;
            counter.step()
        };
        work(pending.len(), threads, perform, conclude)
    }
}

/// Returns the report of the records.
fn report(jobs: &[Job], pending: &[&Job], known: &HashMap<String, Record>, seconds: f64) -> BatchReport {
    let records = || jobs.iter().filter_map(|job| known.get(&job.output));
    let count = |status| records().filter(|record| record.status == status).count();
    let styled = || pending.iter().filter(|job| is_done(known, job)).filter_map(|job| known.get(&job.output));
    let mut problems: Vec<Problem> = records()
        .filter(|record| record.status != Status::Done)
        .map(|record| Problem {
            job: record.job.clone(),
            input: record.input.clone(),
            status: record.status,
            code: record.code.clone().unwrap_or_default(),
            message: record.message.clone().unwrap_or_default(),
        })
        .collect();
    problems.sort_by(|a, b| a.job.cmp(&b.job));
    BatchReport {
        jobs: jobs.len(),
        done: count(Status::Done),
        styled: styled().count(),
        skipped: count(Status::Skipped),
        failed: count(Status::Failed),
        frames: styled().filter_map(|record| record.frames).sum(),
        seconds,
        problems,
    }
}
