//! Checkpoints: samples saved during an evaluation, so that a stopped one can be resumed.

use super::results::Sample;
use crate::digest::sha256_hex;
use crate::error::{Outcome, TaskError};
use crate::files::{self, Outputs};
use crate::gather::Source;
use serde::{Deserialize, Serialize};
use std::collections::HashMap;
use std::fs::{self, File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use strut_core::database::build::SourceClip;
use strut_core::math::Vec3;
use strut_formats::GENERATOR;

/// Greatest size of a checkpoint, bytes.
const MAX_BYTES: usize = 1 << 30;

/// A file of JSON lines next to the results: a header that identifies the work, then one line per unit of work.
pub(super) struct Checkpoint {
    done: HashMap<String, Vec<Sample>>,
    file: Option<(PathBuf, Mutex<File>)>,
    note: Option<String>,
}

/// Identity of the work. Samples of other work are discarded.
#[derive(PartialEq, Serialize, Deserialize)]
pub(super) struct Work {
    /// The command line.
    pub(super) command: String,
    /// Digest of the motion data; see [`digest_of`].
    pub(super) data: String,
}

#[derive(PartialEq, Serialize, Deserialize)]
struct Header {
    generator: String,
    #[serde(flatten)]
    work: Work,
}

/// Returns a digest of all clips and of the files that are read later.
pub(super) fn digest_of(clips: &[SourceClip], inputs: &[Source]) -> String {
    let of_clip = |clip: &SourceClip| {
        let SourceClip { name, action, style, take, motion, source, .. } = clip;
        let mut bytes = [name, action, style, source].map(|text| format!("{text}\n")).concat().into_bytes();
        bytes.extend(take.to_le_bytes());
        let poses = motion.poses.iter();
        let of_poses =
            poses.flat_map(|p| p.root.to_array().into_iter().chain(p.rotations.iter().flat_map(|q| q.to_array())));
        let numbers = std::iter::once(motion.rate_hz)
            .chain(motion.proportions.offsets.iter().flat_map(Vec3::to_array))
            .chain(of_poses);
        numbers.for_each(|number| bytes.extend(number.to_le_bytes()));
        sha256_hex(&bytes)
    };
    // An unreadable file is omitted later, with the reason.
    let of_input = |input: &Source| input.bytes().map_or_else(|_| input.path.clone(), |bytes| sha256_hex(&bytes));
    let all: Vec<String> = clips.iter().map(of_clip).chain(inputs.iter().map(of_input)).collect();
    sha256_hex(all.join("\n").as_bytes())
}

#[derive(Serialize, Deserialize)]
struct Unit {
    unit: String,
    samples: Vec<Sample>,
}

impl Checkpoint {
    /// Opens the checkpoint of a results file. A checkpoint of another command, version or data is replaced, with a
    /// note. Without a results file nothing is saved.
    ///
    /// # Errors
    /// If an existing checkpoint cannot be read, or the new one cannot be written.
    pub(super) fn open(results: Option<&Path>, work: Work) -> Outcome<Self> {
        let Some(results) = results else { return Ok(Self { done: HashMap::new(), file: None, note: None }) };
        let mut name = results.file_name().unwrap_or_default().to_owned();
        name.push(".partial");
        let path = results.with_file_name(name);
        let fail = |e: std::io::Error| TaskError::io(&path, &e);
        let header = Header { generator: GENERATOR.to_owned(), work };
        let (mut done, mut note) = (HashMap::new(), None);
        if path.try_exists().map_err(fail)? {
            let kept = samples(&files::read(&path, MAX_BYTES)?, &header);
            if kept.is_none() {
                let what = "is from another command, version or data; the evaluation starts again";
                note = Some(format!("{} {what}", path.display()));
            }
            done = kept.unwrap_or_default();
        }
        // The file is rewritten, since its last line may be truncated. The new file replaces the old one only when it
        // is complete.
        let mut text = line_of(&header)?;
        for (unit, samples) in &done {
            text += &line_of(&Unit { unit: unit.clone(), samples: samples.clone() })?;
        }
        let mut outputs = Outputs::default();
        outputs.stage(&path, text.as_bytes())?;
        outputs.commit()?;
        let file = OpenOptions::new().append(true).open(&path).map_err(fail)?;
        Ok(Self { done, file: Some((path, Mutex::new(file))), note })
    }

    /// Returns a note about a discarded checkpoint.
    pub(super) fn note(&self) -> Option<&str> {
        self.note.as_deref()
    }

    /// Returns the samples of a unit of work that is done.
    pub(super) fn done(&self, unit: &str) -> Option<&Vec<Sample>> {
        self.done.get(unit)
    }

    /// Saves the samples of a unit of work.
    pub(super) fn keep(&self, unit: &str, samples: &[Sample]) -> Outcome {
        let Some((path, file)) = &self.file else { return Ok(()) };
        let line = line_of(&Unit { unit: unit.to_owned(), samples: samples.to_vec() })?;
        let mut file = file.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        file.write_all(line.as_bytes()).map_err(|e| TaskError::io(path, &e))
    }

    /// Removes the file once the results are written.
    pub(super) fn remove(self) {
        if let Some((path, _)) = self.file {
            // A checkpoint that remains is discarded next time.
            let _ = fs::remove_file(path);
        }
    }
}

/// Returns a value as a line of JSON.
fn line_of(of: &impl Serialize) -> Outcome<String> {
    serde_json::to_string(of).map(|line| line + "\n").map_err(TaskError::new)
}

/// Returns the units in a checkpoint, or `None` if it is of another command, version or data. An incomplete line is
/// ignored.
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
    use strut_core::humanoid::{HumanoidMotion, Pose, Proportions};

    fn sample(pose: f64) -> Sample {
        Sample::new("walk", "old", 0, 0, [("pose_error_cm", pose)])
    }

    fn of(command: &str, data: &str) -> Work {
        Work { command: command.to_owned(), data: data.to_owned() }
    }

    #[test]
    fn a_stopped_run_goes_on_and_another_command_or_other_data_begin_anew() {
        let folder = tempfile::tempdir().unwrap();
        let results = folder.path().join("out.json");
        let partial = folder.path().join("out.json.partial");
        let first = Checkpoint::open(Some(&results), of("a", "x")).unwrap();
        assert_eq!(first.note(), None);
        first.keep("1", &[sample(1.5)]).unwrap();
        first.keep("2", &[sample(2.5)]).unwrap();
        drop(first);
        let text = fs::read_to_string(&partial).unwrap();
        fs::write(&partial, &text[..text.len() - 10]).unwrap();

        let second = Checkpoint::open(Some(&results), of("a", "x")).unwrap();
        assert_eq!(second.done("1"), Some(&vec![sample(1.5)]));
        assert_eq!(second.done("2"), None, "its line was cut off");
        assert_eq!(second.note(), None);
        second.keep("3", &[sample(3.5)]).unwrap();
        drop(second);
        let third = Checkpoint::open(Some(&results), of("a", "x")).unwrap();
        assert_eq!([third.done("1"), third.done("3")], [Some(&vec![sample(1.5)]), Some(&vec![sample(3.5)])]);
        drop(third);
        for (command, data) in [("a", "y"), ("b", "y")] {
            let other = Checkpoint::open(Some(&results), of(command, data)).unwrap();
            assert_eq!(other.done("1"), None);
            assert!(other.note().unwrap().contains("starts again"), "{:?}", other.note());
            other.keep("1", &[sample(0.5)]).unwrap();
        }
        Checkpoint::open(Some(&results), of("b", "y")).unwrap().remove();
        assert!(!partial.exists());
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    }

    #[test]
    fn the_digest_is_that_of_what_is_read() {
        let clip = |take: u32| SourceClip {
            name: take.to_string(),
            action: "walk".into(),
            style: "old".into(),
            take,
            motion: HumanoidMotion {
                proportions: Proportions::default(),
                rate_hz: 60.0,
                poses: vec![Pose::default(); 9],
            },
            source: String::new(),
            licence: String::new(),
            script: None,
        };
        let clips = || (1..=3).map(clip).collect::<Vec<_>>();
        let of = |change: fn(&mut SourceClip)| {
            let mut clips = clips();
            change(&mut clips[1]);
            digest_of(&clips, &[])
        };
        let same = of(|_| {});
        assert_eq!(same, of(|_| {}));
        assert_ne!(same, of(|clip| clip.motion.poses[3].root.x += 1e-4));
        assert_ne!(same, of(|clip| clip.style.push('x')));
        assert_ne!(same, of(|clip| clip.motion.rate_hz = 30.0));
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.bvh");
        let with_input = |text: &str| {
            fs::write(&path, text).unwrap();
            digest_of(&clips(), &[Source::file(&path)])
        };
        assert_ne!(with_input("one"), with_input("two"));
    }

    #[test]
    fn what_was_kept_is_whole_until_the_new_file_is() {
        let folder = tempfile::tempdir().unwrap();
        let (results, partial) = (folder.path().join("out.json"), folder.path().join("out.json.partial"));
        let first = Checkpoint::open(Some(&results), of("a", "x")).unwrap();
        first.keep("1", &[sample(1.5)]).unwrap();
        drop(first);
        OpenOptions::new().append(true).open(&partial).unwrap().write_all(b"{\"unit\":\"2").unwrap();
        let before = fs::read_to_string(&partial).unwrap();
        // A process that is killed during the rewrite leaves the file that this handle sees.
        let mut old = File::open(&partial).unwrap();
        let second = Checkpoint::open(Some(&results), of("a", "x")).unwrap();
        let mut seen = String::new();
        std::io::Read::read_to_string(&mut old, &mut seen).unwrap();
        assert_eq!(seen, before);
        assert_eq!(second.done("1"), Some(&vec![sample(1.5)]));
        assert_eq!(fs::read_to_string(&partial).unwrap().lines().count(), 2);
    }

    #[test]
    fn what_cannot_be_read_is_not_overwritten() {
        let folder = tempfile::tempdir().unwrap();
        let (results, partial) = (folder.path().join("out.json"), folder.path().join("out.json.partial"));
        File::create(&partial).unwrap().set_len(MAX_BYTES as u64 + 1).unwrap();
        let refused = Checkpoint::open(Some(&results), of("a", "x")).err().unwrap().to_string();
        assert!(refused.contains("larger than 1024 MiB"), "{refused}");
        assert_eq!(fs::metadata(&partial).unwrap().len(), MAX_BYTES as u64 + 1);
    }
}
