//! Crash counter: a job is skipped after three starts without an end.

use crate::digest::sha256_hex;
use crate::error::{Outcome, TaskError};
use std::fs::{self, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Number of starts without an end after which a job counts as failed.
pub(super) const MOST: usize = 3;

/// A folder with one file for each started job. The file has one line for each start, with the key.
pub(super) struct Attempts {
    folder: PathBuf,
}

/// A noted start, with the content of the job's file before it.
pub(super) struct Started {
    path: PathBuf,
    before: Vec<u8>,
}

impl Attempts {
    /// Opens the folder of attempts in the folder of the outputs.
    ///
    /// # Errors
    /// If the folder cannot be created.
    pub(super) fn open(outputs: &Path) -> Outcome<Self> {
        let folder = outputs.join(".attempts");
        fs::create_dir_all(&folder).map_err(|e| TaskError::io(&folder, &e))?;
        Ok(Self { folder })
    }

    fn path(&self, job: &str) -> PathBuf {
        self.folder.join(&sha256_hex(job.as_bytes())[..32])
    }

    /// Returns whether a start of the job has not ended.
    pub(super) fn is_suspect(&self, job: &str) -> bool {
        self.path(job).exists()
    }

    /// Notes a start. Returns `None` if the limit of unended starts with this key is reached.
    ///
    /// # Errors
    /// If the file cannot be read or written.
    pub(super) fn start(&self, job: &str, key: &str) -> Outcome<Option<Started>> {
        let path = self.path(job);
        let fail = |e: io::Error| TaskError::io(&path, &e);
        let before = match fs::read(&path) {
            Err(e) if e.kind() == io::ErrorKind::NotFound => Vec::new(),
            read => read.map_err(fail)?,
        };
        if before.split(|byte| *byte == b'\n').filter(|line| *line == key.as_bytes()).count() >= MOST {
            return Ok(None);
        }
        let mut file = OpenOptions::new().append(true).create(true).open(&path).map_err(fail)?;
        writeln!(file, "{key}").map_err(fail)?;
        Ok(Some(Started { path, before }))
    }

    /// Removes the starts of a job that has ended.
    pub(super) fn end(&self, job: &str) {
        // A file that remains counts as one more start, which does no harm.
        let _ = fs::remove_file(self.path(job));
    }
}

impl Started {
    /// Undoes a start that was cancelled.
    pub(super) fn take_back(self) {
        let Self { path, before } = self;
        // A failure does no harm, as above.
        let _ = if before.is_empty() { fs::remove_file(path) } else { fs::write(path, before) };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_job_is_started_three_times_until_it_ends_or_its_key_is_another() {
        let folder = tempfile::tempdir().unwrap();
        let attempts = Attempts::open(folder.path()).unwrap();
        let start = |key: &str| attempts.start("old/a.bvh", key).unwrap();
        assert!(!attempts.is_suspect("old/a.bvh"));
        for _ in 0..MOST {
            assert!(start("k").is_some());
        }
        assert!(start("k").is_none() && attempts.is_suspect("old/a.bvh"));
        start("other").unwrap().take_back();
        assert!(start("k").is_none());
        attempts.end("old/a.bvh");
        assert!(!attempts.is_suspect("old/a.bvh"));
        start("k").unwrap().take_back();
        assert!(!attempts.is_suspect("old/a.bvh"));
    }
}
