//! Styled clips, and motions of models.

use crate::arrays::{array_of, column, flags};
use crate::call::watched;
use crate::clip::{Motion, Named, notes};
use crate::database::Database;
use crate::error::exception;
use crate::options::{number, settings, styles};
use numpy::{PyArray1, PyArray2};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyList};
use std::io::{self, Cursor};
use std::path::{Path, PathBuf};
use strut_core::humanoid::HumanoidMotion;
use strut_core::note::Note;
use strut_core::transfer;
use strut_formats::bvh::{self, Bvh};
use strut_tasks::files::Outputs;
use strut_tasks::stylize::{Spread, StyleKey, StyleTrack, Styled, Styling, TraceLog};
use strut_tasks::threads::with_threads;
use strut_tasks::{Code, OnProgress, Outcome, TaskError};

/// The frames of a motion.
enum Frames {
    /// At the output times of a style.
    Styled(transfer::StyledMotion),
    /// At a constant rate, with foot contacts.
    Even(HumanoidMotion, Vec<[bool; 2]>),
}

/// A motion in another style, or one that a model synthesised.
#[pyclass(frozen, module = "strut")]
pub(crate) struct StyledMotion {
    frames: Frames,
    file: Bvh,
    class_weights: Vec<(String, f64)>,
    notes: Vec<Note>,
    rate_hz: f32,
    /// JSON lines.
    trace: Option<Vec<u8>>,
}

impl StyledMotion {
    /// Creates the result of styling a clip.
    pub(crate) fn new(styled: Styled, styling: &Styling, trace: Option<Vec<u8>>) -> Self {
        let Styled { motion, file, summary, notes } = styled;
        let class_weights = styling.classes().iter().cloned().zip(summary.mean_weights()).collect();
        let rate_hz = styling.catalogue().rate_hz;
        Self { frames: Frames::Styled(motion), file, class_weights, notes, rate_hz, trace }
    }

    /// Creates the result of a model.
    ///
    /// # Errors
    /// None in practice.
    pub(crate) fn made(motion: HumanoidMotion, planted: Vec<[bool; 2]>) -> Outcome<Self> {
        let file = Bvh::from_humanoid(&motion).map_err(TaskError::new)?;
        let rate_hz = motion.rate_hz;
        let frames = Frames::Even(motion, planted);
        Ok(Self { frames, file, class_weights: Vec::new(), notes: Vec::new(), rate_hz, trace: None })
    }

    fn len(&self) -> usize {
        match &self.frames {
            Frames::Styled(motion) => motion.frames.len(),
            Frames::Even(motion, _) => motion.poses.len(),
        }
    }
}

#[pymethods]
impl StyledMotion {
    /// A pose for each frame of the input, on the database's body, in the layout of `Motion.poses`.
    #[getter]
    fn poses<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f32>>> {
        match &self.frames {
            Frames::Styled(motion) => array_of(py, &motion.frames.iter().map(|frame| frame.pose).collect::<Vec<_>>()),
            Frames::Even(motion, _) => array_of(py, &motion.poses),
        }
    }

