//! From rotations to positions and back.

mod forward;

pub use forward::{WorldPose, world_from_local};
