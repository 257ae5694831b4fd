//! Poses as flat arrays.

use crate::common::EngineError;
use js_sys::Float32Array;
use strut_core::humanoid::{HumanoidMotion, JOINTS, POSE_FLOATS, Pose, Proportions};
use strut_core::math::Vec3;
use strut_formats::bvh::{self, Bvh};

/// Reads the poses of a flat array, [`POSE_FLOATS`] numbers each.
///
/// # Errors
/// If the array is not a whole number of poses.
pub fn poses_of(floats: &[f32]) -> Result<impl ExactSizeIterator<Item = Pose>, EngineError> {
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

/// Returns poses as one flat array.
pub fn floats_of<'a>(poses: impl ExactSizeIterator<Item = &'a Pose>) -> Vec<f32> {
    let mut floats = vec![0.0; poses.len() * POSE_FLOATS];
    for (pose, out) in poses.zip(floats.as_chunks_mut::<POSE_FLOATS>().0) {
        pose.write_to(out);
    }
    floats
}

/// Returns the offset of each joint from its parent in the T-pose, metres: 21 × xyz.
pub fn offsets_of(proportions: &Proportions) -> Vec<f32> {
    proportions.offsets.iter().flat_map(Vec3::to_array).collect()
}

/// Reads the array that [`offsets_of`] returned.
///
/// # Errors
/// If the array has another length, or the offsets are no valid body.
pub fn proportions_of(floats: &[f32]) -> Result<Proportions, EngineError> {
    let (offsets, rest) = floats.as_chunks::<3>();
    let offsets: Option<[[f32; 3]; JOINTS]> = offsets.try_into().ok().filter(|_| rest.is_empty());
    let wrong = || EngineError::bad_input(format!("{} offsets were given; {} were expected", floats.len(), 3 * JOINTS));
    let body = Proportions { offsets: offsets.ok_or_else(wrong)?.map(Vec3::from) };
    let none =
        || EngineError::bad_input("the offsets do not describe a body: one is not finite, or a limb has no length");
    if body.is_valid() { Ok(body) } else { Err(none()) }
}

/// Returns the text of a BVH file with a motion.
///
/// # Errors
/// If there is no pose, or a number is out of the range of BVH files.
pub fn bvh_of(motion: &HumanoidMotion) -> Result<String, EngineError> {
    Bvh::from_humanoid(motion).map(|file| bvh::write_text(&file)).map_err(EngineError::bad_input)
}

/// Fills a JavaScript array. A call per displayed frame allocates nothing.
///
/// # Errors
/// If the array has another length.
pub fn write_floats(floats: &[f32], into: &Float32Array) -> Result<(), EngineError> {
    if into.length() as usize != floats.len() {
        let (found, expected) = (into.length(), floats.len());
        return Err(EngineError::bad_input(format!("the array has {found} numbers; {expected} were expected")));
    }
    into.copy_from(floats);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn offsets_that_are_no_body_are_refused() {
        let body = offsets_of(&Proportions::default());
        assert_eq!(proportions_of(&body), Ok(Proportions::default()));
        let refuses = |change: &dyn Fn(&mut Vec<f32>)| {
            let mut floats = body.clone();
            change(&mut floats);
            proportions_of(&floats).is_err()
        };
        assert!(refuses(&|floats| floats.truncate(60)) && refuses(&|floats| floats.push(0.0)));
        assert!(refuses(&|floats| floats[4] = f32::NAN) && refuses(&|floats| floats[3..].fill(0.0)));
    }
}
