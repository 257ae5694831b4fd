//! Location of real motion capture, which is not part of the repository.
#![allow(dead_code)] // Each test file uses a part of the module.

use std::io::Write;
use std::path::{Path, PathBuf};

/// Clips that tests read, as `SET/NAME.bvh`, sorted. An additional file in the folder changes no test.
const CLIPS: &str = include_str!("clips.txt");

/// Folder of real motion capture: `$STRUT_MOCAP`, which must exist, else `shared/data` beside the repository. If that is
/// missing, prints that the test is skipped.
pub(crate) fn folder() -> Option<PathBuf> {
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data");
    let given = std::env::var_os("STRUT_MOCAP").map(PathBuf::from);
    let is_given = given.is_some();
    let folder = given.unwrap_or(beside);
    if !folder.is_dir() {
        assert!(!is_given, "STRUT_MOCAP is {}, which is not a folder", folder.display());
        skip("no real motion capture; set STRUT_MOCAP to its folder");
        return None;
    }
    Some(folder)
}

/// Clips of all sets.
pub(crate) fn clips() -> Option<Vec<PathBuf>> {
    folder().map(|folder| clips_of(&folder, ""))
}

/// Clips of the set of this name; of all sets if it is empty.
pub(crate) fn clips_of(folder: &Path, set: &str) -> Vec<PathBuf> {
    let of_set = |clip: &&str| set.is_empty() || clip.split('/').next() == Some(set);
    CLIPS.lines().filter(of_set).map(|clip| folder.join(clip)).collect()
}

/// Prints why a test is skipped.
pub(crate) fn skip(reason: &str) {
    // Not `println!`, whose output cargo shows only for failed tests.
    let _ = writeln!(std::io::stderr(), "skipped: {reason}");
}
