//! The manifest: JSON lines that record how each job ended.
//!
//! `manifest.jsonl` has one writer, which holds a lock. Shards of a batch have their own files, and readers merge all
//! files of a folder. The latest record of a job counts. A truncated last line is ignored.

use super::shard::Shard;
use crate::error::{Outcome, TaskError};
use crate::note_report::NoteReport;
use fs4::fs_std::FileExt;
use serde::{Deserialize, Serialize};
use std::collections::HashMap;
use std::fs::{self, File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

/// Longest time until records are flushed to the disk.
const FLUSH: Duration = Duration::from_secs(1);

/// How a job ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Status {
    /// The output was written.
    Done,
    /// The input cannot be styled.
    Skipped,
    /// The system or the program failed.
    Failed,
}

impl Status {
    /// All statuses with their names in manifests.
    const NAMES: [(Self, &'static str); 3] =
        [(Self::Done, "done"), (Self::Skipped, "skipped"), (Self::Failed, "failed")];

    /// Returns the name in manifests.
    pub fn name(self) -> &'static str {
        Self::NAMES.iter().find(|(status, _)| *status == self).map_or("failed", |(_, name)| name)
    }

    /// Returns the status with this name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::NAMES.iter().find(|(_, known)| *known == name).map(|(status, _)| *status)
    }
}

/// Record of how a job ended, with its key.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Record {
    /// Name of the job: the variant, and the path of the output in its folder.
    pub job: String,
    /// SHA-256 of everything that the output depends on; `None` if the input could not be read.
    pub key: Option<String>,
    /// Path of the input.
    pub input: String,
    /// SHA-256 of the input.
    pub input_sha256: Option<String>,
    /// Name of the variant.
    pub variant: String,
    /// Path of the output below the folder of the outputs.
    pub output: String,
    /// SHA-256 of the output.
    pub output_sha256: Option<String>,
    /// Size of the output, bytes.
    pub bytes: Option<u64>,
    /// Number of frames of the output.
    pub frames: Option<u64>,
    /// Number of unusable input frames that were replaced.
    pub repaired: Option<u64>,
    /// Warnings about the output.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<NoteReport>,
    /// How the job ended.
    pub status: Status,
    /// Code of the error.
    pub code: Option<String>,
    /// Message of the error.
    pub message: Option<String>,
    /// Name and version of the program.
    pub version: String,
    /// When the job ended, milliseconds since 1970. The latest of several records counts.
    pub time_ms: u64,
}

/// Milliseconds since 1970.
pub(super) fn now_ms() -> u64 {
    SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |time| time.as_millis() as u64)
}

/// The manifest of a shard, open for writing.
pub(super) struct Manifest {
    path: PathBuf,
    file: File,
    /// The lock, held until it is dropped.
    _lock: File,
    flushed: Instant,
}

impl Manifest {
    /// Opens the manifest in a folder for writing.
    ///
    /// # Errors
    /// If another process writes the manifest, or on an I/O error.
    pub(super) fn open(folder: &Path, shard: Shard) -> Outcome<Self> {
        let name = shard.manifest();
        let path = folder.join(format!("{name}.jsonl"));
        let fail = |e: io::Error| TaskError::io(&path, &e);
        let Some(lock) = try_lock(folder, &name).map_err(fail)? else {
            let hint = "wait until it ends, or divide the jobs with --shard";
            return Err(TaskError::in_file(&path, "another process writes this manifest").with_hint(hint));
        };
        cut_torn_line(&path).map_err(fail)?;
        let file = OpenOptions::new().append(true).create(true).open(&path).map_err(fail)?;
        Ok(Self { path, file, _lock: lock, flushed: Instant::now() })
    }

    /// Adds a record.
    ///
    /// # Errors
    /// On an I/O error.
    pub(super) fn add(&mut self, record: &Record) -> Outcome {
        let mut line = serde_json::to_string(record).map_err(|e| TaskError::of(crate::Code::Fault, e))?;
        line.push('\n');
        self.file.write_all(line.as_bytes()).map_err(|e| TaskError::io(&self.path, &e))?;
        if self.flushed.elapsed() >= FLUSH { self.flush() } else { Ok(()) }
    }

    /// Flushes all records to the disk.
    ///
    /// # Errors
    /// On an I/O error.
    pub(super) fn flush(&mut self) -> Outcome {
        self.flushed = Instant::now();
        self.file.sync_data().map_err(|e| TaskError::io(&self.path, &e))
    }
}

/// Locks a manifest. Returns `None` if another process holds the lock.
fn try_lock(folder: &Path, manifest: &str) -> io::Result<Option<File>> {
    // A separate lock file: where locks are mandatory, other processes may still read the manifest.
    let path = folder.join(format!(".{manifest}.lock"));
    let lock = OpenOptions::new().write(true).create(true).truncate(false).open(path)?;
    Ok(lock.try_lock_exclusive()?.then_some(lock))
}

