//! A batch whose jobs are done by other threads, processes or machines that share the files.

use super::attempts::Attempts;
use super::check::Check;
use super::jobs::{Job, jobs, place};
use super::manifest::{self, Manifest, Record, now_ms};
use super::outputs;
use super::perform::{Known, Performer, record};
use super::request::BatchRequest;
use super::styling::{VariantStyling, stylings};
use super::workers::ending;
use crate::digest::sha256_hex;
use crate::error::{Outcome, TaskError};
use crate::gather::{Source, archive_of, gather};
use crate::progress::OnProgress;
use crate::search::Search;
use crate::suggestion::unknown;
use serde::{Deserialize, Serialize};
use std::fs;
use std::hash::{BuildHasher, RandomState};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use strut_core::transfer::Model;

/// Description of a job for a worker.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct PlannedJob {
    /// Name of the job: path of the output in the folder of the outputs.
    pub job: String,
    /// Path of the input.
    pub input: String,
    /// Name of the variant.
    pub variant: String,
}

/// The archive that was read last, with its sources.
type Archive = Option<(PathBuf, Arc<Vec<Source>>)>;

/// A batch with one driver, which asks for the pending jobs and records how they ended, and any number of workers,
/// which perform them. Each has its own plan, with the same request and database.
pub struct Plan {
    request: BatchRequest,
    stylings: Vec<VariantStyling>,
    /// Used by the driver; opened at the first use.
    manifest: Mutex<Option<Manifest>>,
    /// Used by a worker.
    archive: Mutex<Archive>,
}

impl Plan {
    /// Creates a plan for the database with this SHA-256. `open` opens the database for a kind of search. Nothing is
    /// read or written yet.
    ///
    /// # Errors
    /// If there are no variants, or the database lacks a style or an action, or cannot be opened.
    pub fn new(request: BatchRequest, sha256: &str, open: impl FnMut(Search) -> Outcome<Arc<Model>>) -> Outcome<Self> {
        if request.variants.is_empty() {
            return Err(TaskError::usage("no variant was given; at least one was expected"));
        }
        let stylings = stylings(&request, sha256, open)?;
        Ok(Self { request, stylings, manifest: Mutex::default(), archive: Mutex::default() })
    }

    /// Returns the SHA-256 of everything that outputs depend on apart from the inputs. It is equal for a driver and its
    /// workers.
    pub fn sha256(&self) -> String {
        let of = |variant: &VariantStyling| format!("{}\n{}", variant.name, variant.digests.key(""));
        sha256_hex(self.stylings.iter().map(of).collect::<Vec<_>>().join("\n").as_bytes())
    }

    /// Returns the pending jobs, for a driver. From then on no other process may write the manifest.
    ///
    /// # Errors
    /// Those of [`run()`](super::run()) before its first job.
    pub fn pending(&self, on_progress: &OnProgress<'_>) -> Outcome<Vec<PlannedJob>> {
        let Self { request, stylings, .. } = self;
        let sources = gather(&request.inputs)?;
        let jobs = jobs(&sources, &request.variants, request.shard)?;
        request.refuse_outputs_among_inputs()?;
        drop(self.manifest()?);
        let known = manifest::latest(&request.output)?;
        let check = Check { request, sources: &sources, stylings, known: &known };
        let pending = check.pending(&jobs, on_progress)?;
        let planned = |job: &Job| PlannedJob {
            job: job.output.clone(),
            input: sources[job.source].path.clone(),
            variant: stylings[job.variant].name.clone(),
        };
        Ok(pending.into_iter().map(planned).collect())
    }

    /// Does a job, for a worker: writes the output and returns the record. An unusable input or a fault is recorded in
    /// it, not returned as an error; the driver stores all records.
    ///
    /// # Errors
    /// If the disk is full, the caller cancels, or the job is not in this plan.
    pub fn perform(&self, job: &PlannedJob, on_progress: &OnProgress<'_>) -> Outcome<Record> {
        let PlannedJob { job: output, input, variant } = job;
        let known_variants: Vec<&str> = self.stylings.iter().map(|styling| styling.name.as_str()).collect();
        let styling = self.stylings.iter().find(|styling| styling.name == *variant);
        let styling = styling.ok_or_else(|| TaskError::usage(unknown("variant", variant, &known_variants)))?;
        let below = output.strip_prefix(variant.as_str()).and_then(|rest| rest.strip_prefix('/'));
        if below.is_none() || below.map(str::to_owned) != below.and_then(place) {
            return Err(TaskError::usage(format_args!("'{output}' is not a job of the variant '{variant}'")));
        }
        let folder = self.request.output.as_path();
        // A unique name, so that two writers of the same output never share a temporary file.
        let unique = RandomState::new().hash_one(output);
        let manifest = format!("{unique:016x}.{}", self.request.shard.manifest());
        let performer = Performer { folder, manifest, attempts: Attempts::open(folder)? };
        let mut known = Known::default();
        let performed = ending(|| {
            let (sources, index) = self.source(input)?;
            performer.perform((&sources[index], output), styling, &mut known, on_progress)
        })?;
        performer.attempts.end(output);
        Ok(record((output, input, variant), known, performed))
    }

    /// Records how jobs ended, for the driver. Each record gets the current time.
    ///
    /// # Errors
    /// If another process writes the manifest, or on an I/O error.
    pub fn record(&self, records: impl IntoIterator<Item = Record>) -> Outcome {
        let mut writer = self.manifest()?;
        for record in records {
            // Only the driver's clock decides which of several records is the latest.
            writer.iter_mut().try_for_each(|manifest| manifest.add(&Record { time_ms: now_ms(), ..record.clone() }))?;
        }
        Ok(())
    }

    /// Returns the manifest, opened if needed.
    fn manifest(&self) -> Outcome<MutexGuard<'_, Option<Manifest>>> {
        let mut manifest = self.manifest.lock().unwrap_or_else(PoisonError::into_inner);
        if manifest.is_none() {
            let (folder, shard) = (self.request.output.as_path(), self.request.shard);
            fs::create_dir_all(folder).map_err(|e| TaskError::io(folder, &e))?;
            let opened = Manifest::open(folder, shard)?;
            manifest::for_each_idle(folder, shard, |name| outputs::sweep(folder, name))?;
            *manifest = Some(opened);
        }
        Ok(manifest)
    }

    /// Returns the source with this path, among those of its file or archive.
    fn source(&self, path: &str) -> Outcome<(Arc<Vec<Source>>, usize)> {
        let Some(archive) = archive_of(Path::new(path)) else {
            return Ok((Arc::new(vec![Source::file(Path::new(path))]), 0));
        };
        let mut last = self.archive.lock().unwrap_or_else(PoisonError::into_inner);
        let sources = match &*last {
            Some((known, sources)) if known == archive => Arc::clone(sources),
            _ => Arc::new(gather(&[archive.to_owned()])?),
        };
        *last = Some((archive.to_owned(), Arc::clone(&sources)));
        let missing = || TaskError::in_file(archive, format_args!("there is no file '{path}' in the archive"));
        let index = sources.iter().position(|source| source.path == path).ok_or_else(missing)?;
        Ok((sources, index))
    }
}

impl Drop for Plan {
    fn drop(&mut self) {
        if let Some(manifest) = self.manifest.get_mut().unwrap_or_else(PoisonError::into_inner) {
            // A failure cannot be reported here. The records are written; only a power failure could lose the last
            // second.
            let _ = manifest.flush();
        }
    }
}
