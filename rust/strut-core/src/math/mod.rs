//! Small deterministic mathematics, independent of skeletons.

pub mod exp_map;
pub mod float_funcs;
pub mod gaussian;
pub mod interpolation;
pub(crate) mod lanes;
pub(crate) mod linear;
pub(crate) mod order;
pub(crate) mod partition;
mod quat;
pub mod random;
pub mod stats;

pub use glam::{Vec2, Vec3};
pub use order::sort_by_number;
pub use quat::Quat;
