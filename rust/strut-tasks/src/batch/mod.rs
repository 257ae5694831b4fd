//! Many clips in many styles, exactly once each: what `strut stylize-batch` does.
//!
//! A job is an input in a variant. Its [key](key::Digests) says what its output depends on; a [manifest](manifest) in the
//! folder of the outputs says which jobs ended how, with which key. A run does what is not done yet, so that one that was
//! stopped, by whatever, is simply started again. Outputs are written beside their places and renamed.

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
