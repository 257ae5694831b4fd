//! Databases.

use crate::arrays::rows;
use crate::call::watched;
use crate::clip::{Motion, reading};
use crate::corpus::{paths_of, pattern_of, reasons};
use crate::error::exception;
use crate::options::number;
use numpy::PyArray2;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use std::borrow::Cow;
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, LazyLock, Mutex, PoisonError, Weak};
use strut_core::database::build::{BuildError, BuildOptions, add_style_of, build};
use strut_core::math::Vec3;
use strut_core::registration;
use strut_core::search::Index;
use strut_core::transfer::Model;
use strut_formats::corpus::{Entry, Labels};
use strut_formats::{GENERATOR, strutdb};
use strut_tasks::clip::Opened;
use strut_tasks::corpus::{RefusedFile, label, read_clips};
use strut_tasks::digest::sha256_hex;
use strut_tasks::files::{self, Outputs};
use strut_tasks::gather::gather;
use strut_tasks::search::Search;
use strut_tasks::suggestion::unknown;
use strut_tasks::threads::{ThreadPool, with_threads};
use strut_tasks::{Code, Outcome, TaskError};

/// Open databases of this process by SHA-256: a database that is opened again or unpickled is shared.
static OPEN: LazyLock<Mutex<HashMap<String, Weak<Shared>>>> = LazyLock::new(Mutex::default);

/// Origin of a database's bytes.
enum Origin {
    Path(PathBuf),
    Bytes(Vec<u8>),
}

/// Function that pickle calls, with its arguments.
type Reduced<'py> = (Bound<'py, PyAny>, (Bound<'py, PyAny>, String));

/// State that all databases with the same bytes share.
pub(crate) struct Shared {
    pub(crate) model: Arc<Model>,
    pub(crate) sha256: String,
    /// The model with a search other than the exact one, for the last requested search.
    other: Mutex<Option<(Search, Arc<Model>)>>,
}

impl Origin {
    /// Returns the path, or its replacement in messages.
    fn name(&self) -> String {
        match self {
            Self::Path(path) => path.display().to_string(),
            Self::Bytes(_) => "the database".to_owned(),
        }
    }

    /// Returns the bytes of the file.
    fn bytes(&self) -> Outcome<Cow<'_, [u8]>> {
        match self {
            Self::Path(path) => Ok(Cow::Owned(files::read(path, strutdb::KIND.max_bytes)?)),
            Self::Bytes(bytes) => Ok(Cow::Borrowed(bytes)),
        }
    }
}

impl Shared {
    /// Reads a database, or returns it if it is open.
    fn open(origin: &Origin) -> Outcome<Arc<Self>> {
        let bytes = origin.bytes()?;
        let sha256 = sha256_hex(&bytes);
        let known = || OPEN.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(shared) = known().get(&sha256).and_then(Weak::upgrade) {
            return Ok(shared);
        }
        let contents =
            strutdb::read(&*bytes).map_err(|reason| TaskError::in_file(Path::new(&origin.name()), reason))?;
        drop(bytes);
        let model = Arc::new(Opened::new(contents, Search::Exact).model);
        let shared = Arc::new(Self { model, sha256: sha256.clone(), other: Mutex::default() });
        let mut known = known();
        known.retain(|_, database| database.strong_count() > 0);
        known.insert(sha256, Arc::downgrade(&shared));
        Ok(shared)
    }
}

/// A database of motions in several styles.
#[pyclass(frozen, module = "strut")]
pub(crate) struct Database {
    pub(crate) shared: Arc<Shared>,
    origin: Origin,
    refused: Vec<RefusedFile>,
}

impl Database {
    fn opened(origin: Origin, refused: Vec<RefusedFile>) -> Outcome<Self> {
        Ok(Self { shared: Shared::open(&origin)?, origin, refused })
    }

    /// Opens the database in the file at a path.
    pub(crate) fn at(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        watched(py, None, |_| Self::opened(Origin::Path(path), Vec::new()))
    }

    /// Returns the model with this search.
    pub(crate) fn model(&self, search: Search) -> Outcome<Arc<Model>> {
        if search == Search::Exact {
            return Ok(Arc::clone(&self.shared.model));
        }
        let mut other = self.shared.other.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, model)) = other.as_ref().filter(|(known, _)| *known == search) {
            return Ok(Arc::clone(model));
        }
        let contents = strutdb::read(&*self.bytes()?)
            .map_err(|reason| TaskError::in_file(Path::new(&self.origin.name()), reason))?;
        let model = Arc::new(Opened::new(contents, search).model);
        *other = Some((search, Arc::clone(&model)));
        Ok(model)
    }

    /// Returns the name in messages.
    pub(crate) fn message_name(&self) -> String {
        self.origin.name()
    }

    /// Returns the bytes of its file, if the file is unchanged.
    fn bytes(&self) -> Outcome<Cow<'_, [u8]>> {
        let bytes = self.origin.bytes()?;
        if matches!(self.origin, Origin::Bytes(_)) || sha256_hex(&bytes) == self.shared.sha256 {
            return Ok(bytes);
        }
        let reason = "the file has changed since it was opened";
        Err(TaskError::in_file(Path::new(&self.origin.name()), reason))
    }
}

