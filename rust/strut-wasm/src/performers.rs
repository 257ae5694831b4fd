//! Handle of a crowd of performers.

use crate::common::{EngineError, bvh_of, crowd_handle, frames_of_crowd, offsets_of};
use std::sync::Arc;
use strut_core::crowd::{self, TICK_HZ};
use strut_core::humanoid::HumanoidMotion;
use strut_core::transfer::Predictions;
use wasm_bindgen::prelude::wasm_bindgen;

/// A crowd that performs one motion. For each tick at [`Performers::rate_hz`] call [`Performers::tick`], then
/// [`Performers::read`].
#[wasm_bindgen]
pub struct Performers {
    crowd: crowd::Performers,
}

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
        crowd::Performers::new(Arc::new(predictions), options)
            .map(|crowd| Self { crowd })
            .map_err(EngineError::bad_input)
    }

    /// Returns the number of ticks per second.
    #[wasm_bindgen(js_name = rateHz)]
    pub fn rate_hz(&self) -> f32 {
        TICK_HZ
    }

    /// Returns the bone offsets of the database, 21 × xyz in metres.
    pub fn proportions(&self) -> Vec<f32> {
        offsets_of(self.crowd.predictions().proportions())
    }

    /// Returns the text of a BVH file with the next seconds of one performer, without collision avoidance.
    ///
    /// # Errors
    /// If the index is out of range or the time is not finite.
    #[wasm_bindgen(js_name = toBvh)]
    pub fn to_bvh(&self, performer: usize, secs: f32) -> Result<String, EngineError> {
        let ticks = frames_of_crowd(secs, TICK_HZ)?;
        let poses =
            self.crowd.ahead(performer, ticks).ok_or_else(|| EngineError::bad_input("there is no such performer"))?;
        let proportions = *self.crowd.predictions().proportions();
        bvh_of(&HumanoidMotion { proportions, rate_hz: TICK_HZ, poses })
    }
}

crowd_handle!(Performers);
