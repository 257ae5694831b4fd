//! How components share in poses.

use strut_core::somn::Mode;
use strut_wasm_common::EngineError;

/// The likeliest component alone without a temperature.
///
/// # Errors
/// If a number is out of its range.
pub(crate) fn mode(temperature: Option<f64>, blur: f64) -> Result<Mode, EngineError> {
    temperature.map_or(Ok(Mode::Hard), |temperature| Mode::smooth(temperature, blur)).map_err(EngineError::bad_input)
}

/// The numbers that [`mode`] makes the same of: the temperature and the blur, or none.
pub(crate) fn numbers(mode: Mode) -> Vec<f64> {
    match mode {
        Mode::Hard => Vec::new(),
        Mode::Smooth { temperature, blur } => vec![temperature, blur],
    }
}
