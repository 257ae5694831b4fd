//! Walk synthesis. Its package is loaded with the Walk view.

#[cfg(feature = "crowd")]
mod crowd;
mod model;
mod synthesis;

#[cfg(feature = "crowd")]
pub use crowd::Crowd;
pub use model::WalkModel;
pub use synthesis::{FRAME, Walk};
