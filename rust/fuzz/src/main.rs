//! A fuzz target under libFuzzer, selected by the environment variable `STRUT_FUZZ_TARGET`.
#![no_main]

use libfuzzer_sys::fuzz_target;
use std::sync::LazyLock;
use strut_fuzz::{TARGETS, Target, target};

static TARGET: LazyLock<&Target> = LazyLock::new(|| {
    let name = std::env::var("STRUT_FUZZ_TARGET").unwrap_or_default();
    let names = || TARGETS.iter().map(|target| target.name).collect::<Vec<_>>().join(", ");
    target(&name).unwrap_or_else(|| panic!("STRUT_FUZZ_TARGET is '{name}'; one of {} was expected", names()))
});

fuzz_target!(|data: &[u8]| (TARGET.run)(data));
