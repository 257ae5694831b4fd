//! JavaScript interface of crowds that perform one motion; no algorithms. A separate package, loaded by its own worker.
//!
//! For objects, arrays, errors and panics see [`strut_wasm_common`].

mod performers;

pub use performers::Performers;
pub use strut_wasm_common::EngineError;
