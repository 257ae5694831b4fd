//! Handle of a crowd of performers.

use crate::common::{EngineError, bvh_of, offsets_of, proportions_of, write_floats};
use crate::common::{frames_of_crowd, points_of_route, vertices_of_field};
use js_sys::{Float32Array, Uint8Array};
use std::sync::Arc;
use strut_core::crowd::{self, TICK_HZ};
use strut_core::humanoid::HumanoidMotion;
use strut_core::transfer::Predictions;
use wasm_bindgen::prelude::wasm_bindgen;

/// A crowd that performs one motion. For each tick at [`Performers::rate_hz`] call [`Performers::tick`], then
/// [`Performers::read`].
#[wasm_bindgen]
pub struct Performers(crowd::Performers);

#[wasm_bindgen]
impl Performers {
    /// Creates `count` performers in the neutral style, randomised by a seed. `numbers` are the engine's recording of
    /// the motion.
    ///
    /// # Errors
    /// If there are too few or too many performers, or the numbers are no valid recording.
    #[wasm_bindgen(constructor)]
    pub fn new(numbers: &[f32], count: usize, seed: u32) -> Result<Self, EngineError> {
        let predictions = Predictions::from_floats(numbers).map_err(EngineError::bad_input)?;
        let options = crowd::Options { count, seed };
        crowd::Performers::new(Arc::new(predictions), options).map(Self).map_err(EngineError::bad_input)
    }

    /// Returns the number of ticks per second.
    #[wasm_bindgen(js_name = rateHz)]
    pub fn rate_hz(&self) -> f32 {
        TICK_HZ
    }

    /// Returns the bone offsets of the database, 21 × xyz in metres.
    pub fn proportions(&self) -> Vec<f32> {
        offsets_of(self.0.predictions().proportions())
    }

    /// Advances by one tick.
    pub fn tick(&mut self) {
        self.0.tick();
    }

    /// Writes the joints of all performers, 21 × (x y z 0, rotation x y z w) in the world, and their style weights, one
    /// byte per performer and style.
    ///
    /// # Errors
    /// If an array has another length.
    pub fn read(&self, joints: &Float32Array, weights: &Uint8Array) -> Result<(), EngineError> {
        if weights.length() as usize != self.0.weights().len() {
            return Err(EngineError::bad_input("one weight per performer and style was expected"));
        }
        weights.copy_from(self.0.weights());
        write_floats(self.0.world(), joints)
    }

    /// Returns the radius of the ground, metres.
    pub fn radius(&self) -> f32 {
        self.0.radius()
    }

    /// Sets the number of performers.
    ///
    /// # Errors
    /// If there are too few or too many.
    #[wasm_bindgen(js_name = setCount)]
    pub fn set_count(&mut self, count: usize) -> Result<(), EngineError> {
        self.0.set_count(count).map_err(EngineError::bad_input)
    }

    /// Sets the style map: the index of each style, then x, z, radius (metres) and intensity of each.
    ///
    /// # Errors
    /// If there are too many vertices, or one is invalid; nothing changes then.
    #[wasm_bindgen(js_name = setField)]
    pub fn set_field(&mut self, styles: &[u32], numbers: &[f32]) -> Result<(), EngineError> {
        self.0.set_field(&vertices_of_field(styles, numbers)?).map_err(EngineError::bad_input)
    }

    /// Sets the route that moving performers follow, x and z of its points; an empty one removes it.
    ///
    /// # Errors
    /// If there is one point, or too many, or one is invalid; nothing changes then.
    #[wasm_bindgen(js_name = setRoute)]
    pub fn set_route(&mut self, numbers: &[f32]) -> Result<(), EngineError> {
        self.0.set_route(points_of_route(numbers)?).map_err(EngineError::bad_input)
    }

    /// Sets the bone offsets of the written joints, 21 × xyz in metres, in place of the database's.
    ///
    /// # Errors
    /// If there are not 63 numbers, or one is invalid; nothing changes then.
    #[wasm_bindgen(js_name = setBones)]
    pub fn set_bones(&mut self, offsets: &[f32]) -> Result<(), EngineError> {
        self.0.set_bones(proportions_of(offsets)?).map_err(EngineError::bad_input)
    }

    /// Returns the text of a BVH file with the next seconds of one performer, without collision avoidance.
    ///
    /// # Errors
    /// If the index is out of range or the time is not finite.
    #[wasm_bindgen(js_name = toBvh)]
    pub fn to_bvh(&self, performer: usize, secs: f32) -> Result<String, EngineError> {
        let ticks = frames_of_crowd(secs, TICK_HZ)?;
        let poses =
            self.0.ahead(performer, ticks).ok_or_else(|| EngineError::bad_input("there is no such performer"))?;
        let proportions = *self.0.predictions().proportions();
        bvh_of(&HumanoidMotion { proportions, rate_hz: TICK_HZ, poses })
    }
}
