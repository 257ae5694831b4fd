//! Where real motion capture lies; it is no part of the repository.

use std::io::Write;
use std::path::{Path, PathBuf};

/// The clips of real motion capture: every `.bvh` of every folder in `$STRUT_MOCAP`, else in
/// `shared/data` beside the repository. Without them prints that the test is skipped.
pub(crate) fn clips() -> Option<Vec<PathBuf>> {
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data");
    let folder = std::env::var_os("STRUT_MOCAP").map_or(beside, PathBuf::from);
    if !folder.is_dir() {
        skip("no real motion capture; set STRUT_MOCAP to its folder");
        return None;
    }
    let mut found: Vec<PathBuf> = entries(&folder).iter().filter(|p| p.is_dir()).flat_map(|p| entries(p)).collect();
    found.retain(|p| p.extension().is_some_and(|e| e == "bvh"));
    found.sort();
    assert!(!found.is_empty(), "no .bvh in {}", folder.display());
    Some(found)
}

/// Says why a test is skipped.
pub(crate) fn skip(reason: &str) {
    // Not `println!`, whose output cargo shows of failed tests only.
    let _ = writeln!(std::io::stderr(), "skipped: {reason}");
}

fn entries(folder: &Path) -> Vec<PathBuf> {
    std::fs::read_dir(folder).map(|d| d.filter_map(|e| Some(e.ok()?.path())).collect()).unwrap_or_default()
}
