//! Builds a database from labelled clips: preparation, registration, assembly (`docs/methods/mar.md` §2–§4).
//!
//! Offline and deterministic: the result is a function of the clips and options alone, whatever executor
//! computes it and in whatever order the clips are given.

mod add_style;
mod assemble;
mod error;
mod job;
mod options;
pub(crate) mod prepare;
mod report;
mod source;

pub use add_style::{AddStyleError, AddedStyle, Better, Doubt, add_style, add_style_of};
pub use error::BuildError;
pub use job::{Build, Progress, Stage, build};
pub use options::{BuildOptions, RATES_HZ};
pub use report::{ActionReport, BuildReport, ClipReport, Refusal};
pub use source::{MIN_CLIP_FRAMES, Script, SourceClip};

#[cfg(test)]
mod tests;
