//! Handle of a key-style model.

use crate::common::{EngineError, floats_of, offsets_of};
use crate::key_style::frame::style;
use crate::key_style::mode::mode;
use std::sync::Arc;
use strut_core::somn::{self, RATE_HZ, Style, Synthesis};
use strut_formats::key_style_model;
use wasm_bindgen::prelude::wasm_bindgen;

/// A key-style model, shared with all objects that are created from it.
#[wasm_bindgen]
pub struct KeyStyleModel {
    pub(crate) model: Arc<somn::KeyStyleModel>,
    synthesis: Synthesis,
}

#[wasm_bindgen]
impl KeyStyleModel {
    /// Reads the model in a `.strutkeys` file.
    ///
    /// # Errors
    /// If the bytes are invalid.
    #[wasm_bindgen(constructor)]
    pub fn new(bytes: &[u8]) -> Result<Self, EngineError> {
        Ok(Self::of(key_style_model::read(bytes).map_err(EngineError::unusable_file)?))
    }

    /// Returns the style variables: names of measures, or expressions.
    pub fn axes(&self) -> Vec<String> {
        self.model.axes.iter().map(ToString::to_string).collect()
    }

    /// Returns the units of the style variables.
    pub fn units(&self) -> Vec<String> {
        self.model.axes.iter().map(|axis| axis.unit().to_string()).collect()
    }

    /// Returns the frame rate of recordings and exports, frames per second.
    #[wasm_bindgen(js_name = rateHz)]
    pub fn rate_hz(&self) -> f32 {
        RATE_HZ
    }

    /// Returns the number of components.
    pub fn components(&self) -> usize {
        self.model.components.len()
    }

    /// Returns the offset of each joint from its parent in the T-pose, metres: 21 × xyz.
    pub fn proportions(&self) -> Vec<f32> {
        offsets_of(&self.model.space.proportions)
    }

    /// Returns the names of the training motions.
    #[wasm_bindgen(js_name = clipNames)]
    pub fn clip_names(&self) -> Vec<String> {
        self.model.clips.iter().map(|clip| clip.name.clone()).collect()
    }

    /// Returns the number of frames of each training motion. Their frames are numbered consecutively.
    #[wasm_bindgen(js_name = clipFrames)]
    pub fn clip_frames(&self) -> Vec<u32> {
        self.model.clips.iter().map(|clip| clip.frames as u32).collect()
    }

    /// Returns the style of every training frame, one number per axis.
    pub fn values(&self) -> Vec<f32> {
        self.flat(self.model.styles.iter().map(|u| self.model.in_units(u)))
    }

    /// Returns the centre of each component's region of styles, one number per axis.
    pub fn centres(&self) -> Vec<f32> {
        self.flat(self.model.components.iter().map(|component| self.model.in_units(&component.centre)))
    }

    /// Returns the mean of the training styles.
    pub fn mean(&self) -> Vec<f32> {
        self.flat(std::iter::once(self.model.style_mean))
    }

    /// Returns the standard deviations of the training styles.
    pub fn deviation(&self) -> Vec<f32> {
        self.flat(std::iter::once(self.model.style_deviation))
    }

    /// Returns the training frame with the nearest style.
    pub fn nearest(&self, values: &[f64]) -> usize {
        self.synthesis.nearest(&style(values)).unwrap_or(0)
    }

    /// Returns the pose of a training frame, or `None` if there is no such frame.
    pub fn recorded(&self, frame: usize) -> Option<Vec<f32>> {
        let pose = || self.synthesis.pose_of(&self.model.recorded_row(frame));
        (frame < self.model.rows.len()).then(|| floats_of([pose()].iter()))
    }

    /// Returns the mean joint angle between the training poses and those synthesised from their styles in a mode,
    /// degrees.
    ///
    /// # Errors
    /// If a number of the mode is out of range.
    pub fn error(&mut self, temperature: Option<f64>, blur: f64) -> Result<f64, EngineError> {
        Ok(self.synthesis.recorded_error(mode(temperature, blur)?))
    }

    /// Returns the support by recorded styles at each grid point, minus the least value that counts as supported. Rows
    /// begin at the greatest value of the second axis; further axes are fixed at `values`.
    ///
    /// # Errors
    /// If there are too many points.
    #[allow(clippy::too_many_arguments)]
    pub fn support(
        &self,
        values: &[f64],
        x_least: f64,
        x_most: f64,
        columns: usize,
        y_least: f64,
        y_most: f64,
        rows: usize,
    ) -> Result<Vec<f32>, EngineError> {
        const MOST_PLACES: usize = 1 << 18;
        if columns.saturating_mul(rows) > MOST_PLACES {
            let places = format!("{columns} × {rows} points were requested; at most {MOST_PLACES} are supported");
            return Err(EngineError::bad_input(places));
        }
        let share = |i: usize, count: usize| if count > 1 { i as f64 / (count - 1) as f64 } else { 0.0 };
        let mut at = style(values);
        let mut map = Vec::with_capacity(columns * rows);
        for row in 0..rows {
            if rows > 1 {
                at[1] = y_most + share(row, rows) * (y_least - y_most);
            }
            for column in 0..columns {
                at[0] = x_least + share(column, columns) * (x_most - x_least);
                map.push((self.synthesis.support(&at) - self.model.least_support) as f32);
            }
        }
        Ok(map)
    }
}

impl KeyStyleModel {
    pub(crate) fn of(model: somn::KeyStyleModel) -> Self {
        let model = Arc::new(model);
        Self { synthesis: Synthesis::new(Arc::clone(&model)), model }
    }

    fn flat(&self, styles: impl Iterator<Item = Style>) -> Vec<f32> {
        let axes = self.model.axis_count();
        styles.flat_map(|style| style.into_iter().take(axes).map(|value| value as f32)).collect()
    }
}
