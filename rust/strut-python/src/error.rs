//! Errors of tasks as Python's exceptions.

use pyo3::prelude::*;
use std::io;
use strut_tasks::{Code, TaskError};

/// Returns the exception of an error: an `OSError` for an I/O error, otherwise a `StrutError`.
pub(crate) fn exception(py: Python<'_>, error: &TaskError) -> PyErr {
    match error.code {
        Code::Io(kind) => io::Error::new(kind, error.message.clone()).into(),
        code => {
            let class = py.import("strut._errors").and_then(|module| module.getattr("StrutError"));
            let made = class.and_then(|class| class.call1((&error.message, code.name(), error.hint.as_deref())));
            made.map_or_else(|failure| failure, PyErr::from_value)
        }
    }
}

/// Returns the exception of arguments that do not match.
pub(crate) fn bad_input(py: Python<'_>, message: impl std::fmt::Display) -> PyErr {
    exception(py, &TaskError::of(Code::BadInput, message))
}
