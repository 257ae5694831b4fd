//! Key-style models: poses as a function of a few style variables.

use crate::arrays::column;
use crate::call::watched;
use crate::corpus::paths_of;
use crate::error::bad_input;
use crate::model_file::ModelFile;
use crate::options::number;
use crate::styled::StyledMotion;
use numpy::PyArray1;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use std::path::PathBuf;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use strut_core::contact;
use strut_core::humanoid::POSE_FLOATS;
use strut_core::somn::{
    self, EM_RIDGE, Interpolation, Key, KeyStyling, Learning, MAX_AXES, MAX_COMPONENTS, Method, Mode, Options, Style,
    Synthesis,
};
use strut_formats::{GENERATOR, key_style_model, shown_number};
use strut_tasks::TaskError;
use strut_tasks::key_styles::{parse_axes, train_key_styles};
use strut_tasks::recordings::read_recordings;
use strut_tasks::threads::with_threads;

/// A model of poses as a function of one to three style variables.
#[pyclass(frozen, module = "strut")]
pub(crate) struct KeyStyleModel {
    model: Arc<somn::KeyStyleModel>,
    /// Prepared once, since it has a search tree over the recorded styles.
    synthesis: Mutex<Synthesis>,
    file: ModelFile,
}

impl KeyStyleModel {
    fn new(model: somn::KeyStyleModel, file: ModelFile) -> Self {
        let model = Arc::new(model);
        Self { synthesis: Mutex::new(Synthesis::new(Arc::clone(&model))), model, file }
    }

    /// Waits for the synthesis. It is whole after a panic, too: every call sets what it reads.
    fn synthesis(&self) -> MutexGuard<'_, Synthesis> {
        self.synthesis.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Reads a style from numbers, one per axis.
    fn style(&self, py: Python<'_>, numbers: &[f64]) -> PyResult<Style> {
        let axes = self.model.axis_count();
        if numbers.len() != axes || numbers.iter().any(|number| !number.is_finite()) {
            let shown: Vec<String> = numbers.iter().take(MAX_AXES + 1).map(|number| shown_number(*number)).collect();
            let more = if numbers.len() > shown.len() { ", …" } else { "" };
            let expected = format_args!("{axes} finite numbers were expected, one per axis");
            return Err(bad_input(py, format_args!("the style is [{}{more}]; {expected}", shown.join(", "))));
        }
        let mut style = [0.0; MAX_AXES];
        style.iter_mut().zip(numbers).for_each(|(value, number)| *value = *number);
        Ok(style)
    }
}

#[pymethods]
impl KeyStyleModel {
    /// Opens a file by its path, or from its bytes.
    #[staticmethod]
    fn open(source: &Bound<'_, PyAny>) -> PyResult<Self> {
        let (model, file) = ModelFile::open(source, key_style_model::KIND, key_style_model::read)?;
        Ok(Self::new(model, file))
    }

    /// Trains a model on BVH files, folders and archives, as `strut train-key-style` does. `axes` are one to three
    /// measures, as in that command: a text with commas, or a list.
    #[staticmethod]
    #[pyo3(signature = (source, axes, *, seed=0, components=None, method="som", threads=0, progress=None))]
    #[allow(clippy::too_many_arguments)] // They are the keywords of the function.
    fn train(
        py: Python<'_>,
        source: &Bound<'_, PyAny>,
        axes: &Bound<'_, PyAny>,
        #[pyo3(from_py_with = number)] seed: u64,
        #[pyo3(from_py_with = number)] components: Option<usize>,
        method: &str,
        #[pyo3(from_py_with = number)] threads: usize,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Self> {
        let inputs = paths_of(source)?;
        let axes = axes.extract::<String>().or_else(|_| Ok::<_, PyErr>(axes.extract::<Vec<String>>()?.join(",")))?;
        if let Some(components) = components.filter(|components| !(1..=MAX_COMPONENTS).contains(components)) {
            let expected = format_args!("1 to {MAX_COMPONENTS} were expected");
            return Err(bad_input(py, format_args!("there are {components} components; {expected}")));
        }
        let learning = match method {
            "som" => Learning::Som,
            "em" => Learning::Em { ridge: EM_RIDGE },
            _ => return Err(bad_input(py, format_args!("the method is '{method:.40}'; som or em was expected"))),
        };
        watched(py, progress.as_ref(), |on_progress| {
            with_threads(threads, || {
                let axes = parse_axes(&axes)?;
                let mut refused = Vec::new();
                let recordings = read_recordings(&inputs, &mut refused, on_progress)?;
                let options = Options { components, seed, learning };
                let model = train_key_styles(&recordings, &axes, options, on_progress)?;
                let bytes = key_style_model::write(&model, GENERATOR);
                Ok(Self::new(model, ModelFile::new(bytes, refused)))
            })?
        })
    }

