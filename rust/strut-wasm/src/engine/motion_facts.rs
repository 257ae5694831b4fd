//! Facts about a motion's file, before it is retargeted to a database.

use crate::common::EngineError;
use crate::engine::input_file::{FileRead, InputFile, texts_of};
use crate::engine::packed_motions::PackedMotions;
use js_sys::Function;
use wasm_bindgen::prelude::wasm_bindgen;

/// Length and frame rate of a motion, and its joint mapping.
#[wasm_bindgen]
pub struct MotionFacts {
    frames: usize,
    rate_hz: f64,
    file: Option<InputFile>,
}

#[wasm_bindgen]
impl MotionFacts {
    /// Reads a BVH file; see `Input::from_bvh`.
    ///
    /// # Errors
    /// If the bytes, the options or the skeleton are invalid.
    #[wasm_bindgen(js_name = ofBvh)]
    pub fn of_bvh(bytes: &[u8], said: &Function) -> Result<Self, EngineError> {
        let file = InputFile::read_as(bytes, said)?;
        Ok(Self { frames: file.frames(), rate_hz: file.rate_hz(), file: Some(file) })
    }

    /// Reads an input of packed motions.
    ///
    /// # Errors
    /// If there is no input with this name, or the bytes are invalid.
    #[wasm_bindgen(js_name = ofPacked)]
    pub fn of_packed(motions: &PackedMotions, name: &str) -> Result<Self, EngineError> {
        let motion = motions.input(name)?;
        Ok(Self { frames: motion.poses.len(), rate_hz: f64::from(motion.rate_hz), file: None })
    }

    /// Returns the number of frames of the file.
    pub fn frames(&self) -> usize {
        self.frames
    }

    /// Returns the frame rate of the file, frames per second.
    #[wasm_bindgen(js_name = rateHz)]
    pub fn rate_hz(&self) -> f64 {
        self.rate_hz
    }

    /// Returns sentences on the joint mapping; empty if there are none.
    pub fn note(&self) -> String {
        self.file.as_ref().map(InputFile::note).unwrap_or_default()
    }

    /// Returns warnings about the reading: codes and sentences, alternately.
    pub fn notes(&self) -> Vec<String> {
        texts_of(self.file.as_ref().map_or(&[], InputFile::doubts))
    }

    /// Returns how the file was read; `undefined` without a file.
    pub fn read(&self) -> Option<FileRead> {
        self.file.as_ref().map(InputFile::read)
    }
}
