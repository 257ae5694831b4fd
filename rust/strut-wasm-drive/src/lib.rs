//! Driving for JavaScript; no algorithm. A package of its own: visitors load it when they begin to steer.
//!
//! Objects, arrays, errors and panics are as in [`strut_wasm_common`].

mod clips;
mod driver;

pub use clips::{Among, Clips};
pub use driver::{Driver, FRAME};
pub use strut_wasm_common::EngineError;
