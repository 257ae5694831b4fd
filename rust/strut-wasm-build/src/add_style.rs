//! A style from one clip.

use crate::built::Built;
use js_sys::Uint8Array;
use strut_core::database::build;
use strut_core::parallel::Sequential;
use strut_core::registration;
use strut_formats::corpus::{Clip, Entry, Labels};
use strut_wasm_common::{EngineError, read_database};
use wasm_bindgen::prelude::wasm_bindgen;

/// The database, a `.strutdb` or packed motions, with the BVH file as one more style.
///
/// # Errors
/// With why the file is no style of it.
#[wasm_bindgen(js_name = addStyle)]
pub fn add_style(database: Uint8Array, path: &str, style: String, bvh: &[u8]) -> Result<Built, EngineError> {
    let clip = Clip::parse(bvh).map_err(EngineError::unusable_file)?;
    let db = read_database(database)?;
    let labels = Labels { action: String::new(), style, take: Some(1) };
    let clip = Entry { path: path.to_owned(), labels, licence: String::new() }.source_clip(&clip, &db.proportions);
    let added = build::add_style(&db, &clip, &registration::Options::default(), &Sequential)
        .map_err(EngineError::unusable_file)?;
    Ok(Built::new(added.database, Vec::new(), Vec::new()))
}
