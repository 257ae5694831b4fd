//! Forward and inverse kinematics of the canonical humanoid.

mod forward;
pub(crate) mod root_path;
pub(crate) mod rotation_row;
mod soles;
mod two_bone_ik;

pub use forward::{WorldPose, world_from_local};
pub use soles::{Sole, Soles};
pub use two_bone_ik::{Limb, Reach, SOFT_SHARE, TwoBones, two_bone_ik};
