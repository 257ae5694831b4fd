//! Walk synthesis for JavaScript; no algorithm. A package of its own: visitors load it with the Walk view.
//!
//! Objects, arrays, errors and panics are as in [`strut_wasm_common`].

#[cfg(feature = "crowd")]
mod crowd;
mod model;
mod walk;

#[cfg(feature = "crowd")]
pub use crowd::Crowd;
pub use model::WalkModel;
pub use strut_wasm_common::EngineError;
pub use walk::{FRAME, Walk};
