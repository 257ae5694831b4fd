//! Parsing of style variables.

use crate::common::sentence;
use strut_core::somn::Measure;
use wasm_bindgen::prelude::wasm_bindgen;

/// A parsed style variable, or its error.
#[wasm_bindgen]
pub struct CheckedMeasure {
    unit: String,
    fault: Option<(usize, String)>,
}

#[wasm_bindgen]
impl CheckedMeasure {
    /// Returns the unit; empty for pure numbers and for errors.
    pub fn unit(&self) -> String {
        self.unit.clone()
    }

    /// Returns the index of the character with the error, from 0; −1 for none.
    pub fn column(&self) -> i32 {
        self.fault.as_ref().map_or(-1, |(column, _)| i32::try_from(column.saturating_sub(1)).unwrap_or(0))
    }

    /// Returns the error; empty if there is none.
    pub fn message(&self) -> String {
        self.fault.as_ref().map_or(String::new(), |(_, message)| message.clone())
    }
}

/// Parses a style variable: the name of a measure, or an expression.
#[wasm_bindgen(js_name = checkMeasure)]
pub fn check_measure(text: &str) -> CheckedMeasure {
    match Measure::parse(text) {
        Ok(measure) => CheckedMeasure { unit: measure.unit().to_string(), fault: None },
        Err(error) => CheckedMeasure { unit: String::new(), fault: Some((error.column, sentence(error.fault))) },
    }
}
