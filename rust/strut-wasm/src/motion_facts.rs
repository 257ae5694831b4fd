//! What a motion's file says, before it is carried over to a database.

use crate::input_file::{FileRead, InputFile, texts_of};
use crate::packed_motions::PackedMotions;
use js_sys::Function;
use strut_wasm_common::EngineError;
use wasm_bindgen::prelude::wasm_bindgen;

/// Length and rate of a motion, and how its skeleton matches the humanoid.
#[wasm_bindgen]
pub struct MotionFacts {
    frames: usize,
    rate_hz: f64,
    file: Option<InputFile>,
}

#[wasm_bindgen]
impl MotionFacts {
    /// Of a BVH file; see `Input::from_bvh`.
    ///
    /// # Errors
    /// With what is wrong with the bytes, with what was said, or with the skeleton.
    #[wasm_bindgen(js_name = ofBvh)]
    pub fn of_bvh(bytes: &[u8], said: &Function) -> Result<Self, EngineError> {
        let file = InputFile::read_as(bytes, said)?;
        Ok(Self { frames: file.frames(), rate_hz: file.rate_hz(), file: Some(file) })
    }

    /// Of an input among packed motions.
    ///
    /// # Errors
    /// If there is none of this name, or with what is wrong with the bytes.
    #[wasm_bindgen(js_name = ofPacked)]
    pub fn of_packed(motions: &PackedMotions, name: &str) -> Result<Self, EngineError> {
        let motion = motions.input(name)?;
        Ok(Self { frames: motion.poses.len(), rate_hz: f64::from(motion.rate_hz), file: None })
    }

    /// Frames of the file.
    pub fn frames(&self) -> usize {
        self.frames
    }

    /// Frames per second of the file.
    #[wasm_bindgen(js_name = rateHz)]
    pub fn rate_hz(&self) -> f64 {
        self.rate_hz
    }

    /// Sentences on the match of the skeletons; empty if there are none.
    pub fn note(&self) -> String {
        self.file.as_ref().map(InputFile::note).unwrap_or_default()
    }

    /// What may be wrong with how the file was read: codes and sentences, one after the other.
    pub fn notes(&self) -> Vec<String> {
        texts_of(self.file.as_ref().map_or(&[], InputFile::doubts))
    }

    /// How the file was read; `undefined` if there is none.
    pub fn read(&self) -> Option<FileRead> {
        self.file.as_ref().map(InputFile::read)
    }
}
