//! Clips with their reading options.

use crate::error::bad_input;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;
use strut_core::note::Note;
use strut_core::retarget::{ReadAs, UpAxis};
use strut_formats::corpus::Clip;
use strut_formats::joints::{JointAssignment, Reading};
use strut_tasks::{Outcome, TaskError};

/// A clip and its name in messages.
pub(crate) struct Named {
    pub(crate) name: String,
    pub(crate) clip: Clip,
    /// Contents of the file.
    pub(crate) bytes: Vec<u8>,
    /// Explicit reading options.
    pub(crate) reading: Reading,
}

/// A recorded motion of a humanoid.
#[pyclass(frozen, module = "strut")]
pub(crate) struct Motion {
    pub(crate) named: Arc<Named>,
}

impl Named {
    pub(crate) fn new(name: String, bytes: Vec<u8>, reading: Reading) -> Outcome<Self> {
        let clip = Clip::read(&bytes, &reading).map_err(|reason| TaskError::in_file(Path::new(&name), reason))?;
        Ok(Self { name, clip, bytes, reading })
    }
}

/// Returns the reading options of a motion. `roles` has names of joints, or None, by names of roles; `floor` is in
/// metres.
pub(crate) fn reading(
    py: Python<'_>,
    roles: Option<&Bound<'_, PyDict>>,
    up: Option<&str>,
    floor: Option<f32>,
    swap_sides: bool,
) -> PyResult<Reading> {
    let read = |roles: &Bound<'_, PyDict>| {
        let wrong = || PyTypeError::new_err("roles must be a dict of joint names (or None) by role name");
        let pair = |(role, joint): (Bound<'_, PyAny>, Bound<'_, PyAny>)| {
            Ok((role.extract().map_err(|_| wrong())?, joint.extract().map_err(|_| wrong())?))
        };
        let joints = roles.iter().map(pair).collect::<PyResult<BTreeMap<String, Option<String>>>>()?;
        JointAssignment::new(joints).map_err(|reason| bad_input(py, reason))
    };
    let up_axis = |up| {
        let unlike = || bad_input(py, format_args!("up is '{up:.40}'; x, -x, y, -y, z or -z was expected"));
        UpAxis::from_name(up).ok_or_else(unlike)
    };
    if let Some(floor) = floor.filter(|floor| !floor.is_finite()) {
        return Err(bad_input(py, format_args!("the floor is at {floor} m; a finite number was expected")));
    }
    let read_as = ReadAs { up: up.map(up_axis).transpose()?, floor_metres: floor, swap_sides, ..ReadAs::default() };
    Ok(Reading { joints: roles.map(read).transpose()?, read_as })
}

/// Returns notes as dicts of a code and a text.
pub(crate) fn notes<'py>(py: Python<'py>, notes: &[Note]) -> PyResult<Bound<'py, PyList>> {
    let dict_of = |note: &Note| {
        let dict = PyDict::new(py);
        dict.set_item("code", note.code.name())?;
        dict.set_item("text", &*note.text)?;
        Ok(dict)
    };
    PyList::new(py, notes.iter().map(dict_of).collect::<PyResult<Vec<_>>>()?)
}
