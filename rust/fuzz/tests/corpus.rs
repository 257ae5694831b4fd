//! Every target on its corpus, which has the inputs that fuzzing found, and on a few random inputs.

use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};
use std::fs;
use std::path::PathBuf;
use strut_fuzz::{TARGETS, Target};

/// Number of random inputs per target.
const RANDOM_RUNS: u32 = 48;

fn corpus(target: &Target) -> Vec<PathBuf> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("corpus").join(target.name);
    let mut files: Vec<PathBuf> =
        fs::read_dir(&folder).map(|entries| entries.flatten().map(|entry| entry.path()).collect()).unwrap_or_default();
    files.sort();
    files
}

#[test]
fn nothing_that_was_found_fails_again() {
    for target in TARGETS {
        let files = corpus(target);
        assert!(!files.is_empty(), "{} has no corpus", target.name);
        for file in files {
            let bytes = fs::read(&file).expect("the corpus can be read");
            println!("{}", file.display());
            (target.run)(&bytes);
        }
    }
}

#[test]
fn random_inputs_do_no_harm() {
    for target in TARGETS {
        println!("{}", target.name);
        let mut runner = TestRunner::new(Config { cases: RANDOM_RUNS, failure_persistence: None, ..Config::default() });
        let input = prop::collection::vec(any::<u8>(), 0..target.max_len);
        let tried = runner.run(&input, |bytes| {
            (target.run)(&bytes);
            Ok(())
        });
        tried.unwrap_or_else(|e| panic!("{}: {e}", target.name));
    }
}
