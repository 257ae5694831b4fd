//! Running of the command, and test files.

#[path = "../../../../strut-formats/tests/mocap/mod.rs"]
pub(crate) mod mocap;

use std::path::Path;
use std::process::{Command, Output};
use std::sync::OnceLock;
use strut_core::humanoid::HumanoidMotion;
use strut_core::motion::Motion;
use strut_core::retarget::{Binding, to_humanoid};
use strut_core::search::Index;
use strut_formats::{bvh, strutdb};

/// Runs `strut` with these arguments in a folder.
pub(crate) fn strut(folder: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_strut")).current_dir(folder).args(args).output().expect("strut starts")
}

/// Runs `strut`, which must succeed, and returns its output.
pub(crate) fn strut_ok(folder: &Path, args: &[&str]) -> String {
    let output = strut(folder, args);
    assert!(output.status.success(), "{args:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// Runs `strut`, which must fail with exit code 1, one sentence that contains `expected`, and no new file.
pub(crate) fn assert_refused(folder: &Path, args: &[&str], expected: &str) {
    let before = names(folder);
    let output = strut(folder, args);
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1), "{args:?}: {stderr}");
    assert!(stderr.starts_with("error: ") && stderr.trim_end().lines().count() == 1, "{args:?}: {stderr:?}");
    assert!(stderr.contains(expected), "{args:?}: {stderr}");
    assert_eq!(names(folder), before, "{args:?} left a file");
}

/// Returns the names of the files in a folder.
pub(crate) fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut names: Vec<String> = entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

/// Returns the built-in database as a file.
pub(crate) fn demo_database() -> &'static [u8] {
    static FILE: OnceLock<Vec<u8>> = OnceLock::new();
    FILE.get_or_init(|| {
        let database = strut_demo::database().unwrap();
        strutdb::write(&database, &Index::build(&database).plan(), "test")
    })
}

/// Returns two seconds of the built-in walk as BVH text.
pub(crate) fn demo_walk() -> String {
    let mut motion = strut_demo::input_clips().remove(0).motion;
    motion.poses.truncate(120);
    bvh::write_text(&bvh::Bvh::from_humanoid(&motion).unwrap())
}

/// Returns whether tests on real clips use all of them instead of a sample.
pub(crate) fn all_clips() -> bool {
    std::env::var_os("STRUT_ALL_CLIPS").is_some()
}

/// Reads a file that must be valid BVH.
pub(crate) fn read_bvh(path: &Path) -> bvh::Bvh {
    bvh::parse(&std::fs::read(path).unwrap()).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// Returns a motion as a humanoid of its own proportions.
pub(crate) fn body_of(motion: &Motion) -> HumanoidMotion {
    let binding = Binding::detect(motion).unwrap();
    to_humanoid(motion, &binding, &binding.proportions)
}
