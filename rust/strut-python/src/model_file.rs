//! What the models have in common: the bytes of their files, and the files that were not used.

use crate::call::watched;
use crate::corpus::reasons;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use std::path::{Path, PathBuf};
use strut_formats::container::Kind;
use strut_tasks::corpus::RefusedFile;
use strut_tasks::files::{self, Outputs};
use strut_tasks::{Outcome, TaskError};

/// The file of a model.
pub(crate) struct ModelFile {
    bytes: Vec<u8>,
    /// Files that were not used in the training.
    refused: Vec<RefusedFile>,
}

impl ModelFile {
    pub(crate) fn new(bytes: Vec<u8>, refused: Vec<RefusedFile>) -> Self {
        Self { bytes, refused }
    }

    /// Opens a file by its path, or from its bytes, and reads the model.
    pub(crate) fn open<M: Send, E: std::fmt::Display>(
        source: &Bound<'_, PyAny>,
        kind: Kind,
        read: fn(&[u8]) -> Result<M, E>,
    ) -> PyResult<(M, Self)> {
        let given = source.cast::<PyBytes>().ok().map(|bytes| bytes.as_bytes().to_owned());
        let path = if given.is_some() { PathBuf::from("the model") } else { source.extract()? };
        watched(source.py(), None, |_| {
            let bytes = given.map_or_else(|| files::read(&path, kind.max_bytes), Outcome::Ok)?;
            let model = read(&bytes).map_err(|reason| TaskError::in_file(Path::new(&path), reason))?;
            Ok((model, Self::new(bytes, Vec::new())))
        })
    }

    /// Writes the file.
    pub(crate) fn save(&self, py: Python<'_>, path: &Path) -> PyResult<()> {
        watched(py, None, |_| {
            let mut outputs = Outputs::default();
            outputs.stage(path, &self.bytes)?;
            outputs.commit()
        })
    }

    /// The bytes of the file.
    pub(crate) fn to_bytes<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        PyBytes::new(py, &self.bytes)
    }

    /// The reasons why files were not used, by path.
    pub(crate) fn refused<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        reasons(py, &self.refused)
    }
}