#[pymethods]
impl Database {
    /// Opens a file by its path, or from its bytes. If the file does not have the given `sha256`, it
    /// is refused.
    #[staticmethod]
    #[pyo3(signature = (source, *, sha256=None))]
    fn open(py: Python<'_>, source: &Bound<'_, PyAny>, sha256: Option<&str>) -> PyResult<Self> {
        let origin = match source.cast::<PyBytes>() {
            Ok(bytes) => Origin::Bytes(bytes.as_bytes().to_owned()),
            Err(_) => Origin::Path(source.extract()?),
        };
        let database = watched(py, None, |_| Self::opened(origin, Vec::new()))?;
        let found = &database.shared.sha256;
        if let Some(expected) = sha256.filter(|expected| expected != found) {
            let name = database.origin.name();
            let reason = format_args!("{name}: its SHA-256 is {found}; {expected:.64} was expected");
            return Err(exception(py, &TaskError::of(Code::BadFile, reason)));
        }
        Ok(database)
    }

    /// Returns the built-in database.
    #[staticmethod]
    fn demo(py: Python<'_>) -> PyResult<Self> {
        watched(py, None, |_| {
            let database = strut_demo::full_database().map_err(TaskError::new)?;
            let bytes = strutdb::write(&database, &Index::build(&database).plan(), GENERATOR);
            Self::opened(Origin::Bytes(bytes), Vec::new())
        })
    }

