//! Handle of somebody who follows a hand.

use crate::frame::{Frame, style};
use crate::model::KeyStyleModel;
use std::sync::Arc;
use strut_core::somn::{self, Mode};
use wasm_bindgen::prelude::wasm_bindgen;

/// Somebody whose pose follows a hand that drags the style. One call a frame of the screen: [`Puppet::advance`] writes what is
/// to be shown where [`Puppet::frame_address`] points.
#[wasm_bindgen]
pub struct Puppet {
    puppet: somn::Puppet,
    frame: Frame,
}

#[wasm_bindgen]
impl Puppet {
    /// At rest in the mean style.
    #[wasm_bindgen(constructor)]
    pub fn new(model: &KeyStyleModel) -> Self {
        let frame = Frame::new(model.model.components.len(), model.model.axis_count());
        let mut made = Self { puppet: somn::Puppet::new(Arc::clone(&model.model)), frame };
        made.show();
        made
    }

    /// Whether the likeliest component alone is the pose.
    #[wasm_bindgen(js_name = setHard)]
    pub fn set_hard(&mut self, hard: bool) {
        self.puppet.set_mode(if hard { Mode::Hard } else { Mode::default() });
    }

    /// Takes the pose of a style at once, above the origin.
    pub fn jump(&mut self, values: &[f64]) {
        self.puppet.reset(&style(values));
        self.show();
    }

    /// Follows for so many seconds.
    pub fn advance(&mut self, secs: f64, values: &[f64]) {
        self.puppet.drag(&style(values), secs);
        self.show();
    }

    /// Where the numbers of the present frame lie in this memory.
    #[wasm_bindgen(js_name = frameAddress)]
    pub fn frame_address(&self) -> *const f32 {
        self.frame.address()
    }
}

impl Puppet {
    fn show(&mut self) {
        let Self { puppet, frame } = self;
        frame.show(puppet.pose(), puppet.synthesis().weights(), &puppet.measured(), puppet.style());
    }
}
