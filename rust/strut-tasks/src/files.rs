//! Reading of whole files within limits, and writing of several files together.

use crate::error::{Outcome, TaskError};
use serde::Serialize;
use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, Read, Write};
use std::path::{Path, PathBuf};

/// Reads a whole file of at most `most` bytes.
///
/// # Errors
/// If it cannot be read, is a folder or is larger.
pub fn read(path: &Path, most: usize) -> Outcome<Vec<u8>> {
    let fail = |e: io::Error| TaskError::io(path, &e);
    let file = File::open(path).map_err(fail)?;
    let metadata = file.metadata().map_err(fail)?;
    if metadata.is_dir() {
        return Err(TaskError::in_file(path, "this is a folder; a file was expected"));
    }
    let too_large = || {
        let reason = format_args!("the file is larger than {} MiB; larger files are not supported", most >> 20);
        Err(TaskError::in_file(path, reason))
    };
    if metadata.len() > most as u64 {
        return too_large();
    }
    let mut bytes = Vec::with_capacity(metadata.len() as usize);
    file.take(most as u64 + 1).read_to_end(&mut bytes).map_err(fail)?;
    if bytes.len() > most { too_large() } else { Ok(bytes) }
}

/// Output files that appear complete or not at all, and only when all are written. Each is written to a temporary file
/// next to its target; [`Outputs::commit`] renames them. If one cannot be renamed, the earlier renames are undone. A
/// process that is killed between two renames leaves the files renamed so far.
#[derive(Debug, Default)]
pub struct Outputs {
    staged: Vec<Staged>,
}

#[derive(Debug)]
struct Staged {
    temporary: PathBuf,
    target: PathBuf,
}

impl Outputs {
    /// Checks that these files can be written.
    ///
    /// # Errors
    /// If a folder does not exist or two names are the same.
    pub fn check<'a>(targets: impl IntoIterator<Item = &'a Path>) -> Outcome {
        let mut seen: Vec<&Path> = Vec::new();
        for target in targets {
            if target.is_dir() {
                return Err(TaskError::in_file(target, "this is a folder; a file name was expected"));
            }
            if target.file_name().is_none() || !folder_of(target).is_dir() {
                return Err(TaskError::in_file(target, "its folder does not exist"));
            }
            if seen.contains(&target) && !is_special(target) {
                return Err(TaskError::in_file(target, "two outputs have this name; different names were expected"));
            }
            seen.push(target);
        }
        Ok(())
    }

    /// Writes the bytes under a temporary name.
    ///
    /// # Errors
    /// On an I/O error.
    pub fn stage(&mut self, target: &Path, bytes: &[u8]) -> Outcome {
        self.stage_with(target, |file| file.write_all(bytes))
    }

    /// Has a function write the file under a temporary name, in portions.
    ///
    /// # Errors
    /// On an I/O error.
    pub fn stage_with(&mut self, target: &Path, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Outcome {
        let fail = |e: io::Error| TaskError::io(target, &e);
        if is_special(target) {
            // A pipe or device, for example /dev/stdout: it is not renamed.
            let file = OpenOptions::new().write(true).open(target).map_err(fail)?;
            return write_buffered(file, write).map(|_| ()).map_err(fail);
        }
        let name = target.file_name().unwrap_or_default().to_string_lossy();
        let temporary = folder_of(target).join(format!(".{name}.{}.tmp", std::process::id()));
        let file = OpenOptions::new().write(true).create_new(true).open(&temporary).map_err(fail)?;
        self.staged.push(Staged { temporary, target: target.to_owned() });
        write_buffered(file, write).and_then(|file| file.sync_all()).map_err(fail)
    }

    /// Writes a report as JSON to a temporary file, if there is a target.
    ///
    /// # Errors
    /// On an I/O error.
    pub fn stage_json(&mut self, target: Option<&Path>, report: &impl Serialize) -> Outcome {
        match target {
            Some(target) => self.stage(target, &serde_json::to_vec_pretty(report).map_err(TaskError::new)?),
            None => Ok(()),
        }
    }

    /// Renames all files, one after the other.
    ///
    /// # Errors
    /// On an I/O error. All earlier names are then restored, as far as the system allows.
    pub fn commit(mut self) -> Outcome {
        let keeps = self.staged.len() > 1;
        let mut named: Vec<Named> = Vec::new();
        while let Some(staged) = self.staged.first() {
            match staged.give_name(keeps) {
                Ok(former) => named.push(Named { target: self.staged.remove(0).target, former }),
                Err(error) => {
                    let error = TaskError::io(&staged.target, &error);
                    named.into_iter().rev().for_each(Named::take_back);
                    return Err(error);
                }
            }
        }
        for former in named.iter().filter_map(|named| named.former.as_deref()) {
            // All files have their names. A file that remains is hidden.
            let _ = fs::remove_file(former);
        }
        Ok(())
    }
}

