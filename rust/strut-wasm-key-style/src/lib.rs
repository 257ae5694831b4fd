//! Poses of style variables for JavaScript; no algorithm. A package of its own: visitors load it with the Key-style view.
//!
//! Objects, arrays, errors and panics are as in [`strut_wasm_common`].

mod drag_character;
mod frame;
mod learning;
mod measure;
mod mode;
mod model;
mod styling;

pub use drag_character::DragCharacter;
pub use learning::Somn;
pub use measure::{CheckedMeasure, check_measure};
pub use model::KeyStyleModel;
pub use strut_wasm_common::EngineError;
pub use styling::Styling;
