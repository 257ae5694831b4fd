//! Handle of a motion that is predicted in every style, for the performers package.

use crate::common::EngineError;
use crate::engine::input::Input;
use crate::engine::stylizer::Stylizer;
use strut_core::humanoid::Pose;
use strut_core::transfer::{FADE_FRAMES, Predictions, Recorder};
use wasm_bindgen::prelude::wasm_bindgen;

/// Prediction of an input, or a part of it, in portions.
#[wasm_bindgen]
pub struct Recording {
    poses: Vec<Pose>,
    recorder: Recorder,
}

#[wasm_bindgen]
impl Recording {
    /// Creates a recording of up to `frames` frames of the input from `first` on, with a stylizer's options.
    ///
    /// # Errors
    /// None.
    #[wasm_bindgen(constructor)]
    pub fn new(stylizer: &Stylizer, input: &Input, first: usize, frames: usize) -> Result<Self, EngineError> {
        let recorder = Recorder::new(stylizer.core());
        let poses = input.humanoid().poses.iter().skip(first).take(frames).copied().collect();
        Ok(Self { poses, recorder })
    }

    /// Predicts up to `frames` more frames and returns the number done.
    pub fn run(&mut self, frames: usize) -> usize {
        for pose in self.poses.iter().skip(self.recorder.frames()).take(frames) {
            self.recorder.push(pose);
        }
        self.recorder.frames()
    }

    /// Returns the predictions, for the performers package.
    ///
    /// # Errors
    /// If they are too short to loop.
    pub fn numbers(&self) -> Result<Vec<f32>, EngineError> {
        let short =
            || EngineError::bad_input(format!("the motion is too short: it must have {} frames", 2 * FADE_FRAMES));
        self.recorder.predictions().map(Predictions::to_floats).ok_or_else(short)
    }
}
