//! Published state of an agent: joints in the world, and weights of the styles.

use super::limits::{CrowdError, LONGEST_BONE};
use crate::humanoid::{JOINTS, PARENTS, Proportions};
use crate::kinematics::WorldPose;
use crate::math::Vec3;

/// Numbers per joint: its place x y z in metres and 0, then its rotation x y z w, both in the world.
pub const JOINT_FLOATS: usize = 8;
/// Numbers per walker: those of its joints, in the order of their roles.
pub const WALKER_FLOATS: usize = JOINTS * JOINT_FLOATS;

/// Checks that bone offsets are finite and within range.
pub(super) fn check_bones(bones: &Proportions) -> Result<(), CrowdError> {
    let bad = bones.offsets.iter().flat_map(Vec3::to_array).find(|v| v.is_nan() || v.abs() > LONGEST_BONE);
    bad.map_or(Ok(()), |bad| Err(CrowdError::Bone(bad)))
}

/// Writes the joints of an agent, with these bones in place of its own.
pub(super) fn write_world(mut world: WorldPose, bones: &Proportions, floats: &mut [f32; WALKER_FLOATS]) {
    for (j, &parent) in PARENTS.iter().enumerate().skip(1) {
        world.positions[j] = world.positions[parent] + world.rotations[parent] * bones.offsets[j];
    }
    let joints = world.positions.iter().zip(&world.rotations);
    for ((at, rotation), out) in joints.zip(floats.as_chunks_mut::<JOINT_FLOATS>().0) {
        out[..3].copy_from_slice(&at.to_array());
        out[4..].copy_from_slice(&rotation.to_array());
    }
}

/// Writes weights as 255ths, clamped to 0 to 1.
pub(super) fn write_shares(weights: &[f32], shares: &mut [u8]) {
    for (share, weight) in shares.iter_mut().zip(weights) {
        *share = (255.0 * weight.clamp(0.0, 1.0)).round() as u8;
    }
}
