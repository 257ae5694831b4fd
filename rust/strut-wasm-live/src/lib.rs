//! JavaScript interface of live streams; no algorithms. A separate package, loaded when a live stream starts. The
//! engine, which has the database, does the styling; this package does the steps before and after it.
//!
//! For objects, arrays, errors and panics see [`strut_wasm_common`].

mod sender;
mod stream;

pub use stream::Stream;
pub use strut_wasm_common::EngineError;
