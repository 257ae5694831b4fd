//! Conversion between poses and numpy arrays.

use crate::error::bad_input;
use numpy::{
    Element, IntoPyArray, PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2, PyReadonlyArrayDyn,
    PyUntypedArrayMethods,
};
use pyo3::prelude::*;
use strut_core::humanoid::{POSE_FLOATS, Pose};

/// Reads the poses of an array: C-contiguous float32 with 87 columns, root x y z in metres and x y z w of every
/// rotation.
///
/// # Errors
/// If the array has another form.
pub(crate) fn poses_of(array: &Bound<'_, PyAny>) -> PyResult<Vec<Pose>> {
    let py = array.py();
    let wrong = || bad_input(py, format_args!("C-contiguous float32 of {POSE_FLOATS} columns was expected"));
    let array: PyReadonlyArray2<'_, f32> = array.extract().map_err(|_| wrong())?;
    if array.shape()[1] != POSE_FLOATS || !array.is_c_contiguous() {
        return Err(wrong());
    }
    let floats = array.as_slice().map_err(|_| wrong())?;
    Ok(floats.as_chunks::<POSE_FLOATS>().0.iter().map(Pose::read_from).collect())
}

/// Reads the numbers of an array: C-contiguous float32 of this shape, in which `None` is any size.
///
/// # Errors
/// If the array has another form.
pub(crate) fn floats(array: &Bound<'_, PyAny>, name: &str, shape: &[Option<usize>]) -> PyResult<Vec<f32>> {
    let py = array.py();
    let sizes: Vec<String> = shape.iter().map(|size| size.map_or("n".to_owned(), |size| size.to_string())).collect();
    let wrong = || {
        let expected = format_args!("C-contiguous float32 of shape {} was expected", sizes.join(" × "));
        bad_input(py, format_args!("{name}: {expected}"))
    };
    let array: PyReadonlyArrayDyn<'_, f32> = array.extract().map_err(|_| wrong())?;
    let is_alike = |(found, wanted): (&usize, &Option<usize>)| wanted.is_none_or(|size| size == *found);
    if array.shape().len() != shape.len() || !array.shape().iter().zip(shape).all(is_alike) || !array.is_c_contiguous()
    {
        return Err(wrong());
    }
    Ok(array.as_slice().map_err(|_| wrong())?.to_vec())
}

/// Returns poses as an array in the same layout.
pub(crate) fn array_of<'py>(py: Python<'py>, poses: &[Pose]) -> PyResult<Bound<'py, PyArray2<f32>>> {
    let mut floats = vec![0.0; poses.len() * POSE_FLOATS];
    for (pose, out) in poses.iter().zip(floats.as_chunks_mut::<POSE_FLOATS>().0) {
        pose.write_to(out);
    }
    rows(py, floats, POSE_FLOATS)
}

/// Returns two flags per row as an array of 0 and 1.
pub(crate) fn flags(py: Python<'_>, of: impl Iterator<Item = [bool; 2]>) -> PyResult<Bound<'_, PyArray2<u8>>> {
    rows(py, of.flatten().map(u8::from).collect(), 2)
}

/// Returns numbers as an array with this number of columns; they are moved, not copied.
pub(crate) fn rows<T: Element>(py: Python<'_>, flat: Vec<T>, columns: usize) -> PyResult<Bound<'_, PyArray2<T>>> {
    let rows = flat.len() / columns;
    flat.into_pyarray(py).reshape([rows, columns])
}

/// Returns numbers as an array; they are moved, not copied.
pub(crate) fn column<T: Element>(py: Python<'_>, flat: Vec<T>) -> Bound<'_, PyArray1<T>> {
    flat.into_pyarray(py)
}