impl Staged {
    /// Renames the file. If `keeps`, returns the backup name of the file that was replaced.
    fn give_name(&self, keeps: bool) -> io::Result<Option<PathBuf>> {
        let Self { temporary, target } = self;
        let former = (keeps && target.symlink_metadata().is_ok()).then(|| temporary.with_extension("old"));
        if let Some(former) = &former {
            // A hard link is cheap, but not every file system has them.
            fs::hard_link(target, former).or_else(|_| fs::copy(target, former).map(|_| ()))?;
        }
        fs::rename(temporary, target).inspect_err(|_| {
            if let Some(former) = &former {
                let _ = fs::remove_file(former);
            }
        })?;
        Ok(former)
    }
}

/// A renamed file.
#[derive(Debug)]
struct Named {
    target: PathBuf,
    /// Backup name of the file that was replaced.
    former: Option<PathBuf>,
}

impl Named {
    /// Restores the previous name. The earlier failure is the one to report.
    fn take_back(self) {
        let _ = match &self.former {
            Some(former) => fs::rename(former, &self.target),
            None => fs::remove_file(&self.target),
        };
    }
}

impl Drop for Outputs {
    fn drop(&mut self) {
        for staged in &self.staged {
            // The earlier failure is the one to report.
            let _ = fs::remove_file(&staged.temporary);
        }
    }
}

fn write_buffered(file: File, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<File> {
    let mut buffered = BufWriter::new(file);
    write(&mut buffered)?;
    buffered.into_inner().map_err(io::IntoInnerError::into_error)
}

/// Creates an unnamed file that vanishes when it is closed: in the folder of a target, which has room for it, or in the
/// system's folder of temporary files if the target is a pipe or device.
///
/// # Errors
/// On an I/O error.
pub fn unnamed_beside(target: &Path) -> Outcome<File> {
    let file = if is_special(target) { tempfile::tempfile() } else { tempfile::tempfile_in(folder_of(target)) };
    file.map_err(|e| TaskError::io(target, &e))
}

fn folder_of(target: &Path) -> &Path {
    target.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Returns whether the path exists and is neither a file nor a folder.
fn is_special(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|m| !m.is_file() && !m.is_dir())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn outputs_appear_only_when_committed() {
        let folder = tempfile::tempdir().unwrap();
        let [a, b] = ["a.bvh", "b.json"].map(|n| folder.path().join(n));
        fs::write(&a, "old").unwrap();
        let mut outputs = Outputs::default();
        outputs.stage(&a, b"new").unwrap();
        outputs.stage(&b, b"more").unwrap();
        assert_eq!((fs::read(&a).unwrap(), b.exists()), (b"old".to_vec(), false));
        outputs.commit().unwrap();
        assert_eq!((fs::read(&a).unwrap(), fs::read(&b).unwrap()), (b"new".to_vec(), b"more".to_vec()));
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
    }

    #[test]
    fn outputs_are_taken_back_where_a_later_one_fails() {
        let folder = tempfile::tempdir().unwrap();
        let [old, new, blocked] = ["a.bvh", "b.bvh", "c.json"].map(|n| folder.path().join(n));
        fs::write(&old, "old").unwrap();
        let mut outputs = Outputs::default();
        for target in [&old, &new, &blocked] {
            outputs.stage(target, b"new").unwrap();
        }
        // A folder was created at this path after the check.
        fs::create_dir_all(blocked.join("full")).unwrap();
        let refused = outputs.commit().unwrap_err().to_string();
        assert!(refused.contains("c.json"), "{refused}");
        assert_eq!((fs::read(&old).unwrap(), new.exists()), (b"old".to_vec(), false));
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2, "a.bvh and the folder");
    }

    #[test]
    fn abandoned_outputs_leave_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let mut outputs = Outputs::default();
        outputs.stage(&folder.path().join("a"), b"new").unwrap();
        drop(outputs);
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    }

    #[test]
    fn impossible_outputs_are_refused_before_the_work() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("a");
        assert!(Outputs::check([file.as_path()]).is_ok());
        assert!(Outputs::check([folder.path()]).unwrap_err().to_string().ends_with("a file name was expected"));
        assert!(Outputs::check([file.as_path(), &file]).unwrap_err().to_string().contains("two outputs"));
        let nowhere = folder.path().join("no/a");
        assert!(Outputs::check([nowhere.as_path()]).unwrap_err().to_string().ends_with("its folder does not exist"));
    }

    #[test]
    fn large_files_are_refused_unread() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("large");
        File::create(&path).unwrap().set_len(5 << 20).unwrap();
        assert!(
            read(&path, 4 << 20)
                .unwrap_err()
                .to_string()
                .ends_with("larger than 4 MiB; larger files are not supported")
        );
    }
}
