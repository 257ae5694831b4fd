//! Progress of a task, reported to JavaScript.

use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen]
extern "C" {
    /// Listener for the progress of a task: an object with a method `progress(stage, done, total)`.
    pub type Progress;
    #[wasm_bindgen(method)]
    pub(crate) fn progress(this: &Progress, stage: &str, done: usize, total: usize);
}
