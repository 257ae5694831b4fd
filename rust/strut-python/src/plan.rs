//! Batches whose jobs are done by workers.

use crate::call::watched;
use crate::clip::reading;
use crate::corpus::paths_of;
use crate::database::Database;
use crate::error::{bad_input, exception};
use crate::options::{number, set_options, set_parts, styles};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{IntoPyDict, PyDict, PyDictMethods, PyString, PyTuple};
use std::path::PathBuf;
use strut_tasks::batch::{self, BatchRequest, PlannedJob, Record, Retry, Shard, Status, Variant, read_variants};
use strut_tasks::note_report::NoteReport;
use strut_tasks::stylize::StyleSettings;
use strut_tasks::threads::with_threads;
use strut_tasks::weights::StyleWeights;
use strut_tasks::{Outcome, TaskError};

/// A batch for several processes. One process plans the jobs and records their results. Workers, each with a copy of
/// the plan, perform the jobs.
///
/// `variants` are styles as in `strut stylize-batch --style`, a dict of styles by the names of the variants, or the
/// path of a table of variants. The files and the manifest are those of `strut stylize-batch`, byte for byte.
#[pyclass(frozen, module = "strut.batch")]
pub(crate) struct Plan {
    plan: batch::Plan,
    /// Arguments of the constructor.
    arguments: (Py<PyTuple>, Py<PyDict>),
}

/// Function that pickle calls, with its arguments.
type Reduced<'py> = (Bound<'py, PyAny>, (Bound<'py, PyTuple>, Bound<'py, PyDict>, String));

#[pymethods]
impl Plan {
    #[new]
    #[pyo3(signature = (inputs, out, db, variants, *, parts=None, retry=None, verify=false, roles=None, up=None, floor=None, swap_sides=false, **options))]
    #[allow(clippy::too_many_arguments)] // They are the keywords of the function.
    fn new(
        py: Python<'_>,
        inputs: &Bound<'_, PyAny>,
        out: PathBuf,
        db: &Bound<'_, PyAny>,
        variants: &Bound<'_, PyAny>,
        parts: Option<&Bound<'_, PyDict>>,
        retry: Option<&str>,
        verify: bool,
        roles: Option<&Bound<'_, PyDict>>,
        up: Option<&str>,
        #[pyo3(from_py_with = number)] floor: Option<f32>,
        swap_sides: bool,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let keywords = options.map_or_else(|| Ok(PyDict::new(py)), PyDictMethods::copy)?;
        keywords.set_item("parts", parts)?;
        keywords.set_item("retry", retry)?;
        keywords.set_item("verify", verify)?;
        keywords.set_item("roles", roles)?;
        keywords.set_item("up", up)?;
        keywords.set_item("floor", floor)?;
        keywords.set_item("swap_sides", swap_sides)?;
        let positional = PyTuple::new(py, [inputs, out.clone().into_pyobject(py)?.as_any(), db, variants])?;
        let database = match db.cast::<Database>() {
            Ok(database) => database.clone(),
            Err(_) => Bound::new(py, Database::at(py, db.extract()?)?)?,
        };
        let database = database.get();
        let mut base = StyleSettings::new(StyleWeights::default());
        set_parts(&mut base, parts)?;
        set_options(&mut base, options)?;
        base.reading = reading(py, roles, up, floor, swap_sides)?;
        let request = BatchRequest {
            inputs: paths_of(inputs)?,
            database: PathBuf::from(database.message_name()),
            variants: self::variants(variants, &move |styles| StyleSettings { styles, ..base.clone() })?,
            output: out,
            shard: Shard::WHOLE,
            threads: None,
            retry: retry.map(|text| retry_of(py, text)).transpose()?,
            verify,
        };
        let plan =
            watched(py, None, |_| batch::Plan::new(request, &database.shared.sha256, |search| database.model(search)))?;
        Ok(Self { plan, arguments: (positional.unbind(), keywords.unbind()) })
    }

    /// Returns the pending jobs. From then on no other process may record.
    #[pyo3(signature = (*, progress=None))]
    fn pending<'py>(&self, py: Python<'py>, progress: Option<Py<PyAny>>) -> PyResult<Vec<Bound<'py, PyDict>>> {
        let pending =
            watched(py, progress.as_ref(), |on_progress| with_threads(0, || self.plan.pending(on_progress))?)?;
        pending.iter().map(|job| job_dict(py, job)).collect()
    }

    /// Performs a job of `pending`, in any process and on any thread, and returns a row with its result.
    fn perform<'py>(&self, py: Python<'py>, job: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyDict>> {
        let job = PlannedJob { job: field(job, "job")?, input: field(job, "input")?, variant: field(job, "variant")? };
        let record = watched(py, None, |on_progress| self.plan.perform(&job, on_progress))?;
        record_dict(py, &record)
    }

    /// Writes the results of jobs to the manifest: rows that `perform` returned.
    fn record(&self, py: Python<'_>, rows: &Bound<'_, PyAny>) -> PyResult<()> {
        let records: Vec<Record> = rows.try_iter()?.map(|row| record_of(&row?)).collect::<PyResult<_>>()?;
        watched(py, None, |_| self.plan.record(records))
    }

    /// SHA-256 of everything that the outputs depend on, except the inputs.
    #[getter]
    fn sha256(&self) -> String {
        self.plan.sha256()
    }

    /// The arguments of the constructor, and the SHA-256: a copy that would write other outputs is refused.
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        let py = slf.py();
        let reopen = py.import("strut._pickle")?.getattr("open_plan")?;
        let Self { plan, arguments: (positional, keywords) } = slf.get();
        Ok((reopen, (positional.bind(py).clone(), keywords.bind(py).clone(), plan.sha256())))
    }
}

