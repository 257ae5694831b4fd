//! Common arguments and results of functions that read clips.

use crate::error::exception;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;
use strut_formats::corpus::Pattern;
use strut_tasks::TaskError;
use strut_tasks::corpus::RefusedFile;

/// Reads a path, or several.
pub(crate) fn paths_of(value: &Bound<'_, PyAny>) -> PyResult<Vec<PathBuf>> {
    value.extract::<PathBuf>().map(|path| vec![path]).or_else(|_| value.extract())
}

/// Parses the pattern of labels in file names.
pub(crate) fn pattern_of(py: Python<'_>, text: Option<&str>) -> PyResult<Option<Pattern>> {
    text.map(str::parse::<Pattern>).transpose().map_err(|reason| exception(py, &TaskError::new(reason)))
}

/// Returns why files were not used, by their paths.
pub(crate) fn reasons<'py>(py: Python<'py>, refused: &[RefusedFile]) -> PyResult<Bound<'py, PyDict>> {
    let reasons = PyDict::new(py);
    refused.iter().try_for_each(|file| reasons.set_item(&file.file, &file.reason))?;
    Ok(reasons)
}
