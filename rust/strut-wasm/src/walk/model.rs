//! Handle of a walk model.

use crate::common::{EngineError, bvh_of, offsets_of, poses_of};
use std::sync::Arc;
use strut_core::hsmm::{self, CurvePoint, JointCurve, JointPath, PathOptions, RATE_HZ, RuntimeWalkModel, Side};
use strut_core::humanoid::{HumanoidMotion, Role};
use strut_formats::walk_model;
use wasm_bindgen::prelude::wasm_bindgen;

/// A walk model, shared with all walks that are created from it.
#[wasm_bindgen]
pub struct WalkModel {
    pub(crate) model: hsmm::WalkModel,
    pub(crate) runtime: Arc<RuntimeWalkModel>,
}

#[wasm_bindgen]
impl WalkModel {
    /// Reads the model in a `.strutwalk` file.
    ///
    /// # Errors
    /// If the bytes are invalid.
    #[wasm_bindgen(constructor)]
    pub fn new(bytes: &[u8]) -> Result<Self, EngineError> {
        let model = walk_model::read(bytes).map_err(EngineError::unusable_file)?;
        Ok(Self { runtime: Arc::new(RuntimeWalkModel::new(&model)), model })
    }

    /// Returns the names of the styles.
    pub fn styles(&self) -> Vec<String> {
        self.model.styles.clone()
    }

    /// Returns the frame rate of walks, frames per second.
    #[wasm_bindgen(js_name = rateHz)]
    pub fn rate_hz(&self) -> f32 {
        RATE_HZ
    }

    /// Returns the offset of each joint from its parent in the T-pose, metres: 21 × xyz.
    pub fn proportions(&self) -> Vec<f32> {
        offsets_of(&self.model.proportions)
    }

    /// Returns the state durations of a left step (0) or a right one (1) in a mixture of styles, one weight per style:
    /// five durations, frames, then their variances.
    pub fn durations(&self, weights: &[f32], side: usize) -> Vec<f32> {
        let side = if side == 0 { Side::Left } else { Side::Right };
        let variances = self.model.duration_variances[side as usize].map(|v| v as f32);
        [self.runtime.durations(weights, side), variances].concat()
    }

    /// Returns a joint's angle through a left and a right step, in a mixture of styles for either: the axis, then five
    /// numbers per frame: the synthesised angle, the mean and the standard deviation of the frame's state, radians, its
    /// side and its index.
    ///
    /// # Errors
    /// If there is not one weight per style, or no such joint.
    pub fn curve(&self, left: &[f32], right: &[f32], joint: usize) -> Result<Vec<f32>, EngineError> {
        let joint = role(joint)?;
        let curve =
            JointCurve::new(&self.model, &self.runtime, [left, right], joint).map_err(EngineError::bad_input)?;
        Ok(std::iter::once(curve.axis as f32).chain(curve.points.iter().flat_map(numbers_of)).collect())
    }

    /// Returns the trajectory of a degree of freedom through a left and a right step, in a mixture of styles for
    /// either: the durations of the ten states, frames, then five numbers per frame as in [`WalkModel::curve`]. The
    /// axis is in the joint's local frame. Three factors scale the variances of poses, velocities and accelerations; ρ
    /// of left steps and of right ones adjusts the durations.
    ///
    /// # Errors
    /// If there is not one weight per style, no such joint or axis, or a number is out of range.
    pub fn path(
        &self,
        left: &[f32],
        right: &[f32],
        joint: usize,
        axis: usize,
        variance: &[f64],
        rho: &[f32],
    ) -> Result<Vec<f32>, EngineError> {
        let joint = role(joint)?;
        let (&[pose, velocity, acceleration], &[of_left, of_right]) = (variance, rho) else {
            return Err(EngineError::bad_input("three factors of variances and two values of ρ were expected"));
        };
        let options = PathOptions { variance: [pose, velocity, acceleration], rho: [of_left, of_right] };
        let path = JointPath::new(&self.model, &self.runtime, [left, right], (joint, axis), options)
            .map_err(EngineError::bad_input)?;
        let durations = path.durations.as_flattened().iter().copied();
        Ok(durations.chain(path.points.iter().flat_map(numbers_of)).collect())
    }

    /// Returns the text of a BVH file with these poses.
    ///
    /// # Errors
    /// If the array is not a whole number of poses, or is empty.
    #[wasm_bindgen(js_name = toBvh)]
    pub fn to_bvh(&self, poses: &[f32]) -> Result<String, EngineError> {
        let poses = poses_of(poses)?.collect();
        let motion = HumanoidMotion { proportions: self.model.proportions, rate_hz: RATE_HZ, poses };
        bvh_of(&motion)
    }
}

fn role(joint: usize) -> Result<Role, EngineError> {
    Role::ALL.get(joint).copied().ok_or_else(|| EngineError::bad_input("there is no such joint"))
}

fn numbers_of(p: &CurvePoint) -> [f32; 5] {
    [p.angle, p.mean, p.deviation, p.side as usize as f32, p.state as f32]
}
