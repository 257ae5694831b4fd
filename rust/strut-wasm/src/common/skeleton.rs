//! Skeletons as flat arrays.

use super::EngineError;
use strut_core::math::Vec3;
use strut_core::skeleton::{Joint, Skeleton};

/// Builds a skeleton from one name, parent (−1 for the root) and offset per joint.
///
/// # Errors
/// If the lengths differ, or the parents are not those of a tree.
pub(crate) fn skeleton_of(names: Vec<String>, parents: &[i32], offsets: &[f32]) -> Result<Skeleton, EngineError> {
    let (offsets, rest) = offsets.as_chunks::<3>();
    if parents.len() != names.len() || offsets.len() != names.len() || !rest.is_empty() {
        return Err(EngineError::bad_input("every joint needs a name, a parent and an offset"));
    }
    let joints = names.into_iter().zip(parents).zip(offsets).map(|((name, parent), offset)| Joint {
        name,
        parent: usize::try_from(*parent).ok(),
        offset: Vec3::from_array(*offset),
        end: None,
    });
    Skeleton::new(joints.collect()).map_err(|e| EngineError::bad_file(e, ""))
}
