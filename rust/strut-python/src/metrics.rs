//! Measures of motions, on a database's body and at its rate.

use crate::arrays::{column, poses_of};
use crate::database::Database;
use crate::error::bad_input;
use numpy::{PyArray3, PyArrayMethods, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;
use strut_core::contact;
use strut_core::humanoid::{HumanoidMotion, JOINTS};
use strut_core::kinematics::world_from_local;
use strut_core::math::Vec3;
use strut_core::metrics::{self, Points};

fn motion_of(db: &Database, poses: &Bound<'_, PyAny>) -> PyResult<HumanoidMotion> {
    let catalogue = db.shared.model.catalogue();
    let (py, poses) = (poses.py(), poses_of(poses)?);
    if poses.is_empty() {
        return Err(bad_input(py, "there is no pose; at least one was expected"));
    }
    Ok(HumanoidMotion { proportions: catalogue.proportions, rate_hz: catalogue.rate_hz, poses })
}

fn points_of(motion: &HumanoidMotion) -> Vec<Points> {
    motion.poses.iter().map(|pose| world_from_local(&motion.proportions, pose).positions).collect()
}

/// Positions of the 21 joints, metres.
#[pyfunction]
pub(crate) fn positions<'py>(
    py: Python<'py>,
    db: &Database,
    poses: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyArray3<f32>>> {
    let motion = motion_of(db, poses)?;
    let flat: Vec<f32> = py.detach(|| points_of(&motion).iter().flatten().flat_map(Vec3::to_array).collect());
    column(py, flat).reshape([motion.poses.len(), JOINTS, 3])
}

/// Mean distance between the joints of two motions of the same length in the world, metres.
#[pyfunction]
pub(crate) fn pose_error(
    py: Python<'_>,
    db: &Database,
    first: &Bound<'_, PyAny>,
    second: &Bound<'_, PyAny>,
) -> PyResult<f32> {
    let (first, second) = (motion_of(db, first)?, motion_of(db, second)?);
    if first.poses.len() != second.poses.len() {
        let lengths = format_args!("the motions have {} and {} poses", first.poses.len(), second.poses.len());
        return Err(bad_input(py, format_args!("{lengths}; equal numbers were expected")));
    }
    Ok(py.detach(|| metrics::pose_error(&points_of(&first), &points_of(&second))))
}

/// Mean horizontal speed of planted feet, metres per second. Without `planted`, n × 2 of 0 and 1, contacts are
/// detected.
#[pyfunction]
#[pyo3(signature = (db, poses, planted=None))]
pub(crate) fn foot_skate(
    py: Python<'_>,
    db: &Database,
    poses: &Bound<'_, PyAny>,
    planted: Option<PyReadonlyArray2<'_, u8>>,
) -> PyResult<f32> {
    let motion = motion_of(db, poses)?;
    let given = match planted {
        None => None,
        Some(planted) if planted.shape() == [motion.poses.len(), 2] => {
            let planted = planted.as_array();
            Some(planted.rows().into_iter().map(|row| [row[0] != 0, row[1] != 0]).collect::<Vec<_>>())
        }
        Some(planted) => {
            let reason = format_args!("planted is {:?}; [{}, 2] was expected", planted.shape(), motion.poses.len());
            return Err(bad_input(py, reason));
        }
    };
    Ok(py.detach(|| metrics::foot_skate(&motion, &given.unwrap_or_else(|| contact::label(&motion)))))
}

/// Mean acceleration of the joints, metres per second².
#[pyfunction]
pub(crate) fn mean_acceleration(py: Python<'_>, db: &Database, poses: &Bound<'_, PyAny>) -> PyResult<f32> {
    let motion = motion_of(db, poses)?;
    Ok(py.detach(|| metrics::mean_acceleration(&motion)))
}

/// Mean jerk of the joints, metres per second³.
#[pyfunction]
pub(crate) fn mean_jerk(py: Python<'_>, db: &Database, poses: &Bound<'_, PyAny>) -> PyResult<f32> {
    let motion = motion_of(db, poses)?;
    Ok(py.detach(|| metrics::mean_jerk(&motion)))
}
