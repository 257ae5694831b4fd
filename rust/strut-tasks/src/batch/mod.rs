//! Many clips in many styles, exactly once each: what `strut stylize-batch` does.
//!
//! A job is an input in a variant. Its [key](key::Digests) says what its output depends on; a [manifest](manifest) in the
//! folder of the outputs says which jobs ended how, with which key. A run does what is not done yet, so that one that was
//! stopped, by whatever, is simply started again. Outputs are written beside their places and renamed.

mod attempts;
mod jobs;
mod key;
mod manifest;
mod outputs;
mod perform;
mod run;
mod shard;
mod variants;
mod workers;

pub use manifest::{Record, Status};
pub use run::{BatchReport, BatchRequest, Problem, Retry, run};
pub use shard::Shard;
pub use variants::{Variant, read_variants};
