//! Where real motion capture lies; it is no part of the repository.
#![allow(dead_code)] // Each test file uses its part.

use std::io::Write;
use std::path::{Path, PathBuf};

/// The clips that tests read, as `SET/NAME.bvh`, sorted: another file beside them changes no test.
const CLIPS: &str = include_str!("clips.txt");

/// The folder of real motion capture: `$STRUT_MOCAP`, else `shared/data` beside the repository. Without it prints that the
/// test is skipped.
pub(crate) fn folder() -> Option<PathBuf> {
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data");
    let folder = std::env::var_os("STRUT_MOCAP").map_or(beside, PathBuf::from);
    if !folder.is_dir() {
        skip("no real motion capture; set STRUT_MOCAP to its folder");
        return None;
    }
    Some(folder)
}

/// The clips of all sets.
pub(crate) fn clips() -> Option<Vec<PathBuf>> {
    folder().map(|folder| clips_of(&folder, ""))
}

/// The clips of the set of this name; of all sets if it is empty.
pub(crate) fn clips_of(folder: &Path, set: &str) -> Vec<PathBuf> {
    let of_set = |clip: &&str| set.is_empty() || clip.split('/').next() == Some(set);
    CLIPS.lines().filter(of_set).map(|clip| folder.join(clip)).collect()
}

/// Says why a test is skipped.
pub(crate) fn skip(reason: &str) {
    // Not `println!`, whose output cargo shows of failed tests only.
    let _ = writeln!(std::io::stderr(), "skipped: {reason}");
}
