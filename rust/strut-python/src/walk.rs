//! Synthesis of walks with a walk model.

use crate::arrays::{array_of, column, flags};
use crate::call::watched;
use crate::corpus::{paths_of, pattern_of};
use crate::error::{bad_input, exception};
use crate::model_file::ModelFile;
use crate::options::{number, styles};
use crate::styled::StyledMotion;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use std::path::PathBuf;
use std::sync::Arc;
use strut_core::hsmm::{self, RATE_HZ, RuntimeWalkModel};
use strut_core::math::Vec3;
use strut_formats::{GENERATOR, walk_model};
use strut_tasks::threads::with_threads;
use strut_tasks::walk::{Gait, Transition, WalkOrder};
use strut_tasks::walks::train_walks;
use strut_tasks::weights::StyleWeights;

/// Greatest number of frames of one call of a walker: ten minutes.
const MAX_FRAMES: usize = 30 * 600;

/// A walk model.
#[pyclass(frozen, module = "strut")]
pub(crate) struct WalkModel {
    model: hsmm::WalkModel,
    runtime: Arc<RuntimeWalkModel>,
    file: ModelFile,
}

impl WalkModel {
    fn new(model: hsmm::WalkModel, file: ModelFile) -> Self {
        let runtime = Arc::new(RuntimeWalkModel::new(&model));
        Self { model, runtime, file }
    }
}

#[pymethods]
impl WalkModel {
    /// Opens a file by its path, or from its bytes.
    #[staticmethod]
    fn open(source: &Bound<'_, PyAny>) -> PyResult<Self> {
        let (model, file) = ModelFile::open(source, walk_model::KIND, walk_model::read)?;
        Ok(Self::new(model, file))
    }

