//! The built-in motions: as the file that the page loads, and a built-in input as another style performs it.

use strut_formats::strutdb::packed::{self, NamedMotion};
use strut_wasm_common::EngineError;
use strut_wasm_common::floats_of;
use wasm_bindgen::prelude::wasm_bindgen;

/// The built-in database and inputs in the packed format, not yet deflated: the build writes them to
/// `web/engine/motions/built_in.bin`.
///
/// # Errors
/// None for the motions that are built in.
#[wasm_bindgen(js_name = builtInMotions)]
pub fn built_in_motions() -> Result<Vec<u8>, EngineError> {
    let database = strut_demo::database().map_err(EngineError::bad_input)?;
    Ok(packed::write(&database, &named(strut_demo::input_clips()), "strut"))
}

/// Walks in every style and one input, likewise: `web/engine/motions/walk.bin`.
///
/// # Errors
/// None for the motions that are built in.
#[wasm_bindgen(js_name = builtInWalk)]
pub fn built_in_walk() -> Result<Vec<u8>, EngineError> {
    let database = strut_demo::walk_database().map_err(EngineError::bad_input)?;
    Ok(packed::write(&database, &named(vec![strut_demo::walk_input()]), "strut"))
}

fn named(clips: Vec<strut_demo::NamedMotion>) -> Vec<NamedMotion> {
    clips.into_iter().map(|clip| NamedMotion { name: clip.name.into(), motion: clip.motion }).collect()
}

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
