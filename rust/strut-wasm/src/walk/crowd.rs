//! Handle of a crowd of walkers.

use crate::common::{EngineError, bvh_of, proportions_of, write_floats};
use crate::common::{frames_of_crowd, points_of_route, vertices_of_field};
use crate::walk::model::WalkModel;
use js_sys::{Float32Array, Uint8Array};
use std::sync::Arc;
use strut_core::crowd;
use strut_core::hsmm::RATE_HZ;
use strut_core::humanoid::{HumanoidMotion, Proportions};
use wasm_bindgen::prelude::wasm_bindgen;

/// A crowd of walkers with one model. For each frame at [`WalkModel::rate_hz`] call [`Crowd::tick`], then
/// [`Crowd::read`].
#[wasm_bindgen]
pub struct Crowd {
    crowd: crowd::Crowd,
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
        let crowd = crowd::Crowd::new(Arc::clone(&model.runtime), options).map_err(EngineError::bad_input)?;
        Ok(Self { crowd, proportions: model.model.proportions })
    }

    /// Advances by one frame.
    pub fn tick(&mut self) {
        self.crowd.tick();
    }

    /// Writes the joints of all walkers, 21 × (x y z 0, rotation x y z w) in the world, and their style weights, one
    /// byte per walker and style.
    ///
    /// # Errors
    /// If an array has another length.
    pub fn read(&self, joints: &Float32Array, weights: &Uint8Array) -> Result<(), EngineError> {
        if weights.length() as usize != self.crowd.weights().len() {
            return Err(EngineError::bad_input("one weight per walker and style was expected"));
        }
        weights.copy_from(self.crowd.weights());
        write_floats(self.crowd.world(), joints)
    }

    /// Returns the radius of the ground, metres.
    pub fn radius(&self) -> f32 {
        self.crowd.radius()
    }

    /// Sets the number of walkers.
    ///
    /// # Errors
    /// If there are too few or too many.
    #[wasm_bindgen(js_name = setCount)]
    pub fn set_count(&mut self, count: usize) -> Result<(), EngineError> {
        self.crowd.set_count(count).map_err(EngineError::bad_input)
    }

    /// Sets the style map, which applies from each walker's next step on: the index of each style, then x, z, radius
    /// (metres) and intensity of each.
    ///
    /// # Errors
    /// If there are too many vertices, or one is invalid; nothing changes then.
    #[wasm_bindgen(js_name = setField)]
    pub fn set_field(&mut self, styles: &[u32], numbers: &[f32]) -> Result<(), EngineError> {
        self.crowd.set_field(&vertices_of_field(styles, numbers)?).map_err(EngineError::bad_input)
    }

    /// Sets the route that all walkers follow, x and z of its points; an empty one removes it.
    ///
    /// # Errors
    /// If there is one point, or too many, or one is invalid; nothing changes then.
    #[wasm_bindgen(js_name = setRoute)]
    pub fn set_route(&mut self, numbers: &[f32]) -> Result<(), EngineError> {
        self.crowd.set_route(points_of_route(numbers)?).map_err(EngineError::bad_input)
    }

    /// Sets the bone offsets of the written joints, 21 × xyz in metres, in place of the model's.
    ///
    /// # Errors
    /// If there are not 63 numbers, or one is invalid; nothing changes then.
    #[wasm_bindgen(js_name = setBones)]
    pub fn set_bones(&mut self, offsets: &[f32]) -> Result<(), EngineError> {
        let bones = proportions_of(offsets)?;
        self.crowd.set_bones(bones).map_err(EngineError::bad_input)
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
