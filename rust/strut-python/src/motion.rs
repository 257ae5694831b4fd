//! Clips and styled clips.

use crate::arrays::{array_of, column, flags};
use crate::call::watched;
use crate::database::Database;
use crate::error::exception;
use crate::options::settings;
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use strut_core::contact;
use strut_core::humanoid::Role;
use strut_core::transfer;
use strut_formats::bvh;
use strut_formats::corpus::Clip;
use strut_tasks::files::{self, Outputs};
use strut_tasks::stylize::{Spread, Styled, Styling, input_of};
use strut_tasks::threads::with_threads;
use strut_tasks::{Code, OnProgress, Outcome, TaskError};

/// A clip and its name in messages.
pub(crate) struct Named {
    pub(crate) name: String,
    pub(crate) clip: Clip,
    /// The file.
    bytes: Vec<u8>,
}

/// A recorded motion of a humanoid.
#[pyclass(frozen, module = "strut")]
pub(crate) struct Motion {
    pub(crate) named: Arc<Named>,
}

impl Named {
    fn new(name: String, bytes: Vec<u8>) -> Outcome<Self> {
        let clip = Clip::parse(&bytes).map_err(|reason| TaskError::in_file(Path::new(&name), reason))?;
        Ok(Self { name, clip, bytes })
    }
}

#[pymethods]
impl Motion {
    /// Opens a BVH file by its path, or from its bytes.
    #[staticmethod]
    fn open(py: Python<'_>, source: &Bound<'_, PyAny>) -> PyResult<Self> {
        let named = if let Ok(bytes) = source.cast::<PyBytes>() {
            let bytes = bytes.as_bytes().to_owned();
            watched(py, None, |_| Named::new("the motion".into(), bytes))
        } else {
            let path: PathBuf = source.extract()?;
            watched(py, None, |_| Named::new(path.display().to_string(), files::read(&path, bvh::MAX_BYTES)?))
        };
        Ok(Self { named: Arc::new(named?) })
    }

    /// The motion on a database's body and at its rate, as float32 of 87 columns: root x y z in metres, then x y z w of the
    /// rotation of each of the 21 joints relative to its parent.
    fn poses<'py>(&self, py: Python<'py>, db: &Database) -> PyResult<Bound<'py, PyArray2<f32>>> {
        let input = self.input(py, db)?;
        array_of(py, &input.poses)
    }

    /// Whether the left and the right foot is planted in each frame of `poses`, as 0 and 1.
    fn contacts<'py>(&self, py: Python<'py>, db: &Database) -> PyResult<Bound<'py, PyArray2<u8>>> {
        let input = self.input(py, db)?;
        flags(py, contact::label(&input).into_iter())
    }

    /// The path it was opened from, or "the motion".
    #[getter]
    fn name(&self) -> &str {
        &self.named.name
    }

    /// Frames of the file.
    #[getter]
    fn frames(&self) -> usize {
        self.named.clip.file.frames
    }

    /// Frames per second.
    #[getter]
    fn rate_hz(&self) -> f64 {
        1.0 / self.named.clip.motion.frame_time_secs
    }

    /// Length, seconds.
    #[getter]
    fn duration_secs(&self) -> f64 {
        self.named.clip.motion.duration_secs()
    }

    /// The name of the joint that has each role of a humanoid.
    #[getter]
    fn roles<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let roles = PyDict::new(py);
        let Clip { motion, binding, .. } = &self.named.clip;
        for (role, joint) in Role::ALL.into_iter().zip(binding.joint_of_role) {
            if let Some(joint) = joint {
                roles.set_item(role.name(), &motion.skeleton.joints()[joint].name)?;
            }
        }
        Ok(roles)
    }

    fn __repr__(&self) -> String {
        format!("<strut.Motion {}: {} frames, {:.2} s>", self.name(), self.frames(), self.duration_secs())
    }

    /// The file's bytes.
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, (Bound<'py, PyBytes>,))> {
        Ok((slf.get_type().getattr("open")?, (PyBytes::new(slf.py(), &slf.get().named.bytes),)))
    }
}

impl Motion {
    fn input(&self, py: Python<'_>, db: &Database) -> PyResult<strut_core::humanoid::HumanoidMotion> {
        watched(py, None, |_| {
            let fail = |reason| TaskError::in_file(Path::new(&self.named.name), reason);
            input_of(&self.named.clip, db.shared.model.catalogue()).map_err(fail)
        })
    }
}

