//! A built-in input in another style's performance.

use crate::common::floats_of;
use wasm_bindgen::prelude::wasm_bindgen;

/// The poses of another style at the content of each input frame.
#[wasm_bindgen]
pub struct Counterpart(strut_demo::Counterpart);

#[wasm_bindgen]
impl Counterpart {
    /// Finds the counterpart of a built-in input in a style, by name; `undefined` if there is none.
    pub fn of(input: &str, style: &str) -> Option<Self> {
        strut_demo::counterpart(input, style).map(Self)
    }

    /// Returns the poses, one per input frame.
    pub fn poses(&self) -> Vec<f32> {
        floats_of(self.0.poses.iter())
    }

    /// Returns the time at which the style reaches the content of each input frame, seconds.
    #[wasm_bindgen(js_name = timeOut)]
    pub fn time_out(&self) -> Vec<f32> {
        self.0.time_secs.clone()
    }

    /// Returns the planted feet, left and right interleaved.
    pub fn planted(&self) -> Vec<u8> {
        self.0.planted.iter().flat_map(|feet| feet.map(u8::from)).collect()
    }
}
