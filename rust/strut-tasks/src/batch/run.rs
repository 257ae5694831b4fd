//! A run of a batch: what is not done yet.

use super::attempts::Attempts;
use super::jobs::{Job, jobs};
use super::key::Digests;
use super::manifest::{self, Manifest, Record, Status, now_ms};
use super::outputs;
use super::perform::{Known, Performer, Written};
use super::shard::Shard;
use super::variants::Variant;
use super::workers::{Ending, work};
use crate::clip::Opened;
use crate::digest::sha256_hex;
use crate::error::{Code, Outcome, TaskError};
use crate::files;
use crate::gather::{Source, gather};
use crate::progress::{Counter, OnProgress};
use crate::search::Search;
use crate::stylize::Styling;
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};
use serde::Serialize;
use std::collections::{BTreeSet, HashMap};
use std::fs;
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;
use strut_core::transfer::Model;
use strut_formats::{GENERATOR, strutdb};

/// Frames after which a job asks whether to go on.
const FRAMES_BETWEEN_CHECKS: usize = 32;

/// Which jobs that ended otherwise than done are done again.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[allow(missing_docs)] // Their names say it, and comments would be the help of the command.
pub enum Retry {
    Failed,
    Skipped,
    All,
}

impl Retry {
    fn includes(self, status: Status) -> bool {
        match status {
            Status::Done => false,
            Status::Skipped => matches!(self, Self::Skipped | Self::All),
            Status::Failed => matches!(self, Self::Failed | Self::All),
        }
    }
}

/// What to do.
#[derive(Clone, Debug)]
pub struct BatchRequest {
    /// BVH files, folders with all below them, archives.
    pub inputs: Vec<PathBuf>,
    /// The database.
    pub database: PathBuf,
    /// What every input becomes.
    pub variants: Vec<Variant>,
    /// Folder of the outputs.
    pub output: PathBuf,
    /// The share of the jobs that is this run's.
    pub shard: Shard,
    /// Threads that work; one a processor if `None`.
    pub threads: Option<NonZero<usize>>,
    /// What did not work before and is done again.
    pub retry: Option<Retry>,
    /// Whether outputs are compared with what was recorded by their content, not by their size alone.
    pub verify: bool,
}

/// A job without an output.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Problem {
    /// Name of the job.
    pub job: String,
    /// Path of the input.
    pub input: String,
    /// Skipped or failed.
    pub status: Status,
    /// Kind of the error.
    pub code: String,
    /// What the error was.
    pub message: String,
}

/// How things are after a run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BatchReport {
    /// All jobs of the share.
    pub jobs: usize,
    /// Jobs whose outputs are there.
    pub done: usize,
    /// Those of them that this run did.
    pub styled: usize,
    /// Jobs whose input cannot be styled.
    pub skipped: usize,
    /// Jobs that the system or the program failed to do.
    pub failed: usize,
    /// Frames that this run wrote.
    pub frames: u64,
    /// How long it took, seconds.
    pub seconds: f64,
    /// The jobs without an output, by name.
    pub problems: Vec<Problem>,
}

/// Does all jobs that are not done yet.
///
/// # Errors
/// If the request cannot be carried out: inputs, variants or styles that do not exist, outputs that collide, another writer;
/// if the disk is full; or if the caller cancels. What was done until then stays done.
pub fn run(request: &BatchRequest, on_progress: &OnProgress<'_>) -> Outcome<BatchReport> {
    let begin = Instant::now();
    let folder = request.output.as_path();
    let sources = gather(&request.inputs)?;
    let jobs = jobs(&sources, &request.variants, request.shard)?;
    refuse_outputs_among_inputs(request)?;
    let database = files::read(&request.database, strutdb::KIND.max_bytes)?;
    let digests = digests(request, &database)?;
    let stylings = stylings(request, &database)?;
    drop(database);
    // Nothing is written before all that can be wrong with the request is known.
    fs::create_dir_all(folder).map_err(|e| TaskError::io(folder, &e))?;
    let mut manifest = Manifest::open(folder, request.shard)?;
    manifest::for_each_idle(folder, request.shard, |name| outputs::sweep(folder, name))?;

    let known = manifest::latest(folder)?;
    let pending = {
        let check = Check { request, sources: &sources, digests: &digests, known: &known };
        check.pending(&jobs, on_progress)?
    };
    if !pending.is_empty() {
        let batch = Batch { request, sources: &sources, digests: &digests, stylings: &stylings };
        let result = batch.perform(&pending, &mut manifest, on_progress);
        manifest.flush()?;
        result.map_err(|error| with_rest(error, folder, &jobs))?;
    }
    Ok(report(&jobs, &pending, &manifest::latest(folder)?, begin.elapsed().as_secs_f64()))
}

