//! Clips with what is known of their skeletons.

use crate::error::bad_input;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::Path;
use std::sync::Arc;
use strut_core::humanoid::{JOINTS, Role};
use strut_core::motion;
use strut_core::retarget::{Binding, ReadAs};
use strut_formats::bvh;
use strut_formats::corpus::Clip;
use strut_tasks::suggestion::unknown;
use strut_tasks::{Outcome, TaskError};

/// A clip and its name in messages.
pub(crate) struct Named {
    pub(crate) name: String,
    pub(crate) clip: Clip,
    /// The file.
    pub(crate) bytes: Vec<u8>,
    pub(crate) known: Known,
}

/// What is said of a skeleton and not detected.
#[derive(Clone, Debug, Default)]
pub(crate) struct Known {
    /// The joint of roles, or that there is none.
    roles: Vec<(Role, Option<String>)>,
    pub(crate) metres_per_unit: Option<f32>,
}

/// A recorded motion of a humanoid.
#[pyclass(frozen, module = "strut")]
pub(crate) struct Motion {
    pub(crate) named: Arc<Named>,
}

impl Known {
    /// From a dict of joints by role.
    pub(crate) fn of(roles: Option<&Bound<'_, PyDict>>, metres_per_unit: Option<f32>) -> PyResult<Self> {
        let names: Vec<&str> = Role::ALL.iter().map(|role| role.name()).collect();
        let role_of = |(role, joint): (Bound<'_, PyAny>, Bound<'_, PyAny>)| {
            let wrong = || PyTypeError::new_err("roles are a dict of names of joints, or None, by the names of roles");
            let name: String = role.extract().map_err(|_| wrong())?;
            let role = Role::ALL.into_iter().find(|role| role.name() == name);
            let role = role.ok_or_else(|| bad_input(joint.py(), unknown("role", &name, &names)))?;
            Ok((role, joint.extract().map_err(|_| wrong())?))
        };
        let roles = roles.into_iter().flatten().map(role_of).collect::<PyResult<_>>()?;
        Ok(Self { roles, metres_per_unit })
    }

    /// The binding of a motion, the rest of which is detected.
    fn bind(&self, motion: &motion::Motion) -> Result<Binding, String> {
        let mut roles: Option<[Option<usize>; JOINTS]> = None;
        for (role, joint) in &self.roles {
            let index = joint.as_deref().map(|name| {
                let names: Vec<&str> = motion.skeleton.joints().iter().map(|joint| joint.name.as_str()).collect();
                motion.skeleton.find(name).ok_or_else(|| unknown("joint", name, &names))
            });
            let roles = roles.get_or_insert_with(|| Binding::likely_roles(motion));
            roles[role.index()] = index.transpose()?;
        }
        let read_as = ReadAs { joints: roles, metres_per_unit: self.metres_per_unit, ..ReadAs::default() };
        Binding::read(motion, &read_as).map_err(|reason| reason.to_string())
    }

    /// The roles as Python's values.
    pub(crate) fn roles<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let roles = PyDict::new(py);
        self.roles.iter().try_for_each(|(role, joint)| roles.set_item(role.name(), joint))?;
        Ok(roles)
    }
}

impl Named {
    pub(crate) fn new(name: String, bytes: Vec<u8>, known: Known) -> Outcome<Self> {
        let clip = || -> Result<Clip, String> {
            let (file, mut notes) = bvh::parse_noted(&bytes).map_err(|e| e.to_string())?;
            let motion = file.to_motion().map_err(|e| e.to_string())?;
            let binding = known.bind(&motion)?;
            notes.extend_from_slice(&binding.doubts);
            Ok(Clip { file, motion, binding, notes })
        };
        let clip = clip().map_err(|reason| TaskError::in_file(Path::new(&name), reason))?;
        Ok(Self { name, clip, bytes, known })
    }
}