    /// Writes the file.
    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        self.file.save(py, &path)
    }

    /// The bytes of the file.
    fn to_bytes<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        self.file.to_bytes(py)
    }

    /// The style variables.
    #[getter]
    fn axes(&self) -> Vec<String> {
        self.model.axes.iter().map(ToString::to_string).collect()
    }

    /// The reasons why files were not used, by path.
    #[getter]
    fn refused<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.file.refused(py)
    }

    /// Returns the pose of a style, given as one number per axis in its unit. It has 87 numbers in the layout of
    /// `Motion.poses`.
    fn pose<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = number)] style: Vec<f64>,
    ) -> PyResult<Bound<'py, PyArray1<f32>>> {
        let style = self.style(py, &style)?;
        let mut floats = [0.0; POSE_FLOATS];
        py.detach(|| self.synthesis().pose(&style, Mode::default()).write_to(&mut floats));
        Ok(column(py, floats.to_vec()))
    }

    /// Makes a motion through keys, as `strut key-style` does. Keys are pairs of a time in seconds and a style, one
    /// number per axis.
    #[pyo3(signature = (keys, *, interpolation="catmull-rom", mode="smooth"))]
    fn motion(
        &self,
        py: Python<'_>,
        keys: &Bound<'_, PyAny>,
        interpolation: &str,
        mode: &str,
    ) -> PyResult<StyledMotion> {
        let interpolation = match interpolation {
            "catmull-rom" => Interpolation::CatmullRom,
            "monotone" => Interpolation::Monotone,
            other => {
                let expected = "catmull-rom or monotone was expected";
                return Err(bad_input(py, format_args!("the interpolation is '{other:.40}'; {expected}")));
            }
        };
        let mode = match mode {
            "smooth" => Mode::KEYED,
            "hard" => Mode::Hard,
            other => return Err(bad_input(py, format_args!("the mode is '{other:.40}'; smooth or hard was expected"))),
        };
        let wrong = || PyTypeError::new_err("keys must be pairs of a time in seconds and a sequence of numbers");
        let key = |pair: PyResult<Bound<'_, PyAny>>| {
            let (secs, numbers): (f64, Vec<f64>) = pair?.extract().map_err(|_| wrong())?;
            Ok(Key { secs, style: self.style(py, &numbers)?, row: None })
        };
        let keys = keys.try_iter()?.map(key).collect::<PyResult<Vec<Key>>>()?;
        watched(py, None, |_| {
            let mut synthesis = self.synthesis();
            let styling = KeyStyling::new(&keys, interpolation, &mut synthesis, mode).map_err(TaskError::new)?;
            let motion = styling.motion(&mut synthesis, Method::KeyStyle);
            let planted = contact::label(&motion);
            StyledMotion::made(motion, planted)
        })
    }

    fn __repr__(&self) -> String {
        format!("<strut.KeyStyleModel: axes {}>", self.axes().join(", "))
    }

    /// The bytes of the file.
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, (Bound<'py, PyBytes>,))> {
        Ok((slf.get_type().getattr("open")?, (slf.get().to_bytes(slf.py()),)))
    }
}
