//! Handle of a crowd of performers.

use js_sys::{Float32Array, Uint8Array};
use std::sync::Arc;
use strut_core::crowd::{self, TICK_HZ};
use strut_core::humanoid::HumanoidMotion;
use strut_core::transfer::Predictions;
use strut_wasm_common::{EngineError, bvh_of, offsets_of, proportions_of, write_floats};
use strut_wasm_common::{frames_of_crowd, points_of_route, vertices_of_field};
use wasm_bindgen::prelude::wasm_bindgen;

/// A crowd who perform one motion. For every tick of [`Performers::rate_hz`] [`Performers::tick`], then [`Performers::read`].
#[wasm_bindgen]
pub struct Performers(crowd::Performers);

#[wasm_bindgen]
impl Performers {
    /// So many people, who are drawn by lot by a seed, in the neutral style; `numbers` are what the engine recorded of the motion.
    ///
    /// # Errors
    /// If there are too few or too many people, or the numbers are none of a recording.
    #[wasm_bindgen(constructor)]
    pub fn new(numbers: &[f32], count: usize, seed: u32) -> Result<Self, EngineError> {
        let predictions = Predictions::from_floats(numbers).map_err(EngineError::bad_input)?;
        let options = crowd::Options { count, seed };
        crowd::Performers::new(Arc::new(predictions), options).map(Self).map_err(EngineError::bad_input)
    }

    /// Ticks a second.
    #[wasm_bindgen(js_name = rateHz)]
    pub fn rate_hz(&self) -> f32 {
        TICK_HZ
    }

    /// Bone offsets of the database, 21 × xyz in metres.
    pub fn proportions(&self) -> Vec<f32> {
        offsets_of(self.0.predictions().proportions())
    }

    /// Goes on by a tick.
    pub fn tick(&mut self) {
        self.0.tick();
    }

    /// Writes everybody's joints, 21 × (x y z 0, rotation x y z w) in the world, and how much of every style they perform in, a
    /// byte a performer and style.
    ///
    /// # Errors
    /// If an array has another length.
    pub fn read(&self, joints: &Float32Array, weights: &Uint8Array) -> Result<(), EngineError> {
        if weights.length() as usize != self.0.weights().len() {
            return Err(EngineError::bad_input("one weight a performer and style was expected"));
        }
        weights.copy_from(self.0.weights());
        write_floats(self.0.world(), joints)
    }

    /// Radius of the ground, metres.
    pub fn radius(&self) -> f32 {
        self.0.radius()
    }

    /// More people or fewer.
    ///
    /// # Errors
    /// If there are too few or too many.
    #[wasm_bindgen(js_name = setCount)]
    pub fn set_count(&mut self, count: usize) -> Result<(), EngineError> {
        self.0.set_count(count).map_err(EngineError::bad_input)
    }

    /// Styles by place: the number of a style, then x, z, reach (metres) and intensity for each.
    ///
    /// # Errors
    /// If there are too many vertices, or one is none; nothing changes then.
    #[wasm_bindgen(js_name = setField)]
    pub fn set_field(&mut self, styles: &[u32], numbers: &[f32]) -> Result<(), EngineError> {
        self.0.set_field(&vertices_of_field(styles, numbers)?).map_err(EngineError::bad_input)
    }

    /// A way that everybody follows who goes somewhere, x and z of its points; none sets them free.
    ///
    /// # Errors
    /// If there is one point, or too many, or one is none; nothing changes then.
    #[wasm_bindgen(js_name = setRoute)]
    pub fn set_route(&mut self, numbers: &[f32]) -> Result<(), EngineError> {
        self.0.set_route(points_of_route(numbers)?).map_err(EngineError::bad_input)
    }

    /// Bones that the joints lie on, 21 × xyz in metres, in place of the database's own.
    ///
    /// # Errors
    /// If there are not 63 numbers, or one is none; nothing changes then.
    #[wasm_bindgen(js_name = setBones)]
    pub fn set_bones(&mut self, offsets: &[f32]) -> Result<(), EngineError> {
        self.0.set_bones(proportions_of(offsets)?).map_err(EngineError::bad_input)
    }

    /// The text of a BVH file of the next seconds of somebody, as if nobody else were there.
    ///
    /// # Errors
    /// If there is nobody of this number, or the time is none.
    #[wasm_bindgen(js_name = toBvh)]
    pub fn to_bvh(&self, performer: usize, secs: f32) -> Result<String, EngineError> {
        let ticks = frames_of_crowd(secs, TICK_HZ)?;
        let poses =
            self.0.ahead(performer, ticks).ok_or_else(|| EngineError::bad_input("there is no such performer"))?;
        let proportions = *self.0.predictions().proportions();
        bvh_of(&HumanoidMotion { proportions, rate_hz: TICK_HZ, poses })
    }
}
