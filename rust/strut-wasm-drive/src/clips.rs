//! Handle of the clips that are driven with.

use strut_core::driving::{DrivingClips, NeutralClip};
use strut_core::humanoid::{HumanoidMotion, Proportions};
use strut_formats::strutdb::packed;
use strut_wasm_common::{EngineError, bvh_of, poses_of, proportions_of};
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
        let poses = poses_of(poses)?.collect();
        let contacts = contacts.as_chunks::<2>().0.iter().map(|feet| feet.map(|planted| planted != 0)).collect();
        self.own.push(NeutralClip { name, action, poses, contacts });
        Ok(())
    }

    /// Adds takes that the clips may lack, packed motions: they are carried over to the body.
    ///
    /// # Errors
    /// With what is wrong with the bytes.
    #[wasm_bindgen(js_name = addTakes)]
    pub fn add_takes(&mut self, bytes: &[u8]) -> Result<(), EngineError> {
        let hint = "Reload the page; if that does not help, the site was not deployed completely.";
        let takes = packed::read_database(bytes).map_err(|error| EngineError::bad_file(error, hint))?;
        let takes = NeutralClip::all_carried(&takes, &self.proportions, self.rate_hz);
        self.takes.extend(takes.map_err(EngineError::bad_input)?);
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

/// The text of a BVH file of poses on a body (21 × xyz, metres) and at a rate.
///
/// # Errors
/// If an array has another length, or a number is beyond all that files hold.
#[wasm_bindgen(js_name = bvhOfPoses)]
pub fn bvh_of_poses(proportions: &[f32], rate_hz: f32, poses: &[f32]) -> Result<String, EngineError> {
    let poses = poses_of(poses)?.collect();
    bvh_of(&HumanoidMotion { proportions: proportions_of(proportions)?, rate_hz, poses })
}
