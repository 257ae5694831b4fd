//! Errors of styled motion against real motion.

use crate::call::watched;
use crate::error::exception;
use crate::options::{number, text_of};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyTuple};
use std::path::PathBuf;
use strut_tasks::evaluate::{Request, evaluate as measure};
use strut_tasks::threads::with_threads;

/// Measures the error of styled motion against real motion, as `strut evaluate` does, and returns its rows of results.
/// Options are the long options of the command with `_` for `-`. All combinations of the values in lists are measured.
#[pyfunction]
#[pyo3(signature = (data, source, *, threads=0, progress=None, **options))]
pub(crate) fn evaluate<'py>(
    py: Python<'py>,
    data: PathBuf,
    source: String,
    #[pyo3(from_py_with = number)] threads: usize,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyAny>> {
    let mut request = Request::new(data, source);
    for (name, value) in options.into_iter().flatten() {
        let name: String = name.extract()?;
        let option = name.trim_end_matches('_').replace('_', "-");
        if !Request::NAMES.contains(&option.as_str()) {
            return Err(PyTypeError::new_err(format!("there is no option '{name:.40}'")));
        }
        if value.is_none() {
            continue;
        }
        let is_list = value.is_instance_of::<PyList>() || value.is_instance_of::<PyTuple>();
        let texts = if is_list {
            value.try_iter()?.map(|value| text_of(&value?)).collect::<PyResult<Vec<_>>>()?
        } else {
            vec![text_of(&value)?]
        };
        request.set(&option, &texts).map_err(|error| exception(py, &error))?;
    }
    let rows = watched(py, progress.as_ref(), |on_progress| {
        with_threads(threads, || measure(&request, on_progress)?.report.rows_json())?
    })?;
    py.import("json")?.getattr("loads")?.call1((rows,))
}
