//! A crowd who perform one motion, for JavaScript; no algorithm. A package of its own, which a worker of its own loads.
//!
//! Objects, arrays, errors and panics are as in [`strut_wasm_common`].

mod performers;

pub use performers::Performers;
pub use strut_wasm_common::EngineError;
