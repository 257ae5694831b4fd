//! Interpolation of poses.

use crate::common::{EngineError, floats_of, poses_of};
use wasm_bindgen::prelude::wasm_bindgen;

/// Interpolates between two poses, with `t` in [0, 1].
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
    use strut_core::humanoid::{POSE_FLOATS, Pose};
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
