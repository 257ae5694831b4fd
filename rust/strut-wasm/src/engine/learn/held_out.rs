//! The built-in database without some takes.

use crate::common::EngineError;
use crate::engine::database::Database;
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen]
impl Database {
    /// Creates the built-in database without the takes of these names, such as "walk-pace", in any style. It is
    /// generated again, which takes seconds.
    ///
    /// # Errors
    /// If no take of the neutral style remains.
    #[wasm_bindgen(js_name = builtInWithout)]
    pub fn built_in_without(takes: Vec<String>) -> Result<Self, EngineError> {
        strut_demo::database_without(&takes).map(Self::new).map_err(EngineError::bad_input)
    }
}
