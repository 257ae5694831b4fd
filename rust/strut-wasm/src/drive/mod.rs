//! Driving. Its package is loaded when the user starts to steer.

mod clips;
mod driver;

pub use clips::{ClipSource, Clips};
pub use driver::{Driver, FRAME};