/// A second run would take outputs for inputs.
fn refuse_outputs_among_inputs(request: &BatchRequest) -> Outcome {
    let absolute = std::path::absolute(&request.output).map_err(|e| TaskError::io(&request.output, &e))?;
    // As much of it as there is.
    let output = absolute.ancestors().find_map(|path| path.canonicalize().ok()).unwrap_or_default();
    for input in request.inputs.iter().filter(|input| input.is_dir()) {
        if output.starts_with(input.canonicalize().map_err(|e| TaskError::io(input, &e))?) {
            let reason = format_args!("it lies in the input {}; another folder was expected", input.display());
            return Err(TaskError::of(Code::BadInput, format_args!("{}: {reason}", request.output.display())));
        }
    }
    Ok(())
}

/// What the outputs of each variant depend on.
fn digests(request: &BatchRequest, database: &[u8]) -> Outcome<Vec<Digests>> {
    let database = sha256_hex(database);
    let of = |variant: &Variant| Ok(Digests::new(&database, &variant.settings.canonical()?));
    request.variants.iter().map(of).collect()
}

/// How each variant styles.
fn stylings(request: &BatchRequest, database: &[u8]) -> Outcome<Vec<Styling>> {
    let path = &request.database;
    let mut models: Vec<(Search, Arc<Model>)> = Vec::new();
    let mut stylings = Vec::new();
    for Variant { settings, .. } in &request.variants {
        let known = models.iter().find(|(search, _)| *search == settings.search).map(|(_, model)| Arc::clone(model));
        let model = if let Some(model) = known {
            model
        } else {
            let contents = strutdb::read(database).map_err(|reason| TaskError::in_file(path, reason))?;
            let model = Arc::new(Opened::new(contents, settings.search).model);
            models.push((settings.search, Arc::clone(&model)));
            model
        };
        stylings.push(Styling::new(settings.stylizer(&model, path)?));
    }
    Ok(stylings)
}

/// An error that ends a batch, with what comes of the rest.
fn with_rest(error: TaskError, folder: &Path, jobs: &[Job]) -> TaskError {
    if !matches!(error.code, Code::Cancelled | Code::Io(_)) {
        return error;
    }
    let done = manifest::latest(folder).map_or(0, |known| jobs.iter().filter(|job| is_done(&known, job)).count());
    error.with_hint(format_args!("{done} of {} jobs are done, and the same command goes on with the rest", jobs.len()))
}

fn is_done(known: &HashMap<String, Record>, job: &Job) -> bool {
    known.get(&job.output).is_some_and(|record| record.status == Status::Done)
}

/// What there is to know before the first job.
struct Check<'a> {
    request: &'a BatchRequest,
    sources: &'a [Source],
    digests: &'a [Digests],
    known: &'a HashMap<String, Record>,
}

