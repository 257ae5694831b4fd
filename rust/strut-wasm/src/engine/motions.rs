//! The built-in motions as the files that the page loads.

use crate::common::EngineError;
use js_sys::Uint8Array;
use strut_formats::strutdb::packed::{self, NamedMotion};
use wasm_bindgen::prelude::wasm_bindgen;

/// Returns the built-in motions in the packed format, before compression, as two sets. The first has walks in every
/// style and one input; the second has the others and requires the first. The build writes them to
/// `web/engine/motions/`.
///
/// With `short` the walks are only as long as a page needs to start.
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

/// Returns neutral takes for driving in the packed format, before compression: standing, turns in place, stops, changes
/// of gait.
///
/// # Errors
/// None for the motions that are built in.
#[wasm_bindgen(js_name = drivingMotions)]
pub fn driving_motions() -> Result<Uint8Array, EngineError> {
    let takes = strut_demo::driving_database().map_err(EngineError::bad_input)?;
    Ok(Uint8Array::from(packed::write(&takes, &[]).as_slice()))
}
