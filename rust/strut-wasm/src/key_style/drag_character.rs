//! Handle of a dragged character.

use crate::common::EngineError;
use crate::key_style::frame::{Frame, style};
use crate::key_style::mode::{mode, numbers};
use crate::key_style::model::KeyStyleModel;
use js_sys::Float32Array;
use std::sync::Arc;
use strut_core::somn::{self, Mode};
use wasm_bindgen::prelude::wasm_bindgen;

/// Handle of a dragged character: its pose follows the pointer that drags the style. For each displayed frame call
/// [`DragCharacter::advance`], then [`DragCharacter::read`].
#[wasm_bindgen]
pub struct DragCharacter {
    character: somn::DragCharacter,
    frame: Frame,
}

#[wasm_bindgen]
impl DragCharacter {
    /// Creates a character at rest in the mean style.
    #[wasm_bindgen(constructor)]
    pub fn new(model: &KeyStyleModel) -> Self {
        let frame = Frame::new(model.model.components.len(), model.model.axis_count());
        let mut made = Self { character: somn::DragCharacter::new(Arc::clone(&model.model)), frame };
        made.show();
        made
    }

    /// Sets the mode. Components are weighted by their likelihood to the power of 1 / `temperature`, with regions
    /// blurred by `blur` standard deviations. Without a temperature only the most likely component is used.
    ///
    /// # Errors
    /// If a number is out of range; nothing changes then.
    #[wasm_bindgen(js_name = setMode)]
    pub fn set_mode(&mut self, temperature: Option<f64>, blur: f64) -> Result<(), EngineError> {
        self.character.set_mode(mode(temperature, blur)?);
        Ok(())
    }

    /// Returns temperature and blur of the default mode.
    #[wasm_bindgen(js_name = smoothMode)]
    pub fn smooth_mode() -> Vec<f64> {
        numbers(Mode::default())
    }

    /// Jumps to the pose of a style, above the origin.
    pub fn jump(&mut self, values: &[f64]) {
        self.character.reset(&style(values));
        self.show();
    }

    /// Moves towards a style for this many seconds.
    pub fn advance(&mut self, secs: f64, values: &[f64]) {
        self.character.drag(&style(values), secs);
        self.show();
    }

    /// Writes the numbers of the present frame to an array.
    ///
    /// # Errors
    /// If the array has another length.
    pub fn read(&self, into: &Float32Array) -> Result<(), EngineError> {
        self.frame.write(into)
    }
}

impl DragCharacter {
    fn show(&mut self) {
        let Self { character, frame } = self;
        frame.show(character.pose(), character.synthesis().weights(), &character.measured(), character.style());
    }
}
