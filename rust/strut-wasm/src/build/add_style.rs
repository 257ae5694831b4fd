//! A new style from one clip.

use crate::build::built::Built;
use crate::common::{EngineError, read_database};
use js_sys::Uint8Array;
use strut_core::database::build;
use strut_core::parallel::Sequential;
use strut_core::registration;
use strut_formats::corpus::{Clip, Entry, Labels};
use wasm_bindgen::prelude::wasm_bindgen;

/// Returns the database, a `.strutdb` or packed motions, with the BVH file added as a style. `action` is the action
/// that the user selected for the file; without it the most similar action is used.
///
/// # Errors
/// If the file cannot be added as a style, with the reason, or if the database has no such action.
#[wasm_bindgen(js_name = addStyle)]
pub fn add_style(
    database: Uint8Array,
    path: &str,
    style: String,
    bvh: &[u8],
    action: Option<String>,
) -> Result<Built, EngineError> {
    let clip = Clip::parse(bvh).map_err(EngineError::unusable_file)?;
    let db = read_database(database)?;
    let index_of = |name: String| match db.actions.iter().position(|known| *known == name) {
        Some(index) => Ok(index as u16),
        None => Err(EngineError::bad_input(format!("the database has no action '{name:.40}'"))),
    };
    let action = action.map(index_of).transpose()?;
    let labels = Labels { action: String::new(), style, take: Some(1) };
    let clip = Entry { path: path.to_owned(), labels, licence: String::new() }.source_clip(&clip, &db.proportions);
    let added = build::add_style_of(&db, &clip, action, &registration::Options::default(), &Sequential)
        .map_err(EngineError::unusable_file)?;
    Ok(Built::new(added.database, Vec::new(), Vec::new()).with_doubt(added.doubt))
}