impl Check<'_> {
    /// The jobs to do, in their order; those that may have brought a process down come last.
    fn pending<'a>(&self, jobs: &'a [Job], on_progress: &OnProgress<'_>) -> Outcome<Vec<&'a Job>> {
        // Inputs of jobs without a record are read once, when they are styled.
        let recorded: BTreeSet<usize> =
            jobs.iter().filter(|job| self.known.contains_key(&job.output)).map(|job| job.source).collect();
        let recorded: Vec<usize> = recorded.into_iter().collect();
        let counter = Counter::new("checking", recorded.len(), on_progress);
        let digest = |&source: &usize| {
            counter.step()?;
            Ok((source, self.sources[source].bytes().ok().map(|bytes| sha256_hex(&bytes))))
        };
        let inputs: HashMap<usize, Option<String>> = recorded.par_iter().map(digest).collect::<Outcome<_>>()?;
        let is_pending = |job: &&Job| match self.known.get(&job.output) {
            None => Ok(true),
            Some(record) => self.is_pending(job, record, inputs.get(&job.source).and_then(Option::as_deref)),
        };
        let states: Vec<bool> = jobs.par_iter().map(|job| is_pending(&job)).collect::<Outcome<_>>()?;
        let attempts = Attempts::open(&self.request.output)?;
        let pending = jobs.iter().zip(states).filter_map(|(job, is_pending)| is_pending.then_some(job));
        let (suspects, mut pending): (Vec<&Job>, Vec<&Job>) = pending.partition(|job| attempts.is_suspect(&job.output));
        pending.extend(suspects);
        Ok(pending)
    }

    fn is_pending(&self, job: &Job, record: &Record, input: Option<&str>) -> Outcome<bool> {
        if record.key != input.map(|input| self.digests[job.variant].key(input)) {
            return Ok(true);
        }
        match record.status {
            Status::Done => Ok(!self.is_there(record)?),
            status => Ok(self.request.retry.is_some_and(|retry| retry.includes(status))),
        }
    }

    /// Whether the output of a job that is done is still what was written.
    fn is_there(&self, record: &Record) -> Outcome<bool> {
        let path = self.request.output.join(&record.output);
        let size = fs::metadata(&path).ok().filter(fs::Metadata::is_file).map(|file| file.len());
        if size.is_none() || size != record.bytes {
            return Ok(false);
        }
        if !self.request.verify {
            return Ok(true);
        }
        let bytes = fs::read(&path).map_err(|e| TaskError::io(&path, &e))?;
        Ok(record.output_sha256.as_deref() == Some(&sha256_hex(&bytes)))
    }
}

/// A batch with something to do.
struct Batch<'a> {
    request: &'a BatchRequest,
    sources: &'a [Source],
    digests: &'a [Digests],
    stylings: &'a [Styling],
}

impl Batch<'_> {
    fn perform(&self, pending: &[&Job], manifest: &mut Manifest, on_progress: &OnProgress<'_>) -> Outcome {
        let folder = self.request.output.as_path();
        let attempts = Attempts::open(folder)?;
        let performer = Performer { folder, manifest: self.request.shard.manifest(), attempts };
        let available = || std::thread::available_parallelism().unwrap_or(NonZero::<usize>::MIN);
        let threads = self.request.threads.unwrap_or_else(available);
        let counter = Counter::new("styling", pending.len(), on_progress);
        counter.check()?;
        let manifest = Mutex::new(manifest);
        let perform = |number: usize, known: &mut Known| {
            let Job { output, source, variant } = pending[number];
            performer.perform(
                (&self.sources[*source], output),
                (&self.stylings[*variant], &self.digests[*variant]),
                known,
                &|frame| match frame.done % FRAMES_BETWEEN_CHECKS {
                    0 => counter.check().map_or(std::ops::ControlFlow::Break(()), std::ops::ControlFlow::Continue),
                    _ => std::ops::ControlFlow::Continue(()),
                },
            )
        };
        let conclude = |number: usize, known: Known, ending: Ending<Written>| {
            let job = pending[number];
            let record = self.record(job, known, ending);
            manifest.lock().unwrap_or_else(PoisonError::into_inner).add(&record)?;
            performer.attempts.end(&job.output);
            counter.step()
        };
        work(pending.len(), threads, perform, conclude)
    }

    fn record(&self, job: &Job, known: Known, ending: Ending<Written>) -> Record {
        let (status, written, error) = match ending {
            Ending::Done(written) => (Status::Done, Some(written), None),
            Ending::Skipped(error) => (Status::Skipped, None, Some(error)),
            Ending::Failed(error) => (Status::Failed, None, Some(error)),
        };
        Record {
            job: job.output.clone(),
            key: known.key,
            input: self.sources[job.source].path.clone(),
            input_sha256: known.input,
            variant: self.request.variants[job.variant].name.clone(),
            output: job.output.clone(),
            output_sha256: written.as_ref().map(|written| written.sha256.clone()),
            bytes: written.as_ref().map(|written| written.bytes),
            frames: written.as_ref().map(|written| written.frames),
            repaired: written.as_ref().map(|written| written.repaired),
            status,
            code: error.as_ref().map(|error| error.code.name().to_owned()),
            message: error.map(|error| error.to_string()),
            version: GENERATOR.to_owned(),
            time_ms: now_ms(),
        }
    }
}

/// How things are, from the records.
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