    /// Output time of each pose, seconds.
    #[getter]
    fn time_out<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let times = match &self.frames {
            Frames::Styled(motion) => motion.frames.iter().map(|frame| frame.time_out_secs).collect(),
            Frames::Even(motion, _) => {
                (0..motion.poses.len()).map(|frame| frame as f64 / f64::from(motion.rate_hz)).collect()
            }
        };
        column(py, times)
    }

    /// Whether the left and the right foot is held in place in each pose, as 0 and 1.
    #[getter]
    fn planted<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<u8>>> {
        match &self.frames {
            Frames::Styled(motion) => flags(py, motion.frames.iter().map(|frame| frame.planted)),
            Frames::Even(_, planted) => flags(py, planted.iter().copied()),
        }
    }

    /// Recognised classes of the input: the mean weight of each class, "action/style"; empty without an input.
    #[getter]
    fn class_weights<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let weights = PyDict::new(py);
        self.class_weights.iter().try_for_each(|(class, weight)| weights.set_item(class, weight))?;
        Ok(weights)
    }

    /// Warnings, as dicts of a code and a text; empty for a clean clip.
    #[getter]
    fn notes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        notes(py, &self.notes)
    }

    /// Length, seconds.
    #[getter]
    fn duration_secs(&self) -> f64 {
        match &self.frames {
            Frames::Styled(motion) => motion.duration_secs(),
            Frames::Even(motion, _) => motion.poses.len() as f64 / f64::from(motion.rate_hz),
        }
    }

    /// Number of unusable input frames that were replaced.
    #[getter]
    fn repaired(&self) -> u32 {
        match &self.frames {
            Frames::Styled(motion) => motion.frames.last().map_or(0, |frame| frame.repaired_total),
            Frames::Even(..) => 0,
        }
    }

    /// How each frame was computed, as in `strut stylize --trace`; None unless requested.
    #[getter]
    fn trace<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyList>>> {
        let Some(lines) = &self.trace else { return Ok(None) };
        let loads = py.import("json")?.getattr("loads")?;
        let lines = lines.split(|byte| *byte == b'\n').filter(|line| !line.is_empty());
        let parsed = lines.map(|line| loads.call1((PyBytes::new(py, line),))).collect::<PyResult<Vec<_>>>()?;
        PyList::new(py, parsed).map(Some)
    }

    /// Returns the text of a BVH file with the input's skeleton, names, units, channel order and frame rate.
    fn to_bvh(&self) -> String {
        bvh::write_text(&self.file)
    }

    /// Writes the BVH file.
    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        watched(py, None, |_| {
            let mut outputs = Outputs::default();
            outputs.stage(&path, &bvh::write(&self.file))?;
            outputs.commit()
        })
    }

    /// Returns poses at a constant rate, by default the database's, and for each pose the fractional frame of the
    /// input.
    #[pyo3(signature = (rate_hz=None))]
    fn to_arrays<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = number)] rate_hz: Option<f32>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let rate_hz = rate_hz.unwrap_or(self.rate_hz);
        if !(1.0..=1000.0).contains(&rate_hz) {
            let reason = format_args!("the rate is {rate_hz}; 1 to 1000 frames per second were expected");
            return Err(exception(py, &TaskError::of(Code::BadInput, reason)));
        }
        let (motion, input_frame) = watched(py, None, |_| match &self.frames {
            Frames::Styled(motion) => {
                let even = motion.on_body(&motion.proportions, rate_hz);
                Ok((even.motion, even.input_frame))
            }
            Frames::Even(motion, _) => {
                let even = motion.resampled(rate_hz).map_err(TaskError::new)?;
                let share = f64::from(motion.rate_hz) / f64::from(rate_hz);
                let input_frame = (0..even.poses.len()).map(|frame| frame as f64 * share).collect();
                Ok((even, input_frame))
            }
        })?;
        let arrays = py.import("strut._arrays")?.getattr("Arrays")?;
        arrays.call1((array_of(py, &motion.poses)?, column(py, input_frame), rate_hz))
    }

    fn __repr__(&self) -> String {
        format!("<strut.StyledMotion: {} frames, {:.2} s>", self.len(), self.duration_secs())
    }
}

/// Changes the style of a motion. `progress(what, done, total)` is called about twenty times a second.
///
/// A `track` is a list of pairs: a time in the input, seconds, and styles. The styles change from `styles` at the start
/// through those of the track. With `trace`, the result contains how each frame was computed.
#[pyfunction]
#[pyo3(signature = (motion, db, styles, *, parts=None, track=None, trace=false, threads=0, progress=None, **options))]
#[allow(clippy::too_many_arguments)] // They are the keywords of the function.
pub(crate) fn stylize(
    py: Python<'_>,
    motion: &Motion,
    db: &Database,
    styles: &Bound<'_, PyAny>,
    parts: Option<&Bound<'_, PyDict>>,
    track: Option<&Bound<'_, PyAny>>,
    trace: bool,
    #[pyo3(from_py_with = number)] threads: usize,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<StyledMotion> {
    let keys = track.map(|track| keys_of(track, styles)).transpose()?;
    let settings = settings(styles, parts, options)?;
    let name = db.message_name();
    watched(py, progress.as_ref(), |on_progress: &OnProgress<'_>| {
        let mut styling = Styling::new(settings.stylizer(&db.model(settings.search)?, Path::new(&name))?);
        if let Some(keys) = &keys {
            let track = StyleTrack::new(keys, styling.catalogue())?;
            styling = styling.with_track(track);
        }
        let Named { name, clip, .. } = &*motion.named;
        let mut log = trace.then(|| TraceLog::new(styling.catalogue(), styling.classes(), Cursor::new(Vec::new())));
        let style = || styling.style(name, clip, log.as_mut(), Spread::Frames, on_progress);
        let styled = with_threads(threads, style)??;
        let lines = log.map(|log| json_lines(log, &styled)).transpose().map_err(TaskError::new)?;
        Ok(StyledMotion::new(styled, &styling, lines))
    })
}

fn json_lines(log: TraceLog<'_>, styled: &Styled) -> io::Result<Vec<u8>> {
    let mut lines = Vec::new();
    log.write_json_lines(&styled.motion.frames, &mut lines)?;
    Ok(lines)
}

/// Returns the keys of a track that starts with styles.
fn keys_of(track: &Bound<'_, PyAny>, begin: &Bound<'_, PyAny>) -> PyResult<Vec<StyleKey>> {
    let wrong = || PyTypeError::new_err("a track must be a sequence of pairs of a time in seconds and styles");
    let mut keys = Vec::new();
    for pair in track.try_iter()? {
        let (secs, of): (f64, Bound<'_, PyAny>) = pair?.extract().map_err(|_| wrong())?;
        keys.push(StyleKey { secs, styles: styles(&of)? });
    }
    if keys.first().is_none_or(|first| first.secs > 0.0) {
        keys.insert(0, StyleKey { secs: 0.0, styles: styles(begin)? });
    }
    Ok(keys)
}
