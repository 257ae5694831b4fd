//! Database building, and the training of walk models and key-style models, for JavaScript; no algorithm. A package of its
//! own: visitors load it when they bring their own clips or open the Walk view or the Key-style view.
//!
//! JavaScript owns every object and frees it. What is wrong with a file is thrown as a string, a sentence; a panic, which
//! is a bug, is thrown as an `Error`, and the instance must then be thrown away.

mod add_style;
mod builder;
mod clip;
mod database;
mod key_style_training;
mod labels;
mod walk_training;

pub use add_style::add_style;
pub use builder::{Builder, Building, Built, Progress};
pub use clip::Clip;
pub use key_style_training::{KeyStyleClips, KeyStyleTraining, TrainedKeyStyle};
pub use labels::{guess_pattern, labels_of, licence_title};
pub use walk_training::{TrainedWalk, WalkTraining};

use wasm_bindgen::prelude::wasm_bindgen;
use wasm_bindgen::{JsError, throw_val};

/// Makes a panic throw its message instead of the bare "unreachable" of a trap.
#[wasm_bindgen(start)]
fn throw_panics() {
    std::panic::set_hook(Box::new(|panic| throw_val(JsError::new(&panic.to_string()).into())));
}
