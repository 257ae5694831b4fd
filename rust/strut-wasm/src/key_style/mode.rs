//! Mode in which components contribute to poses.

use crate::common::EngineError;
use strut_core::somn::Mode;

/// Returns a mode. Without a temperature only the most likely component is used.
///
/// # Errors
/// If a number is out of range.
pub(crate) fn mode(temperature: Option<f64>, blur: f64) -> Result<Mode, EngineError> {
    temperature.map_or(Ok(Mode::Hard), |temperature| Mode::smooth(temperature, blur)).map_err(EngineError::bad_input)
}

/// Returns the arguments of [`mode`] for a mode: temperature and blur, or nothing.
pub(crate) fn numbers(mode: Mode) -> Vec<f64> {
    match mode {
        Mode::Hard => Vec::new(),
        Mode::Smooth { temperature, blur } => vec![temperature, blur],
    }
}
