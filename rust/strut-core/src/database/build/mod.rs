//! Builds a database from labelled clips: preparation, registration, assembly (`docs/methods/mar.md` §2–§4).
//!
//! The build is offline and deterministic: the result depends on the clips and options alone, not on the executor or
//! the order of the clips.

mod add_style;
mod assemble;
mod error;
mod job;
mod options;
mod prepare;
mod report;
mod source;

pub use add_style::{AddStyleError, AddedStyle, Better, Doubt, add_style, add_style_of};
pub use error::BuildError;
pub use job::{Build, Progress, Stage, build};
pub use options::{BuildOptions, RATES_HZ};
pub use prepare::{encode, headings};
pub use report::{ActionReport, BuildReport, ClipReport, Refusal};
pub use source::{MIN_CLIP_FRAMES, Script, SourceClip};

#[cfg(test)]
mod tests;
