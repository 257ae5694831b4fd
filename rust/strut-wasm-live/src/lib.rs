//! Live streams for JavaScript; no algorithm. A package of its own: visitors load it when somebody performs. The styling is the
//! engine's, which has the database: here is what comes before and after it.
//!
//! Objects, arrays, errors and panics are as in [`strut_wasm_common`].

mod sender;
mod stream;

pub use stream::Stream;
pub use strut_wasm_common::EngineError;
