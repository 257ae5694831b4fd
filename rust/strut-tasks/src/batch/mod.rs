//! Styles many clips in many styles, exactly once each: `strut stylize-batch`.
//!
//! A job is an input in a variant. Its key identifies everything that its output depends on. A
//! manifest in the output folder records how each job ended, with its key. A run does the jobs that are not
//! done yet, so an interrupted batch is continued by starting it again. Outputs are written to temporary files next to
//! their targets and then renamed.

mod attempts;
mod check;
mod jobs;
mod key;
mod manifest;
mod outputs;
mod perform;
mod plan;
mod request;
mod run;
mod shard;
mod styling;
mod variants;
mod workers;

pub use manifest::{Record, Status};
pub use plan::{Plan, PlannedJob};
pub use request::{BatchRequest, Retry};
pub use run::{BatchReport, Problem, run};
pub use shard::Shard;
pub use variants::{Variant, read_variants};
