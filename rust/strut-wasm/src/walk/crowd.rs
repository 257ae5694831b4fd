//! Handle of a crowd of walkers.

use crate::common::{EngineError, bvh_of, crowd_handle, frames_of_crowd};
use crate::walk::model::WalkModel;
use std::sync::Arc;
use strut_core::crowd;
use strut_core::hsmm::RATE_HZ;
use strut_core::humanoid::{HumanoidMotion, Proportions};
use wasm_bindgen::prelude::wasm_bindgen;

/// A crowd of walkers with one model. For each frame at [`WalkModel::rate_hz`] call [`Crowd::tick`], then
/// [`Crowd::read`].
#[wasm_bindgen]
pub struct Crowd {
    crowd: crowd::Walkers,
    proportions: Proportions,
}

#[wasm_bindgen]
impl Crowd {
    /// Creates `count` walkers in the average of all styles, randomised by a seed.
    ///
    /// # Errors
    /// If there are too few or too many.
    #[wasm_bindgen(constructor)]
    pub fn new(model: &WalkModel, count: usize, seed: u32) -> Result<Self, EngineError> {
        let options = crowd::Options { count, seed };
        let crowd = crowd::Walkers::new(Arc::clone(&model.runtime), options).map_err(EngineError::bad_input)?;
        Ok(Self { crowd, proportions: model.model.proportions })
    }

    /// Returns the text of a BVH file with the next seconds of a walker, without collision avoidance.
    ///
    /// # Errors
    /// If the index is out of range or the time is not finite.
    #[wasm_bindgen(js_name = toBvh)]
    pub fn to_bvh(&self, walker: usize, secs: f32) -> Result<String, EngineError> {
        let frames = frames_of_crowd(secs, RATE_HZ)?;
        let poses =
            self.crowd.ahead(walker, frames).ok_or_else(|| EngineError::bad_input("there is no such walker"))?;
        bvh_of(&HumanoidMotion { proportions: self.proportions, rate_hz: RATE_HZ, poses })
    }
}

crowd_handle!(Crowd);
