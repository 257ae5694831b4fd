//! Rigged characters for JavaScript; no algorithm. A package of its own: it is loaded with the first character.
//!
//! Objects, arrays, errors and panics are as in [`strut_wasm_common`].
#![forbid(unsafe_code)]

mod character;

pub use character::Character;
pub use strut_wasm_common::EngineError;
