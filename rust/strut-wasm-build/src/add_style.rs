//! A style from one clip.

use crate::builder::Built;
use crate::labels::text;
use strut_core::database::build::{self, SourceClip};
use strut_core::parallel::Sequential;
use strut_core::registration;
use strut_core::retarget::to_humanoid;
use strut_formats::corpus::{self, Clip};
use strut_formats::strutdb::{self, packed};
use wasm_bindgen::prelude::wasm_bindgen;

/// The database, a `.strutdb` or packed motions, with the BVH file as one more style.
///
/// # Errors
/// With why the file is no style of it.
#[wasm_bindgen(js_name = addStyle)]
pub fn add_style(database: Vec<u8>, path: &str, style: String, bvh: &[u8]) -> Result<Built, String> {
    let clip = Clip::parse(bvh).map_err(text)?;
    let is_packed = database.starts_with(&packed::MAGIC);
    let read = if is_packed {
        packed::read_database(&database)
    } else {
        strutdb::read(&database).map(|contents| contents.database)
    };
    let db = read.map_err(text)?;
    drop(database);
    let clip = SourceClip {
        name: corpus::stem(path).to_owned(),
        action: String::new(),
        style,
        take: 1,
        motion: to_humanoid(&clip.motion, &clip.binding, &db.proportions),
        source: path.to_owned(),
        licence: String::new(),
        script: None,
    };
    let added = build::add_style(&db, &clip, &registration::Options::default(), &Sequential).map_err(text)?;
    Ok(Built::new(added.database, Vec::new()))
}
