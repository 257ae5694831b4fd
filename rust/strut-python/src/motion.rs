//! Motions: files and arrays in, poses out.

use crate::arrays::{array_of, flags, floats};
use crate::call::watched;
use crate::clip::{self, Motion, Named, reading};
use crate::database::Database;
use crate::error::bad_input;
use crate::options::number;
use numpy::PyArray2;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyList};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use strut_core::contact;
use strut_core::humanoid::{HumanoidMotion, Role};
use strut_core::math::{Quat, Vec3};
use strut_core::motion;
use strut_core::retarget::{ReadAs, UpAxis};
use strut_core::skeleton::{Joint, Skeleton};
use strut_formats::bvh::{self, Bvh};
use strut_formats::corpus::Clip;
use strut_formats::joints::{JointAssignment, Reading};
use strut_formats::{quotation, shown_number};
use strut_tasks::stylize::input_of;
use strut_tasks::{Outcome, TaskError, files};

/// Range of frame rates of files, frames per second.
const RATES_HZ: std::ops::RangeInclusive<f64> = 0.1..=10_000.0;

/// A motion from arrays, with +Y up.
struct Arrays {
    names: Vec<String>,
    parents: Vec<i64>,
    offsets: Vec<f32>,
    translations: Vec<f32>,
    rotations: Vec<f32>,
    rate_hz: f64,
    is_z_up: bool,
}

impl Arrays {
    /// Returns the bytes of a BVH file with the motion.
    fn file(&self) -> Outcome<Vec<u8>> {
        let joints = self.names.len();
        let vector = |v: &[f32; 3]| Vec3::from_array(*v);
        // From +Z up and +Y away from the viewer to +Y up.
        let turn = if self.is_z_up { Quat::from_rotation_x(-std::f32::consts::FRAC_PI_2) } else { Quat::IDENTITY };
        let joint = |((name, parent), offset): ((&String, &i64), &[f32; 3])| {
            let is_writable = name.trim() == name && !name.is_empty() && !name.contains(char::is_control);
            if !is_writable || name.len() > bvh::MAX_NAME_BYTES {
                return Err(TaskError::usage(format_args!(
                    "'{}' is not a joint name; a name on one line of at most {} bytes was expected",
                    quotation(name, 40),
                    bvh::MAX_NAME_BYTES
                )));
            }
            let parent = usize::try_from(*parent).ok();
            let offset = if parent.is_none() { turn * vector(offset) } else { vector(offset) };
            Ok(Joint { name: name.clone(), parent, offset, end: None })
        };
        let offsets = self.offsets.as_chunks::<3>().0;
        let skeleton = self.names.iter().zip(&self.parents).zip(offsets).map(joint).collect::<Outcome<Vec<Joint>>>()?;
        let skeleton = Skeleton::new(skeleton).map_err(TaskError::new)?;
        let is_root = |index: usize| index.is_multiple_of(joints);
        let translations = self.translations.as_chunks::<3>().0.iter().map(vector).enumerate();
        let translations = translations.map(|(i, v)| if is_root(i) { turn * v } else { v }).collect();
        let mut rotations = Vec::with_capacity(self.rotations.len() / 4);
        for (i, [x, y, z, w]) in self.rotations.as_chunks::<4>().0.iter().enumerate() {
            let rotation = Quat::from_xyzw(*x, *y, *z, *w);
            let squared: f32 = rotation.to_array().iter().map(|v| v * v).sum();
            if !(1e-6..1e6).contains(&squared) {
                let place = format_args!("of joint {} in frame {}", i % joints, i / joints);
                return Err(TaskError::new(format_args!("the rotation {place} is not a quaternion")));
            }
            let rotation = rotation.normalized();
            rotations.push(if is_root(i) { turn * rotation } else { rotation });
        }
        let motion = motion::Motion::new(skeleton, 1.0 / self.rate_hz, translations, rotations);
        let file = Bvh::from_motion(&motion.map_err(TaskError::new)?).map_err(TaskError::new)?;
        Ok(bvh::write(&file))
    }
}

