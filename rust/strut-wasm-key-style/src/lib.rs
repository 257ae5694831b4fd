//! Poses of style variables for JavaScript; no algorithm. A package of its own: visitors load it with the Key-style view.
//!
//! JavaScript owns every object and frees it. What is wrong with an argument is thrown as a string, a sentence; a panic,
//! which is a bug, is thrown as an `Error`, and the instance must then be thrown away.

mod frame;
mod measure;
mod model;
mod puppet;
mod styling;

pub use measure::{CheckedMeasure, check_measure};
pub use model::KeyStyleModel;
pub use puppet::Puppet;
pub use styling::Styling;

use wasm_bindgen::prelude::wasm_bindgen;
use wasm_bindgen::{JsError, throw_val};

/// Makes a panic throw its message instead of the bare "unreachable" of a trap.
#[wasm_bindgen(start)]
fn throw_panics() {
    std::panic::set_hook(Box::new(|panic| throw_val(JsError::new(&panic.to_string()).into())));
}

pub(crate) fn text(error: impl ToString) -> String {
    error.to_string()
}
