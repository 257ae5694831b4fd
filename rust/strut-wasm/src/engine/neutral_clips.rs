//! The neutral clips of a database for the driving package, and inputs from driven motion.

use crate::common::{EngineError, bvh_of, floats_of, poses_of};
use crate::engine::database::Database;
use crate::engine::input::Input;
use strut_core::database::Clip;
use strut_core::humanoid::HumanoidMotion;
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen]
impl Database {
    /// Returns the indices of the clips in the neutral style.
    #[wasm_bindgen(js_name = neutralClips)]
    pub fn neutral_clips(&self) -> Vec<u32> {
        let catalogue = self.model().catalogue();
        let numbers = (0..).zip(&catalogue.clips);
        numbers.filter(|(_, clip)| clip.style == catalogue.neutral).map(|(number, _)| number).collect()
    }

    /// Returns the name of a clip; empty if there is no such clip.
    #[wasm_bindgen(js_name = clipName)]
    pub fn clip_name(&self, clip: usize) -> String {
        self.model().catalogue().clips.get(clip).map(|clip| clip.name.clone()).unwrap_or_default()
    }

    /// Returns the name of a clip's action; empty if there is no such clip.
    #[wasm_bindgen(js_name = clipAction)]
    pub fn clip_action(&self, clip: usize) -> String {
        let catalogue = self.model().catalogue();
        let action = catalogue.clips.get(clip).map(|clip| usize::from(clip.action));
        action.and_then(|action| catalogue.actions.get(action).cloned()).unwrap_or_default()
    }

    /// Returns the world poses of a clip, which starts above the origin and faces +Z; empty if there is no such clip.
    #[wasm_bindgen(js_name = clipPoses)]
    pub fn clip_poses(&self, clip: usize) -> Vec<f32> {
        let catalogue = self.model().catalogue();
        if clip < catalogue.clips.len() { floats_of(catalogue.poses_of_clip(clip).iter()) } else { Vec::new() }
    }

    /// Returns the text of a BVH file with poses on this body and at this rate.
    ///
    /// # Errors
    /// If the array is not a whole number of poses, or a number is out of the range of BVH files.
    #[wasm_bindgen(js_name = bvhOfPoses)]
    pub fn bvh_of_poses(&self, poses: &[f32]) -> Result<String, EngineError> {
        let header = self.model().catalogue();
        let poses = poses_of(poses)?.collect();
        bvh_of(&HumanoidMotion { proportions: header.proportions, rate_hz: header.rate_hz, poses })
    }

    /// Creates an input of poses on this body and at this rate, unchanged.
    ///
    /// # Errors
    /// If the array is not a whole number of poses.
    #[wasm_bindgen(js_name = inputOfPoses)]
    pub fn input_of_poses(&self, poses: &[f32]) -> Result<Input, EngineError> {
        let header = self.model().catalogue();
        Ok(Input::of_poses(header.proportions, header.rate_hz, poses_of(poses)?.collect()))
    }

    /// Returns the planted feet in each of a clip's frames, left and right interleaved.
    #[wasm_bindgen(js_name = clipContacts)]
    pub fn clip_contacts(&self, clip: usize) -> Vec<u8> {
        let catalogue = self.model().catalogue();
        let rows = catalogue.clips.get(clip).map(Clip::rows).unwrap_or_default();
        rows.flat_map(|row| catalogue.contact(row)).collect()
    }
}
