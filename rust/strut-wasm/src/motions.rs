//! The built-in motions as the files that the page loads.

use js_sys::Uint8Array;
use strut_formats::strutdb::packed::{self, NamedMotion};
use strut_wasm_common::EngineError;
use wasm_bindgen::prelude::wasm_bindgen;

/// The built-in motions in the packed format, not yet deflated, as two sets: first walks in every style and one input, then
/// all others, which are read after these. The build writes them to `web/engine/motions/`.
///
/// With `short` the walks are only as long as a page needs to begin with.
///
/// # Errors
/// None for the motions that are built in.
#[wasm_bindgen(js_name = builtInMotions)]
pub fn built_in_motions(short: bool) -> Result<Vec<Uint8Array>, EngineError> {
    let database = strut_demo::database().map_err(EngineError::bad_input)?;
    let walks = if short { strut_demo::first_walk_database } else { strut_demo::walk_database };
    let walks = walks(&database).map_err(EngineError::bad_input)?;
    let mut file = packed::write(&walks, &named(vec![strut_demo::walk_input()]));
    let first = file.len();
    packed::append(&mut file, &database, &named(strut_demo::input_clips())).map_err(EngineError::bad_input)?;
    let (walks, others) = file.split_at(first);
    Ok([walks, others].map(Uint8Array::from).to_vec())
}

fn named(clips: Vec<strut_demo::NamedMotion>) -> Vec<NamedMotion> {
    clips.into_iter().map(|clip| NamedMotion { name: clip.name.into(), motion: clip.motion }).collect()
}

/// Neutral takes to drive with in the packed format, not yet deflated: standing, turns on the spot, halts, changes of gait.
///
/// # Errors
/// None for the motions that are built in.
#[wasm_bindgen(js_name = drivingMotions)]
pub fn driving_motions() -> Result<Uint8Array, EngineError> {
    let takes = strut_demo::driving_database().map_err(EngineError::bad_input)?;
    Ok(Uint8Array::from(packed::write(&takes, &[]).as_slice()))
}