    /// Trains a model on labelled walks: BVH files, folders and archives, as `strut train-walk` does.
    #[staticmethod]
    #[pyo3(signature = (clips, *, pattern=None, labels=None, threads=0, progress=None))]
    fn train(
        py: Python<'_>,
        clips: &Bound<'_, PyAny>,
        pattern: Option<&str>,
        labels: Option<PathBuf>,
        #[pyo3(from_py_with = number)] threads: usize,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Self> {
        let (inputs, pattern) = (paths_of(clips)?, pattern_of(py, pattern)?);
        watched(py, progress.as_ref(), |on_progress| {
            with_threads(threads, || {
                let mut refused = Vec::new();
                let trained = train_walks(&inputs, pattern.as_ref(), labels.as_deref(), &mut refused, on_progress);
                let model = trained?.0;
                let bytes = walk_model::write(&model, GENERATOR);
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

    /// Names of the styles.
    #[getter]
    fn styles(&self) -> Vec<String> {
        self.model.styles.clone()
    }

    /// The reasons why files were not used, by path.
    #[getter]
    fn refused<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.file.refused(py)
    }

    /// Synthesises a walk in a style or a mixture, as `strut walk` does. A transition is a triple: the styles after it,
    /// the step at which it begins, and the number of steps that it takes.
    #[pyo3(signature = (styles, *, steps=12, transitions=None, cadence=None, stride=1.0, stop=false, turn=0.0, limits=true, progress=None))]
    #[allow(clippy::too_many_arguments)] // They are the keywords of the function.
    fn walk(
        &self,
        py: Python<'_>,
        #[pyo3(from_py_with = styles)] styles: StyleWeights,
        #[pyo3(from_py_with = number)] steps: u64,
        transitions: Option<&Bound<'_, PyAny>>,
        #[pyo3(from_py_with = number)] cadence: Option<f32>,
        #[pyo3(from_py_with = number)] stride: f32,
        stop: bool,
        #[pyo3(from_py_with = number)] turn: f32,
        limits: bool,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<StyledMotion> {
        let transitions = transitions.map(transitions_of).transpose()?.unwrap_or_default();
        let order = WalkOrder { styles, steps, transitions, gait: Gait { cadence, stride, turn, limits }, stop };
        watched(py, progress.as_ref(), |on_progress| {
            let walked = order.walk(&self.model, Arc::clone(&self.runtime), on_progress)?;
            StyledMotion::made(walked.motion, walked.planted)
        })
    }

    /// Returns a walker in the average of all styles, from the origin along +Z.
    fn walker(&self) -> Walker {
        Walker { engine: hsmm::Walker::new(Arc::clone(&self.runtime)), styles: self.model.styles.clone(), frames: 0 }
    }

    fn __repr__(&self) -> String {
        format!("<strut.WalkModel: styles {}>", self.model.styles.join(", "))
    }

    /// The bytes of the file.
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, (Bound<'py, PyBytes>,))> {
        Ok((slf.get_type().getattr("open")?, (slf.get().to_bytes(slf.py()),)))
    }
}

fn transitions_of(value: &Bound<'_, PyAny>) -> PyResult<Vec<Transition>> {
    let wrong = || PyTypeError::new_err("transitions must be triples of styles, a step and a number of steps");
    let of = |triple: PyResult<Bound<'_, PyAny>>| {
        let (of, step, between): (Bound<'_, PyAny>, u64, u32) = triple?.extract().map_err(|_| wrong())?;
        Ok(Transition { styles: styles(&of)?, step, between })
    };
    value.try_iter()?.map(of).collect()
}

/// An endless walk, frame by frame at 30 frames per second.
#[pyclass(module = "strut")]
pub(crate) struct Walker {
    engine: hsmm::Walker,
    styles: Vec<String>,
    /// Number of frames since the last start.
    frames: usize,
}

#[pymethods]
impl Walker {
    /// Sets the styles from the next frame on. If the sum of the weights is below 1, the rest is the average
    /// of all styles.
    fn set_styles(&mut self, py: Python<'_>, #[pyo3(from_py_with = styles)] styles: StyleWeights) -> PyResult<()> {
        let weights = styles.of_walks(&self.styles).map_err(|reason| bad_input(py, reason))?;
        self.engine.set_styles(&weights).map_err(|reason| bad_input(py, reason))
    }

    /// Sets the gait from the next frame on. `cadence` is in steps per minute, None for the style's own. `stride` is
    /// the step length relative to the style's, `turn` the turn per step, degrees to the left. `limits` keeps joints
    /// within the range of the recorded walks. `walking` sets whether it walks or stands.
    #[pyo3(signature = (*, cadence=None, stride=1.0, turn=0.0, limits=true, walking=true))]
    fn configure(
        &mut self,
        py: Python<'_>,
        #[pyo3(from_py_with = number)] cadence: Option<f32>,
        #[pyo3(from_py_with = number)] stride: f32,
        #[pyo3(from_py_with = number)] turn: f32,
        limits: bool,
        walking: bool,
    ) -> PyResult<()> {
        let gait = Gait { cadence, stride, turn, limits };
        gait.set(&mut self.engine).map_err(|error| exception(py, &error))?;
        self.engine.set_walking(walking);
        Ok(())
    }

    /// Returns the next frames.
    #[pyo3(signature = (frames=1))]
    fn advance<'py>(
        &mut self,
        py: Python<'py>,
        #[pyo3(from_py_with = number)] frames: usize,
    ) -> PyResult<Bound<'py, PyAny>> {
        if frames > MAX_FRAMES {
            return Err(bad_input(py, format_args!("{frames} frames; at most {MAX_FRAMES} were expected")));
        }
        let walker = &mut self.engine;
        let (poses, planted): (Vec<_>, Vec<_>) =
            py.detach(|| (0..frames).map(|_| (*walker.advance(), walker.planted())).unzip());
        let times = (self.frames..).take(frames).map(|frame| frame as f64 / f64::from(RATE_HZ)).collect();
        self.frames += frames;
        let styled = py.import("strut._arrays")?.getattr("Styled")?;
        styled.call1((array_of(py, &poses)?, column::<f64>(py, times), flags(py, planted.into_iter())?))
    }

    /// Index of the step that contains the last frame.
    #[getter]
    fn step(&self) -> u64 {
        self.engine.step().0
    }

    /// Restarts at the origin along +Z; styles and gait are kept.
    fn reset(&mut self) {
        self.engine.reset(Vec3::ZERO, 0.0);
        self.frames = 0;
    }
}