    /// Builds a database from BVH files, folders and archives, as `strut build-db` does.
    #[staticmethod]
    #[pyo3(signature = (clips, *, pattern=None, labels=None, neutral=None, rate_hz=60.0, roles=None, up=None, floor=None, swap_sides=false, threads=0, progress=None))]
    #[allow(clippy::too_many_arguments)] // They are the keywords of the function.
    fn build(
        py: Python<'_>,
        clips: &Bound<'_, PyAny>,
        pattern: Option<&str>,
        labels: Option<PathBuf>,
        neutral: Option<String>,
        #[pyo3(from_py_with = number)] rate_hz: f32,
        roles: Option<&Bound<'_, PyDict>>,
        up: Option<&str>,
        #[pyo3(from_py_with = number)] floor: Option<f32>,
        swap_sides: bool,
        #[pyo3(from_py_with = number)] threads: usize,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Self> {
        let reading = reading(py, roles, up, floor, swap_sides)?;
        let (inputs, pattern) = (paths_of(clips)?, pattern_of(py, pattern)?);
        let built = |on_progress: &strut_tasks::OnProgress<'_>| {
            let mut refused = Vec::new();
            let sources = gather(&inputs)?;
            let labelled = label(&sources, pattern.as_ref(), labels.as_deref(), &mut refused)?;
            let clips = read_clips(neutral.as_deref(), &reading, labelled, &mut refused, on_progress)?.clips;
            let options = BuildOptions { rate_hz, neutral: neutral.clone(), ..BuildOptions::default() };
            let mut tell = |p: strut_core::database::build::Progress| {
                let (what, done, total) = (p.stage.name(), p.done, p.total);
                on_progress(strut_tasks::Progress { what, done, total })
            };
            let (database, report) = build(&clips, &options, &ThreadPool, &mut tell).map_err(|error| match error {
                BuildError::Cancelled => TaskError::cancelled(),
                error => TaskError::new(error),
            })?;
            let files: HashMap<&str, &str> = clips.iter().map(|c| (c.name.as_str(), c.source.as_str())).collect();
            for clip in report.refused() {
                let file = files.get(clip.name.as_str()).map_or_else(|| clip.name.clone(), |f| (*f).to_owned());
                let reason = clip.refused.as_ref().map(ToString::to_string).unwrap_or_default();
                refused.push(RefusedFile { file, reason });
            }
            let bytes = strutdb::write(&database, &Index::build(&database).plan(), GENERATOR);
            Self::opened(Origin::Bytes(bytes), refused)
        };
        let task = |on_progress: &strut_tasks::OnProgress<'_>| with_threads(threads, || built(on_progress))?;
        watched(py, progress.as_ref(), task)
    }

    /// Returns this database with a motion added as a style, as `strut add-style` does. The style's action is the given
    /// one, or the most similar action of the database.
    #[pyo3(signature = (motion, name, *, action=None, threads=0))]
    fn add_style(
        &self,
        py: Python<'_>,
        motion: &Motion,
        name: String,
        action: Option<&str>,
        #[pyo3(from_py_with = number)] threads: usize,
    ) -> PyResult<Self> {
        watched(py, None, |_| {
            let of = |reason| TaskError::in_file(Path::new(&self.origin.name()), reason);
            let db = strutdb::read(&*self.bytes()?).map_err(|reason| of(reason.to_string()))?.database;
            let index = |action: &str| {
                let known = db.actions.iter().position(|known| known == action);
                known.map(|index| index as u16).ok_or_else(|| TaskError::new(unknown("action", action, &db.actions)))
            };
            let action = action.map(index).transpose()?;
            let labels = Labels { action: String::new(), style: name, take: Some(1) };
            let entry = Entry { path: motion.named.name.clone(), labels, licence: String::new() };
            let clip = entry.source_clip(&motion.named.clip, &db.proportions);
            let options = registration::Options::default();
            let added = with_threads(threads, || add_style_of(&db, &clip, action, &options, &ThreadPool))?;
            let added = added.map_err(|reason| TaskError::in_file(Path::new(&motion.named.name), reason))?.database;
            let bytes = strutdb::write(&added, &Index::build(&added).plan(), GENERATOR);
            Self::opened(Origin::Bytes(bytes), Vec::new())
        })
    }

    /// Returns a copy of a tensor of the file, which is in the safetensors format, by its name.
    fn tensor<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        py.import("strut._tensors")?.getattr("tensor")?.call1((self.to_bytes(py)?, name))
    }

    /// The body: for each of the 21 joints its offset in its parent's frame in the T-pose, metres; for the hips their
    /// height.
    #[getter]
    fn proportions<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f32>>> {
        let offsets = self.shared.model.catalogue().proportions.offsets;
        rows(py, offsets.iter().flat_map(Vec3::to_array).collect(), 3)
    }

    /// Writes the file.
    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        watched(py, None, |_| {
            let mut outputs = Outputs::default();
            outputs.stage(&path, &self.bytes()?)?;
            outputs.commit()
        })
    }

    /// The bytes of the file.
    fn to_bytes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let bytes = watched(py, None, |_| self.bytes())?;
        Ok(PyBytes::new(py, &bytes))
    }

    /// The path of its file, or "the database".
    #[getter]
    fn name(&self) -> String {
        self.origin.name()
    }

    /// Number of frames of all clips.
    #[getter]
    fn frames(&self) -> usize {
        self.shared.model.catalogue().frames()
    }

    /// Frames per second.
    #[getter]
    fn rate_hz(&self) -> f32 {
        self.shared.model.catalogue().rate_hz
    }

    /// Names of the actions.
    #[getter]
    fn actions(&self) -> Vec<String> {
        self.shared.model.catalogue().actions.clone()
    }

    /// Names of the styles.
    #[getter]
    fn styles(&self) -> Vec<String> {
        self.shared.model.catalogue().styles.clone()
    }

    /// Name of the neutral style.
    #[getter]
    fn neutral(&self) -> String {
        let catalogue = self.shared.model.catalogue();
        catalogue.styles[usize::from(catalogue.neutral)].clone()
    }

    /// Names of the clips.
    #[getter]
    fn clips(&self) -> Vec<String> {
        self.shared.model.catalogue().clips.iter().map(|clip| clip.name.clone()).collect()
    }

    /// The classes, "action/style".
    #[getter]
    fn classes(&self) -> Vec<String> {
        strut_tasks::stylize::class_names(self.shared.model.catalogue())
    }

    /// The reasons why files were not used, by path.
    #[getter]
    fn refused<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        reasons(py, &self.refused)
    }

    /// SHA-256 of the file.
    #[getter]
    fn sha256(&self) -> String {
        self.shared.sha256.clone()
    }

    fn __repr__(&self) -> String {
        format!("<strut.Database {}: {} frames, styles {}>", self.name(), self.frames(), self.styles().join(", "))
    }

    /// The path and the SHA-256 if it was opened by a path, otherwise the bytes.
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        let py = slf.py();
        let reopen = py.import("strut._pickle")?.getattr("open_database")?;
        let Self { shared, origin, .. } = slf.get();
        let source = match origin {
            Origin::Path(path) => path.into_pyobject(py)?.into_any(),
            Origin::Bytes(bytes) => PyBytes::new(py, bytes).into_any(),
        };
        Ok((reopen, (source, shared.sha256.clone())))
    }
}
