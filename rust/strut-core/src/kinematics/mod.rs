//! Forward and inverse kinematics of the canonical humanoid.

mod forward;
mod soles;
mod two_bone_ik;

pub use forward::{WorldPose, world_from_local};
pub use soles::{Sole, Soles};
pub use two_bone_ik::{Limb, Reach, SOFT_SHARE, TwoBones, two_bone_ik};
