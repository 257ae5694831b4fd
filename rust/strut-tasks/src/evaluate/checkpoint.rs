//! Checkpoints: samples saved during an evaluation, so that a stopped one can be resumed.

use super::results::Sample;
use crate::error::{Outcome, TaskError};
use crate::files;
use serde::{Deserialize, Serialize};
use std::collections::HashMap;
use std::fs::{self, File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use strut_formats::GENERATOR;

/// Greatest size of a checkpoint, bytes.
const MAX_BYTES: usize = 1 << 30;

/// Lines of JSON beside the results: first the command line, then one line a unit of work.
pub(super) struct Checkpoint {
    done: HashMap<String, Vec<Sample>>,
    file: Option<(PathBuf, Mutex<File>)>,
}

#[derive(PartialEq, Serialize, Deserialize)]
struct Header {
    generator: String,
    command: String,
}

#[derive(Serialize, Deserialize)]
struct Unit {
    unit: String,
    samples: Vec<Sample>,
}

impl Checkpoint {
    /// Opens the checkpoint of a results file; one of another command or version is discarded. Without a results file
    /// nothing is saved.
    pub(super) fn open(results: Option<&Path>, command: &str) -> Outcome<Self> {
        let Some(results) = results else { return Ok(Self { done: HashMap::new(), file: None }) };
        let mut name = results.file_name().unwrap_or_default().to_owned();
        name.push(".partial");
        let path = results.with_file_name(name);
        let header = Header { generator: GENERATOR.to_owned(), command: command.to_owned() };
        let done = files::read(&path, MAX_BYTES).ok().and_then(|bytes| samples(&bytes, &header)).unwrap_or_default();
        let fail = |e: std::io::Error| TaskError::io(&path, &e);
        // Written anew, since the last line may have been cut off.
        let mut file = OpenOptions::new().write(true).create(true).truncate(true).open(&path).map_err(fail)?;
        writeln!(file, "{}", serde_json::to_string(&header).map_err(TaskError::new)?).map_err(fail)?;
        let checkpoint = Self { done: HashMap::new(), file: Some((path, Mutex::new(file))) };
        for (unit, samples) in &done {
            checkpoint.keep(unit, samples)?;
        }
        Ok(Self { done, ..checkpoint })
    }

    /// The samples of a unit of work, if it is done.
    pub(super) fn done(&self, unit: &str) -> Option<&Vec<Sample>> {
        self.done.get(unit)
    }

    /// Keeps the samples of a unit of work.
    pub(super) fn keep(&self, unit: &str, samples: &[Sample]) -> Outcome {
        let Some((path, file)) = &self.file else { return Ok(()) };
        let line = Unit { unit: unit.to_owned(), samples: samples.to_vec() };
        let line = serde_json::to_string(&line).map_err(TaskError::new)?;
        let mut file = file.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        writeln!(file, "{line}").map_err(|e| TaskError::io(path, &e))
    }

    /// Removes the file: the results are written.
    pub(super) fn remove(self) {
        if let Some((path, _)) = self.file {
            // A checkpoint left behind is discarded next time.
            let _ = fs::remove_file(path);
        }
    }
}

/// The units in a checkpoint; `None` if it is of another command or version. An incomplete line is ignored.
fn samples(bytes: &[u8], expected: &Header) -> Option<HashMap<String, Vec<Sample>>> {
    let text = String::from_utf8_lossy(bytes);
    let mut lines = text.lines();
    let header: Header = serde_json::from_str(lines.next()?).ok()?;
    let units = lines.filter_map(|l| serde_json::from_str::<Unit>(l).ok());
    (header == *expected).then(|| units.map(|u| (u.unit, u.samples)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample(pose: f64) -> Sample {
        Sample::new("walk", "old", 0, 0, [("pose_error_cm", pose)])
    }

    #[test]
    fn a_stopped_run_goes_on_and_another_command_begins_anew() {
        let folder = tempfile::tempdir().unwrap();
        let results = folder.path().join("out.json");
        let partial = folder.path().join("out.json.partial");
        let first = Checkpoint::open(Some(&results), "a").unwrap();
        first.keep("1", &[sample(1.5)]).unwrap();
        first.keep("2", &[sample(2.5)]).unwrap();
        drop(first);
        let text = fs::read_to_string(&partial).unwrap();
        fs::write(&partial, &text[..text.len() - 10]).unwrap();

        let second = Checkpoint::open(Some(&results), "a").unwrap();
        assert_eq!(second.done("1"), Some(&vec![sample(1.5)]));
        assert_eq!(second.done("2"), None, "its line was cut off");
        drop(second);
        let other = Checkpoint::open(Some(&results), "b").unwrap();
        assert_eq!(other.done("1"), None);
        other.remove();
        assert!(!partial.exists());
    }
}
