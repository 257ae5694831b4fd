//! Handle of an online stylizer.

use crate::common::EngineError;
use crate::common::{floats_of, poses_of};
use crate::engine::database::Database;
use std::sync::Arc;
use strut_core::transfer::{self, BodyPart, Method, Options, StyledFrame};
use wasm_bindgen::prelude::wasm_bindgen;

/// One character's stream of frames. The results of the last batch are kept until the next, and are copied out on
/// request.
#[wasm_bindgen]
pub struct Stylizer {
    stylizer: transfer::Stylizer,
    batch: Vec<StyledFrame>,
}

#[wasm_bindgen]
impl Stylizer {
    /// Creates a stylizer with the default options in the neutral style.
    ///
    /// # Errors
    /// None with the default options.
    #[wasm_bindgen(constructor)]
    pub fn new(database: &Database) -> Result<Self, EngineError> {
        let stylizer =
            transfer::Stylizer::new(Arc::clone(database.model()), Options::DEFAULT).map_err(EngineError::bad_input)?;
        Ok(Self { stylizer, batch: Vec::new() })
    }

    /// Sets the options; the stream continues. `action` and `input_style` are the indices of the input's labels, if
    /// known.
    ///
    /// # Errors
    /// If an option is out of range, or the database has no class with these labels; the former options are then kept.
    #[allow(clippy::too_many_arguments)] // One call instead of an object that both sides would have to define.
    pub fn configure(
        &mut self,
        k: f64,
        lambda: f32,
        rho: f32,
        kappa: f32,
        delta: f32,
        tempo: f32,
        coherence: bool,
        timing: bool,
        footplant: bool,
        method: &str,
        action: Option<u16>,
        input_style: Option<u16>,
    ) -> Result<(), EngineError> {
        let method = method_named(method)
            .ok_or_else(|| EngineError::bad_input(String::from("this package does not have the method")))?;
        // The cast saturates; an invalid count becomes 0 or too large, and is refused.
        let k = k as usize;
        let labels = Options { action, input_style, ..*self.stylizer.options() };
        let options = Options { k, lambda, rho, kappa, delta, tempo, coherence, timing, footplant, method, ..labels };
        self.stylizer.set_options(options).map_err(EngineError::bad_input)
    }

    /// Sets one weight per style of the database; the remainder to 1 belongs to the neutral style.
    ///
    /// # Errors
    /// If there is not one finite weight per style; the former weights are then kept.
    #[wasm_bindgen(js_name = setStyles)]
    pub fn set_styles(&mut self, weights: &[f32]) -> Result<(), EngineError> {
        self.stylizer.set_styles(weights).map_err(EngineError::bad_input)
    }

    /// Sets separate weights for a part of the body, by its index in [`BodyPart::ALL`]. Without weights it follows the
    /// whole body again.
    ///
    /// # Errors
    /// Those of [`Stylizer::set_styles`], or if there is no such part.
    #[wasm_bindgen(js_name = setPartStyles)]
    pub fn set_part_styles(&mut self, part: usize, weights: &[f32]) -> Result<(), EngineError> {
        let part = BodyPart::ALL.get(part);
        let part = part.ok_or_else(|| EngineError::bad_input(String::from("there is no such part of the body")))?;
        let weights = Some(weights).filter(|w| !w.is_empty());
        self.stylizer.set_part_styles(*part, weights).map_err(EngineError::bad_input)
    }

    /// Sets how far the next frames are styled: 0 is the input, 1 the styles.
    #[cfg(feature = "neutral-clips")]
    #[wasm_bindgen(js_name = setStyleShare)]
    pub fn set_style_share(&mut self, share: f32) {
        self.stylizer.set_style_share(share);
    }

    /// Restarts at the place of the next input frame.
    pub fn reset(&mut self) {
        self.stylizer.reset(None);
    }

    /// Styles the next poses, one frame at the database's rate apart. Returns as many poses.
    ///
    /// # Errors
    /// If the array is not a whole number of poses.
    pub fn push(&mut self, poses: &[f32]) -> Result<Vec<f32>, EngineError> {
        self.batch.clear();
        for pose in poses_of(poses)? {
            self.batch.push(*self.stylizer.push(&pose));
        }
        Ok(floats_of(self.batch.iter().map(|f| &f.pose)))
    }

    /// Returns the output time from the previous frame to each frame of the last batch, seconds.
    pub fn durations(&self) -> Vec<f32> {
        self.batch.iter().map(|f| f.dt_secs).collect()
    }

    /// Returns the planted feet in the last batch, left and right interleaved.
    pub fn planted(&self) -> Vec<u8> {
        planted_of(&self.batch)
    }

    /// Returns the weight of each class in the last frame.
    #[wasm_bindgen(js_name = classWeights)]
    pub fn class_weights(&self) -> Vec<f32> {
        self.stylizer.trace().class_weights.to_vec()
    }
}

impl Stylizer {
    #[cfg(feature = "files")]
    pub(crate) fn core(&self) -> &transfer::Stylizer {
        &self.stylizer
    }

    #[cfg(feature = "bench")]
    pub(crate) fn core_mut(&mut self) -> &mut transfer::Stylizer {
        &mut self.stylizer
    }
}

/// The method of a name, if this package has it.
fn method_named(name: &str) -> Option<Method> {
    #[cfg(feature = "compare")]
    {
        strut_evaluation::baselines::method_named(name)
    }
    #[cfg(not(feature = "compare"))]
    {
        Method::from_name(name)
    }
}

/// Returns the planted feet, left and right interleaved.
pub(crate) fn planted_of(frames: &[StyledFrame]) -> Vec<u8> {
    frames.iter().flat_map(|f| f.planted.map(u8::from)).collect()
}
