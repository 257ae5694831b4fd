//! Building of databases, and training of walk models and key-style models. Its package is loaded for the user's own clips,
//! the Walk view and the Key-style view.

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
pub use walk_training::{TrainedWalk, WalkTraining};
