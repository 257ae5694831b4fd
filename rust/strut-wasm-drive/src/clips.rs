//! Handle of the clips that are driven with.

use strut_core::driving::{DrivingClips, NeutralClip};
use strut_core::humanoid::Proportions;
use strut_wasm_common::{EngineError, poses_of, proportions_of};
use wasm_bindgen::prelude::wasm_bindgen;

/// Neutral clips, as they are collected for a driver.
#[wasm_bindgen]
pub struct Clips {
    proportions: Proportions,
    rate_hz: f32,
    own: Vec<NeutralClip>,
    takes: Vec<NeutralClip>,
}

#[wasm_bindgen]
impl Clips {
    /// No clips yet, on a body (21 × xyz, metres) and at a rate.
    ///
    /// # Errors
    /// If the offsets are not 63 numbers.
    #[wasm_bindgen(constructor)]
    pub fn new(proportions: &[f32], rate_hz: f32) -> Result<Self, EngineError> {
        Ok(Self { proportions: proportions_of(proportions)?, rate_hz, own: Vec::new(), takes: Vec::new() })
    }

    /// Adds a clip of an action: its poses in the world, and which feet are planted in each, left and right interleaved.
    ///
    /// # Errors
    /// If the array is not a whole number of poses.
    pub fn add(&mut self, name: String, action: String, poses: &[f32], contacts: &[u8]) -> Result<(), EngineError> {
        self.own.push(clip_of(name, action, poses, contacts)?);
        Ok(())
    }

    /// Adds a take that the clips may lack, of another body and rate: it is carried over.
    ///
    /// # Errors
    /// If an array has another length than it should, or there are too many frames at this rate.
    #[wasm_bindgen(js_name = addTake)]
    pub fn add_take(
        &mut self,
        name: String,
        action: String,
        poses: &[f32],
        contacts: &[u8],
        proportions: &[f32],
        rate_hz: f32,
    ) -> Result<(), EngineError> {
        let clip = clip_of(name, action, poses, contacts)?;
        let carried = clip.carried(proportions_of(proportions)?, rate_hz, &self.proportions, self.rate_hz);
        self.takes.push(carried.map_err(EngineError::bad_input)?);
        Ok(())
    }
}

impl Clips {
    /// What is driven with of them.
    ///
    /// # Errors
    /// If there is too little locomotion among them.
    pub(crate) fn driving(&self) -> Result<DrivingClips, EngineError> {
        DrivingClips::new(self.proportions, self.rate_hz, &self.own, &self.takes).map_err(EngineError::bad_input)
    }
}

fn clip_of(name: String, action: String, poses: &[f32], contacts: &[u8]) -> Result<NeutralClip, EngineError> {
    let poses = poses_of(poses)?.collect();
    let contacts = contacts.as_chunks::<2>().0.iter().map(|feet| feet.map(|planted| planted != 0)).collect();
    Ok(NeutralClip { name, action, poses, contacts })
}