/// Creates the variants from styles as text, from a dict, or from a table.
fn variants(value: &Bound<'_, PyAny>, settings: &impl Fn(StyleWeights) -> StyleSettings) -> PyResult<Vec<Variant>> {
    let py = value.py();
    let fail = |error: TaskError| exception(py, &error);
    if let Ok(typed) = value.cast::<PyString>() {
        let typed = typed.to_str()?;
        return Ok(vec![Variant::of_styles(typed, settings(styles(value)?)).map_err(fail)?]);
    }
    if let Ok(dict) = value.cast::<PyDict>() {
        let wrong = || PyTypeError::new_err("the name of a variant must be a string");
        let named = dict.iter().map(|(name, of)| {
            let name: String = name.extract().map_err(|_| wrong())?;
            Variant::new(&name, settings(styles(&of)?)).map_err(fail)
        });
        return named.collect();
    }
    let table: PathBuf = value.extract()?;
    let read = |styles| -> Outcome<StyleSettings> { Ok(settings(styles)) };
    read_variants(&table, read).map_err(fail)
}

fn retry_of(py: Python<'_>, text: &str) -> PyResult<Retry> {
    match text {
        "failed" => Ok(Retry::Failed),
        "skipped" => Ok(Retry::Skipped),
        "all" => Ok(Retry::All),
        _ => Err(bad_input(py, format_args!("retry is '{text:.40}'; failed, skipped or all was expected"))),
    }
}

/// Reads a value of a row by its name.
fn field<'py, T: for<'a> FromPyObject<'a, 'py, Error = PyErr>>(row: &Bound<'py, PyAny>, name: &str) -> PyResult<T> {
    let wrong = |error: &PyErr| PyTypeError::new_err(format!("the row's '{name}': {error}"));
    row.get_item(name).and_then(|value| value.extract()).map_err(|error| wrong(&error))
}

fn job_dict<'py>(py: Python<'py>, job: &PlannedJob) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    dict.set_item("job", &job.job)?;
    dict.set_item("input", &job.input)?;
    dict.set_item("variant", &job.variant)?;
    Ok(dict)
}

fn record_dict<'py>(py: Python<'py>, record: &Record) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    dict.set_item("job", &record.job)?;
    dict.set_item("key", &record.key)?;
    dict.set_item("input", &record.input)?;
    dict.set_item("input_sha256", &record.input_sha256)?;
    dict.set_item("variant", &record.variant)?;
    dict.set_item("output", &record.output)?;
    dict.set_item("output_sha256", &record.output_sha256)?;
    dict.set_item("bytes", record.bytes)?;
    dict.set_item("frames", record.frames)?;
    dict.set_item("repaired", record.repaired)?;
    let notes = record.notes.iter().map(|note| [("code", &note.code), ("text", &note.text)].into_py_dict(py));
    dict.set_item("notes", notes.collect::<PyResult<Vec<_>>>()?)?;
    dict.set_item("status", record.status.name())?;
    dict.set_item("code", &record.code)?;
    dict.set_item("message", &record.message)?;
    dict.set_item("version", &record.version)?;
    dict.set_item("time_ms", record.time_ms)?;
    Ok(dict)
}

fn record_of(row: &Bound<'_, PyAny>) -> PyResult<Record> {
    let notes: Vec<Bound<'_, PyAny>> = field(row, "notes")?;
    let note_of = |note: &Bound<'_, PyAny>| Ok(NoteReport { code: field(note, "code")?, text: field(note, "text")? });
    let status: String = field(row, "status")?;
    let unlike =
        || bad_input(row.py(), format_args!("the status is '{status:.40}'; done, skipped or failed was expected"));
    Ok(Record {
        job: field(row, "job")?,
        key: field(row, "key")?,
        input: field(row, "input")?,
        input_sha256: field(row, "input_sha256")?,
        variant: field(row, "variant")?,
        output: field(row, "output")?,
        output_sha256: field(row, "output_sha256")?,
        bytes: field(row, "bytes")?,
        frames: field(row, "frames")?,
        repaired: field(row, "repaired")?,
        notes: notes.iter().map(note_of).collect::<PyResult<_>>()?,
        status: Status::from_name(&status).ok_or_else(unlike)?,
        code: field(row, "code")?,
        message: field(row, "message")?,
        version: field(row, "version")?,
        time_ms: field(row, "time_ms")?,
    })
}
