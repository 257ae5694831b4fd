//! Every distance between inputs and a database at once, on a graphics processor.
//!
//! The engine searches on the processor, which is faster for a character or a thousand. This crate is for where *every*
//! distance is wanted, and for comparing with the search of Xia et al. 2015, which compared all windows on a graphics card.
//! Each kernel is a shader beside its twin of the same name for the processor. What comes out is exact: the graphics
//! processor only finds candidates, with a margin for its rounding ([`rounding`]).
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
