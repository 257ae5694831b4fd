//! All distances between inputs and a database at once, on a GPU.
//!
//! The engine searches on the CPU, which is faster for one character and for a thousand. This crate is for tasks that
//! need *every* distance, and for comparisons with the search of Xia et al. 2015, which compared all windows on a GPU.
//! Each kernel is a shader with a CPU twin of the same name. Results are exact: the GPU only finds candidates, with a
//! margin for its rounding (`rounding.rs`).
#![forbid(unsafe_code)]

mod atlas;
mod context;
mod error;
mod kernels;
mod nearest;
mod readback;
mod rounding;
#[cfg(test)]
mod test_data;
mod windows;

pub use atlas::Painter;
pub use context::{Adapter, Context};
pub use error::GpuError;
pub use nearest::{Found, Searcher};
