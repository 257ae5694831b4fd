//! JavaScript interface of walk synthesis; no algorithms. A separate package, loaded with the Walk view.
//!
//! For objects, arrays, errors and panics see [`strut_wasm_common`].

#[cfg(feature = "crowd")]
mod crowd;
mod model;
mod walk;

#[cfg(feature = "crowd")]
pub use crowd::Crowd;
pub use model::WalkModel;
pub use strut_wasm_common::EngineError;
pub use walk::{FRAME, Walk};
