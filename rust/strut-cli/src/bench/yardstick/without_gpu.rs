//! Stub of the comparison without the feature `gpu`.

use super::super::measure::Row;
use serde::Serialize;
use strut_core::search::{Index, QueryWindow};
use strut_tasks::{Outcome, TaskError};

/// Has no values.
pub(in crate::bench) enum Yardstick {}

/// Has no values.
#[derive(Serialize)]
pub(in crate::bench) enum Comparison {}

impl Yardstick {
    /// Returns an error that explains how to build the command with the feature.
    pub(in crate::bench) fn open() -> Outcome<Option<Self>> {
        Err(TaskError::new(
            "this strut was built without GPU support; build it with `npm run bench -- --gpu` or `cargo build \
             --release -p strut-motion-cli --features gpu`",
        ))
    }

    pub(in crate::bench) fn measure(&self, _: &Index, _: &[QueryWindow]) -> Option<(Vec<Row>, Comparison)> {
        match *self {}
    }
}
