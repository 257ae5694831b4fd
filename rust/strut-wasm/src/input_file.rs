//! Inputs from BVH files, and back.

use crate::database::Database;
use crate::input::{Input, too_long};
use strut_core::humanoid::HumanoidMotion;
use strut_core::motion::Motion;
use strut_core::retarget::{Binding, to_humanoid};
use strut_core::transfer::StyledMotion;
use strut_formats::bvh::{self, Bvh, BvhError};
use strut_wasm_common::EngineError;
use wasm_bindgen::prelude::wasm_bindgen;

/// The parts of a file that an export needs.
#[derive(Clone)]
pub(crate) struct InputFile {
    bvh: Bvh,
    motion: Motion,
    binding: Binding,
}

#[wasm_bindgen]
impl Input {
    /// A BVH file.
    ///
    /// # Errors
    /// With what is wrong with the bytes.
    #[wasm_bindgen(js_name = fromBvh)]
    pub fn from_bvh(database: &Database, bytes: &[u8]) -> Result<Self, EngineError> {
        Self::from_file(database, bvh::parse(bytes).map_err(unreadable)?)
    }
}

impl Input {
    fn from_file(database: &Database, bvh: Bvh) -> Result<Self, EngineError> {
        let db = database.model().catalogue();
        let motion = bvh.to_motion().map_err(unreadable)?;
        let binding = Binding::detect(&motion).map_err(|e| EngineError::bad_file(e, ""))?;
        let humanoid = to_humanoid(&motion, &binding, &db.proportions).resampled(db.rate_hz).map_err(too_long)?;
        let note = binding.notes.join(" ");
        Ok(Self { humanoid, note, file: Some(InputFile { bvh, motion, binding }) })
    }

    /// A motion that came from no file, on the body of a database.
    ///
    /// # Errors
    /// If its skeleton cannot be carried over.
    pub(crate) fn on_another_body(database: &Database, motion: &HumanoidMotion) -> Result<Self, EngineError> {
        let bvh = Bvh::from_humanoid(motion).map_err(unreadable)?;
        Ok(Self::of_motion(Self::from_file(database, bvh)?.humanoid))
    }

    /// This input in a style as a BVH file: on the input's own skeleton and at its own rate, or as a
    /// humanoid of the database's if it came from no file.
    ///
    /// # Errors
    /// If the styled motion is not finite, which the engine prevents.
    pub(crate) fn export(&self, styled: &StyledMotion) -> Result<String, EngineError> {
        let bvh = match &self.file {
            None => Bvh::from_humanoid(&styled.on_body(&self.humanoid.proportions, self.humanoid.rate_hz).motion),
            Some(InputFile { bvh, motion, binding }) => {
                bvh.with_motion(&styled.on_skeleton(self.humanoid.rate_hz, motion, binding))
            }
        };
        bvh.map(|bvh| bvh::write(&bvh)).map_err(unreadable)
    }
}

pub(crate) fn unreadable(error: BvhError) -> EngineError {
    EngineError::bad_file(error, "Export the clip again as BVH, or drop another file.")
}
