//! Handle of an input motion.

use crate::database::Database;
use crate::error::EngineError;
use crate::poses::floats_of;
use strut_core::contact;
use strut_core::humanoid::HumanoidMotion;
use wasm_bindgen::prelude::wasm_bindgen;

/// A motion on a database's humanoid and at its rate.
#[wasm_bindgen]
pub struct Input {
    humanoid: HumanoidMotion,
}

/// Names of the built-in inputs, the default first.
#[wasm_bindgen(js_name = builtInInputs)]
pub fn built_in_inputs() -> Vec<String> {
    strut_demo::input_clips().into_iter().map(|c| c.name.into()).collect()
}

#[wasm_bindgen]
impl Input {
    /// A built-in input.
    ///
    /// # Errors
    /// If there is none of this name.
    #[wasm_bindgen(js_name = builtIn)]
    pub fn built_in(database: &Database, name: &str) -> Result<Self, EngineError> {
        let clip = strut_demo::input_clips().into_iter().find(|c| c.name == name);
        let clip = clip.ok_or_else(|| EngineError::bad_input(format!("there is no built-in input '{name}'")))?;
        let db = database.model().database();
        let mut humanoid = clip.motion.resampled(db.rate_hz);
        humanoid.proportions = db.proportions;
        Ok(Self { humanoid })
    }

    /// A BVH file.
    ///
    /// # Errors
    /// With what is wrong with the bytes.
    #[wasm_bindgen(js_name = fromBvh)]
    pub fn from_bvh(_database: &Database, bytes: &[u8]) -> Result<Self, EngineError> {
        Err(EngineError::bad_file(format!("BVH files of {} bytes cannot be read yet", bytes.len()), ""))
    }

    /// Number of frames.
    pub fn frames(&self) -> usize {
        self.humanoid.poses.len()
    }

    /// What people should know about the match of the skeletons; empty if there is nothing to say.
    pub fn note(&self) -> String {
        String::new()
    }

    /// The poses.
    pub fn poses(&self) -> Vec<f32> {
        floats_of(self.humanoid.poses.iter())
    }

    /// Foot contacts of the input, left and right interleaved, 1 while planted.
    pub fn contacts(&self) -> Vec<u8> {
        contact::label(&self.humanoid).into_iter().flat_map(|c| c.map(u8::from)).collect()
    }
}

impl Input {
    pub(crate) fn humanoid(&self) -> &HumanoidMotion {
        &self.humanoid
    }
}