/// Removes an unterminated last line, which an interrupted writer leaves.
fn cut_torn_line(path: &Path) -> io::Result<()> {
    let bytes = match fs::read(path) {
        Err(e) if e.kind() == io::ErrorKind::NotFound => return Ok(()),
        read => read?,
    };
    let whole = bytes.iter().rposition(|byte| *byte == b'\n').map_or(0, |at| at + 1);
    if whole < bytes.len() { OpenOptions::new().write(true).open(path)?.set_len(whole as u64) } else { Ok(()) }
}

/// Returns the names of the manifests in a folder, without the extension.
fn names(folder: &Path) -> io::Result<Vec<String>> {
    let mut names = Vec::new();
    for entry in fs::read_dir(folder)? {
        let name = entry?.file_name().to_string_lossy().into_owned();
        let stem = name.strip_suffix(".jsonl").filter(|stem| *stem == "manifest" || stem.starts_with("manifest-"));
        names.extend(stem.map(str::to_owned));
    }
    names.sort();
    Ok(names)
}

/// Returns the latest record of every job in all manifests of a folder. Invalid lines are ignored: their jobs are done
/// again.
///
/// # Errors
/// On an I/O error.
pub(super) fn latest(folder: &Path) -> Outcome<HashMap<String, Record>> {
    let mut latest: HashMap<String, Record> = HashMap::new();
    for name in names(folder).map_err(|e| TaskError::io(folder, &e))? {
        let path = folder.join(format!("{name}.jsonl"));
        let bytes = fs::read(&path).map_err(|e| TaskError::io(&path, &e))?;
        for record in bytes.split(|byte| *byte == b'\n').filter_map(|line| serde_json::from_slice::<Record>(line).ok())
        {
            if latest.get(&record.job).is_none_or(|known| known.time_ms <= record.time_ms) {
                latest.insert(record.job.clone(), record);
            }
        }
    }
    Ok(latest)
}

/// Calls `sweep` with the name of each manifest of a folder that no other process writes, this process's own included.
///
/// # Errors
/// On an I/O error.
pub(super) fn for_each_idle(folder: &Path, own: Shard, mut sweep: impl FnMut(&str) -> Outcome) -> Outcome {
    let fail = |e: io::Error| TaskError::io(folder, &e);
    sweep(&own.manifest())?;
    for name in names(folder).map_err(fail)?.into_iter().filter(|name| *name != own.manifest()) {
        // The lock is held during the sweep.
        if let Some(_lock) = try_lock(folder, &name).map_err(fail)? {
            sweep(&name)?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(job: &str, key: &str, time_ms: u64) -> Record {
        Record {
            job: job.to_owned(),
            key: Some(key.to_owned()),
            input: "in.bvh".into(),
            input_sha256: None,
            variant: "old".into(),
            output: job.to_owned(),
            output_sha256: None,
            bytes: Some(1),
            frames: None,
            repaired: None,
            notes: Vec::new(),
            status: Status::Done,
            code: None,
            message: None,
            version: "test".into(),
            time_ms,
        }
    }

    #[test]
    fn the_latest_record_of_a_job_counts_whichever_manifest_has_it() {
        let folder = tempfile::tempdir().unwrap();
        let mut whole = Manifest::open(folder.path(), Shard::WHOLE).unwrap();
        whole.add(&record("a", "1", 10)).unwrap();
        whole.add(&record("a", "2", 20)).unwrap();
        whole.add(&record("b", "1", 40)).unwrap();
        let mut share = Manifest::open(folder.path(), "1/2".parse().unwrap()).unwrap();
        share.add(&record("b", "3", 30)).unwrap();
        share.add(&record("a", "3", 30)).unwrap();
        let latest = latest(folder.path()).unwrap();
        let key = |job: &str| latest[job].key.clone().unwrap();
        assert_eq!((key("a"), key("b")), ("3".into(), "1".into()));
    }

    #[test]
    fn a_line_that_was_cut_off_is_left_out_and_the_next_one_is_whole() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("manifest.jsonl");
        let mut manifest = Manifest::open(folder.path(), Shard::WHOLE).unwrap();
        manifest.add(&record("a", "1", 10)).unwrap();
        manifest.add(&record("b", "1", 10)).unwrap();
        drop(manifest);
        let text = fs::read_to_string(&path).unwrap();
        fs::write(&path, &text[..text.len() - 5]).unwrap();
        assert_eq!(latest(folder.path()).unwrap().len(), 1);

        let mut manifest = Manifest::open(folder.path(), Shard::WHOLE).unwrap();
        manifest.add(&record("c", "1", 10)).unwrap();
        let records = latest(folder.path()).unwrap();
        assert!(records.len() == 2 && records.contains_key("a") && records.contains_key("c"), "{records:?}");
    }

    #[test]
    fn a_manifest_has_one_writer() {
        let folder = tempfile::tempdir().unwrap();
        let first = Manifest::open(folder.path(), Shard::WHOLE).unwrap();
        let second = Manifest::open(folder.path(), Shard::WHOLE).err().unwrap();
        assert!(second.to_string().contains("another process writes this manifest; wait"), "{second}");
        assert!(Manifest::open(folder.path(), "1/2".parse().unwrap()).is_ok());
        drop(first);
        assert!(Manifest::open(folder.path(), Shard::WHOLE).is_ok());
    }
}
