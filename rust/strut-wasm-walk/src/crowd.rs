//! Handle of a crowd of walkers.

use crate::model::WalkModel;
use js_sys::{Float32Array, Uint8Array};
use std::sync::Arc;
use strut_core::crowd;
use strut_core::hsmm::RATE_HZ;
use strut_core::humanoid::{HumanoidMotion, Proportions};
use strut_wasm_common::{EngineError, bvh_of, proportions_of, write_floats};
use strut_wasm_common::{frames_of_crowd, points_of_route, vertices_of_field};
use wasm_bindgen::prelude::wasm_bindgen;

/// A crowd of walkers by one model. For every frame of [`WalkModel::rate_hz`] [`Crowd::tick`], then [`Crowd::read`].
#[wasm_bindgen]
pub struct Crowd {
    crowd: crowd::Crowd,
    proportions: Proportions,
}

#[wasm_bindgen]
impl Crowd {
    /// So many walkers, who are drawn by lot by a seed, in the average of all styles.
    ///
    /// # Errors
    /// If there are too few or too many.
    #[wasm_bindgen(constructor)]
    pub fn new(model: &WalkModel, count: usize, seed: u32) -> Result<Self, EngineError> {
        let options = crowd::Options { count, seed };
        let crowd = crowd::Crowd::new(Arc::clone(&model.runtime), options).map_err(EngineError::bad_input)?;
        Ok(Self { crowd, proportions: model.model.proportions })
    }

    /// Goes on by a frame.
    pub fn tick(&mut self) {
        self.crowd.tick();
    }

    /// Writes everybody's joints, 21 × (x y z 0, rotation x y z w) in the world, and how much of every style they walk in, a
    /// byte a walker and style.
    ///
    /// # Errors
    /// If an array has another length.
    pub fn read(&self, joints: &Float32Array, weights: &Uint8Array) -> Result<(), EngineError> {
        if weights.length() as usize != self.crowd.weights().len() {
            return Err(EngineError::bad_input("one weight a walker and style was expected"));
        }
        weights.copy_from(self.crowd.weights());
        write_floats(self.crowd.world(), joints)
    }

    /// Radius of the ground, metres.
    pub fn radius(&self) -> f32 {
        self.crowd.radius()
    }

    /// More walkers or fewer.
    ///
    /// # Errors
    /// If there are too few or too many.
    #[wasm_bindgen(js_name = setCount)]
    pub fn set_count(&mut self, count: usize) -> Result<(), EngineError> {
        self.crowd.set_count(count).map_err(EngineError::bad_input)
    }

    /// Styles by place, from everybody's next step on: the number of a style, then x, z, reach (metres) and intensity for each.
    ///
    /// # Errors
    /// If there are too many vertices, or one is none; nothing changes then.
    #[wasm_bindgen(js_name = setField)]
    pub fn set_field(&mut self, styles: &[u32], numbers: &[f32]) -> Result<(), EngineError> {
        self.crowd.set_field(&vertices_of_field(styles, numbers)?).map_err(EngineError::bad_input)
    }

    /// A way that everybody follows, x and z of its points; none sets them free.
    ///
    /// # Errors
    /// If there is one point, or too many, or one is none; nothing changes then.
    #[wasm_bindgen(js_name = setRoute)]
    pub fn set_route(&mut self, numbers: &[f32]) -> Result<(), EngineError> {
        self.crowd.set_route(points_of_route(numbers)?).map_err(EngineError::bad_input)
    }

    /// Bones that the joints lie on, 21 × xyz in metres, in place of the model's own.
    ///
    /// # Errors
    /// If there are not 63 numbers, or one is none; nothing changes then.
    #[wasm_bindgen(js_name = setBones)]
    pub fn set_bones(&mut self, offsets: &[f32]) -> Result<(), EngineError> {
        let bones = proportions_of(offsets)?;
        self.crowd.set_bones(bones).map_err(EngineError::bad_input)
    }

    /// The text of a BVH file of the next seconds of a walker, as if nobody else were there.
    ///
    /// # Errors
    /// If there is no such walker, or the time is none.
    #[wasm_bindgen(js_name = toBvh)]
    pub fn to_bvh(&self, walker: usize, secs: f32) -> Result<String, EngineError> {
        let frames = frames_of_crowd(secs, RATE_HZ)?;
        let poses =
            self.crowd.ahead(walker, frames).ok_or_else(|| EngineError::bad_input("there is no such walker"))?;
        bvh_of(&HumanoidMotion { proportions: self.proportions, rate_hz: RATE_HZ, poses })
    }
}
