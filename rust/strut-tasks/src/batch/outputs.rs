//! Atomic writing of outputs: a file is complete or absent.

use crate::digest::sha256_hex;
use crate::error::{Outcome, TaskError};
use std::fs::{self, OpenOptions};
use std::io::{self, Write};
use std::path::Path;

/// Extension of temporary files.
const TEMPORARY: &str = ".tmp";

/// Writes an output below a folder to a temporary file that carries the manifest's name, and renames it.
///
/// # Errors
/// On an I/O error.
pub(super) fn write(folder: &Path, output: &str, manifest: &str, bytes: &[u8]) -> Outcome {
    let target = folder.join(output);
    let fail = |e: io::Error| TaskError::io(&target, &e);
    let place = target.parent().unwrap_or(folder);
    let temporary = place.join(format!(".{}.{manifest}{TEMPORARY}", &sha256_hex(output.as_bytes())[..16]));
    fs::create_dir_all(place).map_err(fail)?;
    let written = OpenOptions::new().write(true).create(true).truncate(true).open(&temporary).and_then(|mut file| {
        file.write_all(bytes)?;
        file.sync_all()
    });
    written.and_then(|()| fs::rename(&temporary, &target)).map_err(|e| {
        // The earlier failure is the one to report.
        let _ = fs::remove_file(&temporary);
        fail(e)
    })
}

/// Removes all temporary files of a manifest's writer below a folder.
///
/// # Errors
/// On an I/O error.
pub(super) fn sweep(folder: &Path, manifest: &str) -> Outcome {
    let ending = format!(".{manifest}{TEMPORARY}");
    let fail = |e: io::Error| TaskError::io(folder, &e);
    for entry in fs::read_dir(folder).map_err(fail)? {
        let entry = entry.map_err(fail)?;
        let name = entry.file_name();
        if entry.file_type().map_err(fail)?.is_dir() {
            sweep(&entry.path(), manifest)?;
        } else if name.to_string_lossy().starts_with('.') && name.to_string_lossy().ends_with(&ending) {
            fs::remove_file(entry.path()).map_err(fail)?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_stopped_writer_left_is_swept_and_others_files_are_not() {
        let folder = tempfile::tempdir().unwrap();
        write(folder.path(), "old/deep/a.bvh", "manifest", b"styled").unwrap();
        let deep = folder.path().join("old/deep");
        for name in [".1.manifest.tmp", ".1.manifest-1-of-2.tmp", "mine.manifest.tmp"] {
            fs::write(deep.join(name), "").unwrap();
        }
        sweep(folder.path(), "manifest").unwrap();
        let mut names: Vec<String> =
            fs::read_dir(deep).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        assert_eq!(names, [".1.manifest-1-of-2.tmp", "a.bvh", "mine.manifest.tmp"]);
    }
}
