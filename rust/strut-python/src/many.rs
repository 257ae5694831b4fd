//! Styling of many motions.

use crate::call::watched;
use crate::clip::{Motion, Named};
use crate::database::Database;
use crate::error::exception;
use crate::options::{number, settings};
use crate::styled::StyledMotion;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyIterator};
use rayon::iter::{IndexedParallelIterator, IntoParallelRefIterator, ParallelIterator};
use std::collections::VecDeque;
use std::path::Path;
use std::sync::Arc;
use strut_tasks::Outcome;
use strut_tasks::stylize::{Spread, Styled, Styling};
use strut_tasks::threads::{check_threads, with_threads};

/// Number of motions per thread that are styled together: few enough for the memory, and enough to keep threads busy.
const MOTIONS_A_THREAD: usize = 8;

/// An iterator over styled motions, in the order of the motions. A motion that cannot be styled is replaced by its
/// error.
#[pyclass(module = "strut")]
pub(crate) struct StyledMotions {
    motions: Py<PyIterator>,
    styling: Arc<Styling>,
    threads: usize,
    /// Finished motions, or their errors.
    ready: VecDeque<Outcome<Styled>>,
}

#[pymethods]
impl StyledMotions {
    #[new]
    #[pyo3(signature = (motions, db, styles, *, parts=None, threads=0, **options))]
    fn new(
        py: Python<'_>,
        motions: &Bound<'_, PyAny>,
        db: &Database,
        styles: &Bound<'_, PyAny>,
        parts: Option<&Bound<'_, PyDict>>,
        #[pyo3(from_py_with = number)] threads: usize,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let settings = settings(styles, parts, options)?;
        let name = db.message_name();
        let styling = watched(py, None, |_| {
            let model = db.model(settings.search)?;
            Ok(Styling::new(settings.stylizer(&model, Path::new(&name))?))
        })?;
        check_threads(threads).map_err(|error| exception(py, &error))?;
        let threads = match threads {
            0 => std::thread::available_parallelism().map_or(1, std::num::NonZero::get),
            threads => threads,
        };
        let motions = motions.try_iter()?.unbind();
        Ok(Self { motions, styling: Arc::new(styling), threads, ready: VecDeque::new() })
    }

    fn __iter__(slf: Py<Self>) -> Py<Self> {
        slf
    }

    fn __next__(&mut self, py: Python<'_>) -> PyResult<Option<Py<PyAny>>> {
        if self.ready.is_empty() {
            self.fill(py)?;
        }
        let Some(styled) = self.ready.pop_front() else { return Ok(None) };
        Ok(Some(match styled {
            Ok(styled) => Py::new(py, StyledMotion::new(styled, &self.styling, None))?.into_any(),
            Err(error) => exception(py, &error).into_value(py).into_any(),
        }))
    }
}

impl StyledMotions {
    /// Styles the next motions.
    fn fill(&mut self, py: Python<'_>) -> PyResult<()> {
        let mut batch: Vec<Arc<Named>> = Vec::new();
        for motion in self.motions.bind(py).clone().take(self.threads * MOTIONS_A_THREAD) {
            batch.push(Arc::clone(&motion?.cast::<Motion>()?.get().named));
        }
        let (styling, threads) = (&self.styling, self.threads);
        let styled: Vec<Outcome<Styled>> = watched(py, None, |on_progress| {
            let style = |named: &Arc<Named>| styling.style(&named.name, &named.clip, None, Spread::Clips, on_progress);
            with_threads(threads, || batch.par_iter().with_max_len(1).map(style).collect())
        })?;
        self.ready.extend(styled);
        Ok(())
    }
}
