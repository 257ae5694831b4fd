//! Small deterministic mathematics; knows nothing of skeletons.

pub mod exp_map;
pub mod float_funcs;
mod quat;

pub use glam::{Vec2, Vec3};
pub use quat::Quat;
