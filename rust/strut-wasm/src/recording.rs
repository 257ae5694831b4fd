//! Handle of a motion that is predicted in every style, which another package performs.

use crate::input::Input;
use crate::stylizer::Stylizer;
use strut_core::humanoid::Pose;
use strut_core::transfer::{FADE_FRAMES, Predictions, Recorder};
use strut_wasm_common::EngineError;
use wasm_bindgen::prelude::wasm_bindgen;

/// An input, or a part of it, on its way through the engine in portions.
#[wasm_bindgen]
pub struct Recording {
    poses: Vec<Pose>,
    recorder: Recorder,
}

#[wasm_bindgen]
impl Recording {
    /// Up to `frames` frames of the input from `first` on, with a stylizer's options.
    ///
    /// # Errors
    /// None.
    #[wasm_bindgen(constructor)]
    pub fn new(stylizer: &Stylizer, input: &Input, first: usize, frames: usize) -> Result<Self, EngineError> {
        let recorder = Recorder::new(stylizer.core()).map_err(EngineError::bad_input)?;
        let poses = input.humanoid().poses.iter().skip(first).take(frames).copied().collect();
        Ok(Self { poses, recorder })
    }

    /// Predicts up to `frames` more frames and gives the number done.
    pub fn run(&mut self, frames: usize) -> usize {
        for pose in self.poses.iter().skip(self.recorder.frames()).take(frames) {
            self.recorder.push(pose);
        }
        self.recorder.frames()
    }

    /// What was predicted, for the package that performs it.
    ///
    /// # Errors
    /// If it is too short to begin anew.
    pub fn numbers(&self) -> Result<Vec<f32>, EngineError> {
        let short =
            || EngineError::bad_input(format!("the motion is too short: it must have {} frames", 2 * FADE_FRAMES));
        self.recorder.predictions().map(Predictions::to_floats).ok_or_else(short)
    }
}
