//! JavaScript interface of driving; no algorithms. A separate package, loaded when the user starts to steer.
//!
//! For objects, arrays, errors and panics see [`strut_wasm_common`].

mod clips;
mod driver;

pub use clips::{Among, Clips};
pub use driver::{Driver, FRAME};
pub use strut_wasm_common::EngineError;
