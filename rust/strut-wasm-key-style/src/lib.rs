//! JavaScript interface of key-styling; no algorithms. A separate package, loaded with the Key-style view.
//!
//! For objects, arrays, errors and panics see [`strut_wasm_common`].

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