/// A motion in another style.
#[pyclass(frozen, module = "strut")]
pub(crate) struct StyledMotion {
    motion: transfer::StyledMotion,
    file: bvh::Bvh,
    class_weights: Vec<(String, f64)>,
    rate_hz: f32,
}

impl StyledMotion {
    /// What a styling made of a clip.
    pub(crate) fn new(styled: Styled, styling: &Styling) -> Self {
        let Styled { motion, file, summary } = styled;
        let class_weights = styling.classes().iter().cloned().zip(summary.mean_weights()).collect();
        Self { motion, file, class_weights, rate_hz: styling.catalogue().rate_hz }
    }
}

#[pymethods]
impl StyledMotion {
    /// A pose for each frame of the input, on the database's body, in the layout of `Motion.poses`.
    #[getter]
    fn poses<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f32>>> {
        let poses: Vec<_> = self.motion.frames.iter().map(|frame| frame.pose).collect();
        array_of(py, &poses)
    }

    /// When each pose is due, seconds.
    #[getter]
    fn time_out<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        column(py, self.motion.frames.iter().map(|frame| frame.time_out_secs).collect())
    }

    /// Whether the left and the right foot is held in place in each pose, as 0 and 1.
    #[getter]
    fn planted<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<u8>>> {
        flags(py, self.motion.frames.iter().map(|frame| frame.planted))
    }

    /// What the input was read as: the mean weight of each class, "action/style".
    #[getter]
    fn class_weights<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let weights = PyDict::new(py);
        self.class_weights.iter().try_for_each(|(class, weight)| weights.set_item(class, weight))?;
        Ok(weights)
    }

    /// Length, seconds.
    #[getter]
    fn duration_secs(&self) -> f64 {
        self.motion.duration_secs()
    }

    /// Unusable frames of the input that were replaced.
    #[getter]
    fn repaired(&self) -> u32 {
        self.motion.frames.last().map_or(0, |frame| frame.repaired_total)
    }

    /// The text of a BVH file with the input's skeleton, names, units, channel order and frame rate.
    fn to_bvh(&self) -> String {
        bvh::write(&self.file)
    }

    /// Writes that file.
    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        watched(py, None, |_| {
            let mut outputs = Outputs::default();
            outputs.stage(&path, bvh::write(&self.file).as_bytes())?;
            outputs.commit()
        })
    }

    /// Poses at an even rate, the database's unless given, and for each the fractional frame of the input it comes from.
    #[pyo3(signature = (rate_hz=None))]
    fn to_arrays<'py>(&self, py: Python<'py>, rate_hz: Option<f32>) -> PyResult<Bound<'py, PyAny>> {
        let rate_hz = rate_hz.unwrap_or(self.rate_hz);
        if !(1.0..=1000.0).contains(&rate_hz) {
            let reason = format_args!("the rate is {rate_hz}; 1 to 1000 frames per second were expected");
            return Err(exception(py, &TaskError::of(Code::BadInput, reason)));
        }
        let even = watched(py, None, |_| Ok(self.motion.on_body(&self.motion.proportions, rate_hz)))?;
        let arrays = py.import("strut._arrays")?.getattr("Arrays")?;
        arrays.call1((array_of(py, &even.motion.poses)?, column(py, even.input_frame), rate_hz))
    }

    fn __repr__(&self) -> String {
        format!("<strut.StyledMotion: {} frames, {:.2} s>", self.motion.frames.len(), self.duration_secs())
    }
}

/// Gives a motion another style. `progress(what, done, total)` is called about twenty times a second.
#[pyfunction]
#[pyo3(signature = (motion, db, styles, *, parts=None, threads=0, progress=None, **options))]
#[allow(clippy::too_many_arguments)] // They are the keywords of the function.
pub(crate) fn stylize(
    py: Python<'_>,
    motion: &Motion,
    db: &Database,
    styles: &Bound<'_, PyAny>,
    parts: Option<&Bound<'_, PyDict>>,
    threads: usize,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<StyledMotion> {
    let settings = settings(styles, parts, options)?;
    let name = db.message_name();
    watched(py, progress.as_ref(), |on_progress: &OnProgress<'_>| {
        let styling = Styling::new(settings.stylizer(&db.shared.model, Path::new(&name))?);
        let Named { name, clip, .. } = &*motion.named;
        let styled = with_threads(threads, || styling.style(name, clip, None, Spread::Frames, on_progress))??;
        Ok(StyledMotion::new(styled, &styling))
    })
}
