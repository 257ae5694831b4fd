//! A built-in input as another style performs it.

use strut_wasm_common::floats_of;
use wasm_bindgen::prelude::wasm_bindgen;

/// The poses of another style at the content of each input frame.
#[wasm_bindgen]
pub struct Counterpart(strut_demo::Counterpart);

#[wasm_bindgen]
impl Counterpart {
    /// Of a built-in input in a style, by their names; `undefined` if there is none.
    pub fn of(input: &str, style: &str) -> Option<Self> {
        strut_demo::counterpart(input, style).map(Self)
    }

    /// Poses, one an input frame.
    pub fn poses(&self) -> Vec<f32> {
        floats_of(self.0.poses.iter())
    }

    /// Seconds after which the style has performed the content of each input frame.
    #[wasm_bindgen(js_name = timeOut)]
    pub fn time_out(&self) -> Vec<f32> {
        self.0.time_secs.clone()
    }

    /// Planted feet, left and right interleaved.
    pub fn planted(&self) -> Vec<u8> {
        self.0.planted.iter().flat_map(|feet| feet.map(u8::from)).collect()
    }
}
