//! Live styling, pose by pose.

use crate::arrays::{array_of, column, flags, poses_of};
use crate::database::Database;
use crate::error::{bad_input, exception};
use crate::options::{set_options, set_parts, settings, styles};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::Path;
use strut_core::transfer::{self, BodyPart};
use strut_tasks::stylize::StyleSettings;

/// Styles poses as they arrive.
#[pyclass(module = "strut")]
pub(crate) struct Stylizer {
    engine: transfer::Stylizer,
    settings: StyleSettings,
    /// Name of the database.
    name: String,
}

impl Stylizer {
    /// Applies other settings. The former ones are kept if they do not match the database.
    fn apply(&mut self, py: Python<'_>, settings: StyleSettings) -> PyResult<()> {
        if settings.search != self.settings.search {
            return Err(bad_input(py, "the search of a stylizer cannot be changed; create another stylizer"));
        }
        let new = settings.stylizer(self.engine.model(), Path::new(&self.name));
        let new = new.map_err(|error| exception(py, &error))?;
        // The stream continues: its state is kept, and the checked settings are applied.
        self.engine.set_options(*new.options()).map_err(|error| bad_input(py, error))?;
        let model = std::sync::Arc::clone(self.engine.model());
        let weights = settings.styles.of(model.catalogue()).map_err(|reason| bad_input(py, reason))?;
        self.engine.set_styles(&weights).map_err(|error| bad_input(py, error))?;
        for part in BodyPart::ALL {
            let of = settings.parts.iter().rev().find(|of| of.parts.contains(&part));
            let weights = of.map(|of| of.weights.of(model.catalogue())).transpose();
            let weights = weights.map_err(|reason| bad_input(py, reason))?;
            self.engine.set_part_styles(part, weights.as_deref()).map_err(|error| bad_input(py, error))?;
        }
        self.settings = settings;
        Ok(())
    }
}

#[pymethods]
impl Stylizer {
    #[new]
    #[pyo3(signature = (db, styles, *, parts=None, **options))]
    fn new(
        py: Python<'_>,
        db: &Database,
        styles: &Bound<'_, PyAny>,
        parts: Option<&Bound<'_, PyDict>>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let settings = settings(styles, parts, options)?;
        let name = db.message_name();
        let engine = py.detach(|| settings.stylizer(&db.model(settings.search)?, Path::new(&name)));
        Ok(Self { engine: engine.map_err(|error| exception(py, &error))?, settings, name })
    }

    /// Sets the styles from the next pose on. Parts without separate styles follow the whole body.
    #[pyo3(signature = (styles, parts=None))]
    fn set_styles(
        &mut self,
        py: Python<'_>,
        #[pyo3(from_py_with = styles)] styles: strut_tasks::weights::StyleWeights,
        parts: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<()> {
        let mut settings = StyleSettings { styles, parts: Vec::new(), ..self.settings.clone() };
        set_parts(&mut settings, parts)?;
        self.apply(py, settings)
    }

    /// Sets options from the next pose on.
    #[pyo3(signature = (**options))]
    fn configure(&mut self, py: Python<'_>, options: Option<&Bound<'_, PyDict>>) -> PyResult<()> {
        let mut settings = self.settings.clone();
        set_options(&mut settings, options)?;
        self.apply(py, settings)
    }

    /// Styles the next poses, one frame at the database's rate apart, on its body, in the layout of `Motion.poses`.
    fn push<'py>(&mut self, py: Python<'py>, poses: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let poses = poses_of(poses)?;
        let engine = &mut self.engine;
        let frames: Vec<_> = py.detach(|| poses.iter().map(|pose| *engine.push(pose)).collect());
        let out: Vec<_> = frames.iter().map(|frame| frame.pose).collect();
        let times = frames.iter().map(|frame| frame.time_out_secs).collect();
        let planted = flags(py, frames.iter().map(|frame| frame.planted))?;
        let styled = py.import("strut._arrays")?.getattr("Styled")?;
        styled.call1((array_of(py, &out)?, column::<f64>(py, times), planted))
    }

    /// Restarts, for example after a seek: the output starts at the position of the next pose.
    fn reset(&mut self) {
        self.engine.reset(None);
    }
}
