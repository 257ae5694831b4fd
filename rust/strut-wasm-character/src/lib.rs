//! JavaScript interface of rigged characters; no algorithms. A separate package, loaded with the first character.
//!
//! For objects, arrays, errors and panics see [`strut_wasm_common`].
#![forbid(unsafe_code)]

mod character;

pub use character::Character;
pub use strut_wasm_common::EngineError;
