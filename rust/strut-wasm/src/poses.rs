//! Poses ↔ flat arrays.

use crate::error::EngineError;
use strut_core::humanoid::{POSE_FLOATS, Pose};
use wasm_bindgen::prelude::wasm_bindgen;

/// The poses of a flat array of [`POSE_FLOATS`] numbers each.
///
/// # Errors
/// If the array is not a whole number of poses.
pub(crate) fn poses_of(floats: &[f32]) -> Result<impl ExactSizeIterator<Item = Pose>, EngineError> {
    let (poses, rest) = floats.as_chunks::<POSE_FLOATS>();
    if rest.is_empty() {
        Ok(poses.iter().map(Pose::read_from))
    } else {
        Err(EngineError::bad_input(format!(
            "{} numbers are not a whole number of poses of {POSE_FLOATS}",
            floats.len()
        )))
    }
}

/// Poses as one flat array.
pub(crate) fn floats_of<'a>(poses: impl ExactSizeIterator<Item = &'a Pose>) -> Vec<f32> {
    let mut floats = vec![0.0; poses.len() * POSE_FLOATS];
    for (pose, out) in poses.zip(floats.as_chunks_mut::<POSE_FLOATS>().0) {
        pose.write_to(out);
    }
    floats
}

/// The pose between two, `t` in [0, 1].
///
/// # Errors
/// If an array is not one pose.
#[wasm_bindgen(js_name = interpolatePoses)]
pub fn interpolate_poses(a: &[f32], b: &[f32], t: f32) -> Result<Vec<f32>, EngineError> {
    match (poses_of(a)?.next(), poses_of(b)?.next()) {
        (Some(a), Some(b)) => Ok(floats_of([a.lerp(&b, t)].iter())),
        _ => Err(EngineError::bad_input("two poses were expected, and one is missing")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use strut_core::math::Vec3;

    #[test]
    fn interpolation_is_half_way_and_odd_lengths_are_refused() {
        let a = Pose::default();
        let b = Pose { root: a.root + Vec3::X, ..a };
        let (a, b) = (floats_of([a].iter()), floats_of([b].iter()));
        let half = interpolate_poses(&a, &b, 0.5).unwrap();
        assert_eq!((half[0], half.len()), (0.5, POSE_FLOATS));
        assert!(interpolate_poses(&a, &b[1..], 0.5).is_err());
        assert!(interpolate_poses(&a, &[], 0.5).is_err());
    }
}
