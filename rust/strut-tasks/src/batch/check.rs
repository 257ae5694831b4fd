//! Selection of the jobs that are not done yet.

use super::attempts::Attempts;
use super::jobs::Job;
use super::manifest::{Record, Status};
use super::request::BatchRequest;
use super::styling::VariantStyling;
use crate::digest::sha256_hex;
use crate::error::{Outcome, TaskError};
use crate::gather::Source;
use crate::progress::{Counter, OnProgress};
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};
use std::collections::{BTreeSet, HashMap};
use std::fs;

/// Inputs of the selection.
pub(super) struct Check<'a> {
    pub(super) request: &'a BatchRequest,
    pub(super) sources: &'a [Source],
    pub(super) stylings: &'a [VariantStyling],
    pub(super) known: &'a HashMap<String, Record>,
}

impl Check<'_> {
    /// Returns the pending jobs in their order. Jobs that may have crashed a process come last.
    pub(super) fn pending<'a>(&self, jobs: &'a [Job], on_progress: &OnProgress<'_>) -> Outcome<Vec<&'a Job>> {
        // Inputs of jobs without a record are read only when they are styled.
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
        if record.key != input.map(|input| self.stylings[job.variant].digests.key(input)) {
            return Ok(true);
        }
        match record.status {
            Status::Done => Ok(!self.is_there(record)?),
            status => Ok(self.request.retry.is_some_and(|retry| retry.includes(status))),
        }
    }

    /// Returns whether the output of a finished job is still the file that was written.
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