/// Function that pickle calls, with its arguments.
type Reduced<'py> = (Bound<'py, PyAny>, Reopened<'py>);

/// A motion's bytes and name, then the reading options: roles, up axis, floor, sides and unit.
type Reopened<'py> =
    (Bound<'py, PyBytes>, String, Option<Bound<'py, PyDict>>, Option<&'static str>, Option<f32>, bool, Option<f32>);

#[pymethods]
impl Motion {
    /// Opens a BVH file by its path, or from its bytes. `roles` maps roles that are detected wrongly to the
    /// names of joints, or to None. `up` is the file's up axis: x, -x, y, -y, z or -z. `floor` is the height of the ground along
    /// it, metres. `swap_sides` swaps left and right. Options that are not given are detected.
    #[staticmethod]
    #[pyo3(signature = (source, *, roles=None, up=None, floor=None, swap_sides=false))]
    fn open(
        py: Python<'_>,
        source: &Bound<'_, PyAny>,
        roles: Option<&Bound<'_, PyDict>>,
        up: Option<&str>,
        #[pyo3(from_py_with = number)] floor: Option<f32>,
        swap_sides: bool,
    ) -> PyResult<Self> {
        let reading = reading(py, roles, up, floor, swap_sides)?;
        let named = if let Ok(bytes) = source.cast::<PyBytes>() {
            let bytes = bytes.as_bytes().to_owned();
            watched(py, None, |_| Named::new("the motion".into(), bytes, reading))
        } else {
            let path: PathBuf = source.extract()?;
            watched(py, None, |_| Named::new(path.display().to_string(), files::read(&path, bvh::MAX_BYTES)?, reading))
        };
        Ok(Self { named: Arc::new(named?) })
    }

    /// Makes a motion of a skeleton. Each joint has a name, the index of its parent (-1 for the first, the root) and an
    /// offset in the parent's frame, j × 3. Each joint has in each frame a translation in the parent's frame, n × j ×
    /// 3, and a rotation relative to the parent, n × j × 4, x y z w. Arrays are C-contiguous float32. `up` is the up
    /// axis, "y" or "z"; the resulting motion has +Y up. The unit of length is detected unless it is given.
    #[staticmethod]
    #[pyo3(signature = (names, parents, offsets, translations, rotations_xyzw, rate_hz, *, up="y", metres_per_unit=None, roles=None))]
    #[allow(clippy::too_many_arguments)] // They are the keywords of the function.
    fn from_arrays(
        py: Python<'_>,
        names: Vec<String>,
        #[pyo3(from_py_with = number)] parents: Vec<i64>,
        offsets: &Bound<'_, PyAny>,
        translations: &Bound<'_, PyAny>,
        rotations_xyzw: &Bound<'_, PyAny>,
        #[pyo3(from_py_with = number)] rate_hz: f64,
        up: &str,
        #[pyo3(from_py_with = number)] metres_per_unit: Option<f32>,
        roles: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let joints = names.len();
        if parents.len() != joints {
            let count = format_args!("there are {joints} names and {} parents", parents.len());
            return Err(bad_input(py, format_args!("{count}; equal numbers were expected")));
        }
        if !["y", "z"].contains(&up) {
            return Err(bad_input(py, format_args!("up is '{up:.40}'; y or z was expected")));
        }
        if !RATES_HZ.contains(&rate_hz) {
            let (least, most) = (RATES_HZ.start(), RATES_HZ.end());
            let expected = format_args!("{least} to {most} frames per second were expected");
            return Err(bad_input(py, format_args!("the rate is {}; {expected}", shown_number(rate_hz))));
        }
        if let Some(unit) = metres_per_unit.filter(|unit| !(*unit > 0.0 && unit.is_finite())) {
            return Err(bad_input(py, format_args!("a unit is {unit} m; a positive number was expected")));
        }
        let offsets = floats(offsets, "offsets", &[Some(joints), Some(3)])?;
        let translations = floats(translations, "translations", &[None, Some(joints), Some(3)])?;
        let rotations = floats(rotations_xyzw, "rotations_xyzw", &[None, Some(joints), Some(4)])?;
        let mut reading = reading(py, roles, Some("y"), None, false)?;
        reading.read_as.metres_per_unit = metres_per_unit;
        let arrays = Arrays { names, parents, offsets, translations, rotations, rate_hz, is_z_up: up == "z" };
        let named = watched(py, None, |_| Named::new("the motion".into(), arrays.file()?, reading))?;
        Ok(Self { named: Arc::new(named) })
    }

    /// Restores the result of `open` or `from_arrays`.
    #[staticmethod]
    #[allow(clippy::too_many_arguments)] // Pickle has no keywords.
    fn _reopen(
        py: Python<'_>,
        bytes: &[u8],
        name: String,
        roles: Option<&Bound<'_, PyDict>>,
        up: Option<&str>,
        floor: Option<f32>,
        swap_sides: bool,
        metres_per_unit: Option<f32>,
    ) -> PyResult<Self> {
        let mut reading = reading(py, roles, up, floor, swap_sides)?;
        reading.read_as.metres_per_unit = metres_per_unit;
        let bytes = bytes.to_owned();
        let named = watched(py, None, |_| Named::new(name, bytes, reading))?;
        Ok(Self { named: Arc::new(named) })
    }

    /// Returns the motion on a database's body and at its rate, as float32 with 87 columns: root x y z in metres, then
    /// x y z w of the rotation of each of the 21 joints relative to its parent.
    fn poses<'py>(&self, py: Python<'py>, db: &Database) -> PyResult<Bound<'py, PyArray2<f32>>> {
        let input = self.input(py, db)?;
        array_of(py, &input.poses)
    }

    /// Returns whether the left and the right foot is planted in each frame of `poses`, as 0 and 1.
    fn contacts<'py>(&self, py: Python<'py>, db: &Database) -> PyResult<Bound<'py, PyArray2<u8>>> {
        let input = self.input(py, db)?;
        flags(py, contact::label(&input).into_iter())
    }

    /// The path of its file, or "the motion".
    #[getter]
    fn name(&self) -> &str {
        &self.named.name
    }

    /// Number of frames of the file.
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

    /// The joint of each role of the humanoid, by name.
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

    /// Notes on the joint mapping, in sentences.
    #[getter]
    fn note(&self) -> String {
        self.named.clip.binding.notes.join(" ")
    }

    fn __repr__(&self) -> String {
        format!("<strut.Motion {}: {} frames, {:.2} s>", self.name(), self.frames(), self.duration_secs())
    }

    /// Warnings about the reading, as dicts of a code and a text; empty for a clean clip.
    #[getter]
    fn notes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        clip::notes(py, &self.named.clip.notes)
    }

    /// The bytes of the file, with the name and the reading options.
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        let (py, named) = (slf.py(), &slf.get().named);
        let Named { name, bytes, reading: Reading { joints, read_as }, .. } = &**named;
        let dict_of = |joints: &JointAssignment| {
            let roles = PyDict::new(py);
            joints.joints().iter().try_for_each(|(role, joint)| roles.set_item(role, joint)).map(|()| roles)
        };
        let (roles, up) = (joints.as_ref().map(dict_of).transpose()?, read_as.up.map(UpAxis::name));
        let ReadAs { floor_metres, swap_sides, metres_per_unit, .. } = *read_as;
        let arguments = (PyBytes::new(py, bytes), name.clone(), roles, up, floor_metres, swap_sides, metres_per_unit);
        Ok((slf.get_type().getattr("_reopen")?, arguments))
    }
}

impl Motion {
    fn input(&self, py: Python<'_>, db: &Database) -> PyResult<HumanoidMotion> {
        watched(py, None, |_| {
            let fail = |reason| TaskError::in_file(Path::new(&self.named.name), reason);
            input_of(&self.named.clip, db.shared.model.catalogue()).map(|input| input.motion).map_err(fail)
        })
    }
}
