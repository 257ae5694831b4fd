//! Database building, and the training of walk models and key-style models, for JavaScript; no algorithm. A package of its
//! own: visitors load it when they bring their own clips or open the Walk view or the Key-style view.
//!
//! Objects, arrays, errors and panics are as in [`strut_wasm_common`].

mod add_style;
mod builder;
mod built;
mod clip;
mod key_style_training;
mod labels;
mod progress;
mod walk_training;

pub use add_style::add_style;
pub use builder::{Builder, Building};
pub use built::Built;
pub use clip::Clip;
pub use key_style_training::{KeyStyleClips, KeyStyleTraining, TrainedKeyStyle};
pub use labels::{guess_pattern, labels_of, licence_title};
pub use progress::Progress;
pub use strut_wasm_common::EngineError;
pub use walk_training::{TrainedWalk, WalkTraining};
