//! Labels of files.

use crate::common::{EngineError, sentence};
use strut_formats::corpus::{self, Labels, Pattern, Table};
use wasm_bindgen::prelude::wasm_bindgen;

/// Returns the most likely pattern of these paths, or `None` if their names do not have two parts.
#[wasm_bindgen(js_name = guessPattern)]
pub fn guess_pattern(paths: Vec<String>) -> Option<String> {
    corpus::guess_pattern(&paths).map(|pattern| pattern.to_string())
}

/// Returns four strings for each path: action, style, take, and the reason why there are no labels. Strings that do not
/// apply are empty.
///
/// # Errors
/// If the pattern is invalid, or with the faulty line of the table.
#[wasm_bindgen(js_name = labelsOf)]
pub fn labels_of(
    paths: Vec<String>,
    pattern: Option<String>,
    table: Option<Vec<u8>>,
) -> Result<Vec<String>, EngineError> {
    let pattern: Option<Pattern> = pattern.map(|p| p.parse()).transpose().map_err(EngineError::bad_input)?;
    let table = table.map(|bytes| Table::parse(&bytes)).transpose().map_err(EngineError::bad_input)?;
    let labels = corpus::assign(&paths, pattern.as_ref(), table.as_ref()).map_err(EngineError::bad_input)?;
    let row = |labels| match labels {
        Ok(Labels { action, style, take }) => {
            [action, style, take.map(|t| t.to_string()).unwrap_or_default(), String::new()]
        }
        Err(reason) => [String::new(), String::new(), String::new(), sentence(reason)],
    };
    Ok(labels.into_iter().flat_map(row).collect())
}

/// Returns the title of a licence's text; empty if it has none.
#[wasm_bindgen(js_name = licenceTitle)]
pub fn licence_title(text: &[u8]) -> String {
    corpus::licence_title(text)
}
