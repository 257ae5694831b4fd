//! Panics, which are bugs.

use wasm_bindgen::prelude::wasm_bindgen;
use wasm_bindgen::{JsError, throw_val};

/// Makes a panic throw its message instead of the bare "unreachable" of a trap.
#[wasm_bindgen(start)]
fn throw_panics() {
    std::panic::set_hook(Box::new(|panic| throw_val(JsError::new(&panic.to_string()).into())));
}
