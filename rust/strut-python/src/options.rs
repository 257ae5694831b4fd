//! Conversion of Python values to styles and options.

use crate::error::{bad_input, exception};
use pyo3::exceptions::{PyOverflowError, PyTypeError};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict};
use strut_core::transfer::BodyPart;
use strut_tasks::stylize::StyleSettings;
use strut_tasks::suggestion::unknown;
use strut_tasks::weights::{PartWeights, StyleWeights};

/// The option of the command that is a separate parameter here.
const OTHERWISE: &str = "part";

/// Reads weights from a text as in the command, or from a dict of numbers by name.
pub(crate) fn styles(value: &Bound<'_, PyAny>) -> PyResult<StyleWeights> {
    let py = value.py();
    if let Ok(text) = value.extract::<String>() {
        return text.parse().map_err(|reason: String| bad_input(py, reason));
    }
    let wrong = || PyTypeError::new_err("styles must be a dict of numbers by name, or a string such as 'proud=0.7'");
    let dict = value.cast::<PyDict>().map_err(|_| wrong())?;
    let pairs = dict.iter().map(|(name, weight)| {
        Ok((name.extract::<String>().map_err(|_| wrong())?, weight.extract::<f64>().map_err(|_| wrong())? as f32))
    });
    StyleWeights::new(pairs.collect::<PyResult<Vec<_>>>()?).map_err(|reason| bad_input(py, reason))
}

/// Creates settings from the arguments of a function.
pub(crate) fn settings(
    styles_value: &Bound<'_, PyAny>,
    parts: Option<&Bound<'_, PyDict>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<StyleSettings> {
    let mut settings = StyleSettings::new(styles(styles_value)?);
    set_parts(&mut settings, parts)?;
    set_options(&mut settings, options)?;
    Ok(settings)
}

/// Sets separate styles for parts of the body.
pub(crate) fn set_parts(settings: &mut StyleSettings, parts: Option<&Bound<'_, PyDict>>) -> PyResult<()> {
    let Some(parts) = parts else { return Ok(()) };
    settings.parts.clear();
    for (name, value) in parts {
        let name: String = name.extract().map_err(|_| PyTypeError::new_err("a body part must be a string"))?;
        let of = BodyPart::from_name(&name);
        let known = ["head", "torso", "left_arm", "right_arm", "arms", "legs"];
        let of = of.ok_or_else(|| bad_input(value.py(), unknown("body part", &name, &known)))?;
        settings.parts.push(PartWeights { parts: of, weights: styles(&value)? });
    }
    Ok(())
}

/// Sets the command's long options, with `_` for `-`. Switches are `True` and `False`; `None` keeps an option.
pub(crate) fn set_options(settings: &mut StyleSettings, options: Option<&Bound<'_, PyDict>>) -> PyResult<()> {
    for (name, value) in options.into_iter().flatten() {
        let name: String = name.extract()?;
        // Python's convention for its reserved words: `lambda_`.
        let option = name.trim_end_matches('_').replace('_', "-");
        if !StyleSettings::NAMES.contains(&option.as_str()) || option == OTHERWISE {
            return Err(PyTypeError::new_err(format!("there is no option '{name:.40}'")));
        }
        if value.is_none() {
            continue;
        }
        settings.set(&option, &text_of(&value)?).map_err(|error| exception(value.py(), &error))?;
    }
    Ok(())
}

/// Returns a value as text in the command's form.
pub(crate) fn text_of(value: &Bound<'_, PyAny>) -> PyResult<String> {
    Ok(match value.cast::<PyBool>() {
        Ok(switch) => (if switch.is_true() { "on" } else { "off" }).to_owned(),
        Err(_) => value.str()?.to_str()?.to_owned(),
    })
}

/// Reads one or several numbers, which Python may have out of the type's range.
pub(crate) fn number<'py, T: for<'a> FromPyObject<'a, 'py, Error = PyErr>>(value: &Bound<'py, PyAny>) -> PyResult<T> {
    let py = value.py();
    value.extract().map_err(|error: PyErr| {
        if error.is_instance_of::<PyOverflowError>(py) {
            let text = value.str().map(|text| text.to_string()).unwrap_or_default();
            return bad_input(py, format_args!("{text:.40} is out of range"));
        }
        error
    })
}
