//! Handle of a walk model.

use std::sync::Arc;
use strut_core::hsmm::{self, CurvePoint, JointCurve, JointPath, PathOptions, RATE_HZ, RuntimeWalkModel, Side};
use strut_core::humanoid::{HumanoidMotion, Role};
use strut_formats::walk_model;
use strut_wasm_common::{EngineError, bvh_of, offsets_of, poses_of};
use wasm_bindgen::prelude::wasm_bindgen;

/// A model of walk styles; shared with all walks that were made from it.
#[wasm_bindgen]
pub struct WalkModel {
    pub(crate) model: hsmm::WalkModel,
    pub(crate) runtime: Arc<RuntimeWalkModel>,
}

#[wasm_bindgen]
impl WalkModel {
    /// The model in a `.strutwalk` file.
    ///
    /// # Errors
    /// With what is wrong with the bytes.
    #[wasm_bindgen(constructor)]
    pub fn new(bytes: &[u8]) -> Result<Self, EngineError> {
        let model = walk_model::read(bytes).map_err(EngineError::unusable_file)?;
        Ok(Self { runtime: Arc::new(RuntimeWalkModel::new(&model)), model })
    }

    /// Names of the styles.
    pub fn styles(&self) -> Vec<String> {
        self.model.styles.clone()
    }

    /// Frames per second of walks.
    #[wasm_bindgen(js_name = rateHz)]
    pub fn rate_hz(&self) -> f32 {
        RATE_HZ
    }

    /// Offset of each joint from its parent in the T-pose, metres: 21 × xyz.
    pub fn proportions(&self) -> Vec<f32> {
        offsets_of(&self.model.proportions)
    }

    /// Frames that the states of a left step (0) or a right one (1) last in a mixture of styles, one weight a style: five as
    /// they are walked, then their variances.
    pub fn durations(&self, weights: &[f32], side: usize) -> Vec<f32> {
        let side = if side == 0 { Side::Left } else { Side::Right };
        let variances = self.model.duration_variances[side as usize].map(|v| v as f32);
        [self.runtime.durations(weights, side), variances].concat()
    }

    /// A joint's angle through a left step and a right one, in a mixture of styles for either: the axis, then five numbers a
    /// frame, the angle that is walked, the mean and the standard deviation of the frame's state in radians, its side and its
    /// number.
    ///
    /// # Errors
    /// If there is not one weight a style, or no such joint.
    pub fn curve(&self, left: &[f32], right: &[f32], joint: usize) -> Result<Vec<f32>, EngineError> {
        let joint = role(joint)?;
        let curve =
            JointCurve::new(&self.model, &self.runtime, [left, right], joint).map_err(EngineError::bad_input)?;
        Ok(std::iter::once(curve.axis as f32).chain(curve.points.iter().flat_map(numbers_of)).collect())
    }

    /// The trajectory of a degree of freedom through a left step and a right one, in a mixture of styles for either: frames of
    /// the ten states, then five numbers a frame as in [`WalkModel::curve`]. The axis is that of the joint's own frame; the
    /// variances of poses, velocities and accelerations are multiplied by three factors, and durations give way by ρ of left
    /// steps and of right ones.
    ///
    /// # Errors
    /// If there is not one weight a style, no such joint or axis, or a number is out of its range.
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

    /// The text of a BVH file of these poses, one after the other.
    ///
    /// # Errors
    /// If the array is not a whole number of poses, or holds none.
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
