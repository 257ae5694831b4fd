//! Tensors of an open file.

use super::{ContainerError, Kind, Source};
use bytemuck::Pod;
use safetensors::tensor::{Dtype, Metadata as Header};
use std::ops::RangeInclusive;
use strut_core::humanoid::JOINTS;
use strut_core::math::Quat;

/// All tensors of a file.
pub(crate) struct Tensors<'a, S: ?Sized> {
    kind: Kind,
    header: Header,
    /// Position of the first tensor.
    start: usize,
    file: &'a S,
}

impl<'a, S: Source + ?Sized> Tensors<'a, S> {
    pub(super) fn new(kind: Kind, header: Header, start: usize, file: &'a S) -> Self {
        Self { kind, header, start, file }
    }

    /// Tensor of this name. `None` in the shape matches any length.
    pub(crate) fn find(
        &self,
        name: &'static str,
        dtype: Dtype,
        shape: &[Option<usize>],
    ) -> Result<Tensor<'_, S>, ContainerError> {
        let missing = ContainerError::MissingTensor { kind: self.kind, tensor: name };
        let info = self.header.info(name).ok_or(missing)?;
        let fits = info.shape.len() == shape.len()
            && info.shape.iter().zip(shape).all(|(found, expected)| expected.is_none_or(|e| e == *found));
        if info.dtype != dtype || !fits {
            let lengths: Vec<String> = shape.iter().map(|l| l.map_or("any".into(), |l| l.to_string())).collect();
            return Err(ContainerError::Tensor {
                tensor: name,
                found: format!("{:?} {:?}", info.dtype, info.shape),
                expected: format!("{dtype:?} [{}]", lengths.join(", ")),
            });
        }
        let (begin, end) = info.data_offsets;
        Ok(Tensor { file: self.file, begin: self.start + begin, bytes: end - begin, shape: &info.shape })
    }

    /// Number of rows of a tensor: its first dimension, 0 if it is missing.
    pub(crate) fn rows(&self, name: &str) -> usize {
        self.header.info(name).and_then(|info| info.shape.first().copied()).unwrap_or_default()
    }

    /// Numbers of an f32 tensor of this shape, all finite.
    pub(crate) fn finite(&self, name: &'static str, shape: &[usize]) -> Result<Vec<f32>, ContainerError> {
        self.all(name, shape, f32::is_finite, "a finite number")
    }

    /// Same as [`Self::finite`], all above zero.
    pub(crate) fn positive(&self, name: &'static str, shape: &[usize]) -> Result<Vec<f32>, ContainerError> {
        self.all(name, shape, |v| v.is_finite() && v > 0.0, "a positive number")
    }

    /// Same as [`Self::finite`], all within a range that `expected` describes.
    pub(crate) fn within(
        &self,
        name: &'static str,
        shape: &[usize],
        range: &RangeInclusive<f32>,
        expected: &'static str,
    ) -> Result<Vec<f32>, ContainerError> {
        self.all(name, shape, |v| range.contains(&v), expected)
    }

    /// A rotation for every joint.
    pub(crate) fn rotations(&self, name: &'static str) -> Result<[Quat; JOINTS], ContainerError> {
        let numbers = self.finite(name, &[JOINTS, 4])?;
        let rotations: [Quat; JOINTS] = std::array::from_fn(|j| {
            let [x, y, z, w] = std::array::from_fn(|i| numbers[4 * j + i]);
            Quat::from_xyzw(x, y, z, w)
        });
        match rotations.iter().find(|q| (q.dot(**q) - 1.0).abs() > 1e-3) {
            Some(q) => Err(ContainerError::value(name, format!("{:?}", q.to_array()), "a unit quaternion")),
            None => Ok(rotations.map(Quat::normalized)),
        }
    }

    fn all(
        &self,
        name: &'static str,
        shape: &[usize],
        is: impl Fn(f32) -> bool,
        expected: &'static str,
    ) -> Result<Vec<f32>, ContainerError> {
        let shape: Vec<Option<usize>> = shape.iter().copied().map(Some).collect();
        let values: Vec<f32> = self.find(name, Dtype::F32, &shape)?.numbers();
        match values.iter().find(|v| !is(**v)) {
            Some(v) => Err(ContainerError::value(name, v, expected)),
            None => Ok(values),
        }
    }
}

/// A tensor of the expected type and shape.
pub(crate) struct Tensor<'a, S: ?Sized> {
    file: &'a S,
    begin: usize,
    bytes: usize,
    shape: &'a [usize],
}

// Bytes are reinterpreted as numbers.
const _: () = assert!(cfg!(target_endian = "little"), "files are little-endian");

impl<S: Source + ?Sized> Tensor<'_, S> {
    /// Shape of the tensor.
    pub(crate) fn shape(&self) -> &[usize] {
        self.shape
    }

    /// All numbers.
    pub(crate) fn numbers<T: Pod>(&self) -> Vec<T> {
        self.part(0, self.bytes)
    }

    /// The halves of a tensor whose first dimension is 2.
    pub(crate) fn halves<T: Pod>(&self) -> [Vec<T>; 2] {
        let half = self.bytes / 2;
        [self.part(0, half), self.part(half, half)]
    }

    /// Copies numbers in groups, from index `first` of the tensor on. The range must exist.
    pub(crate) fn copy<T: Pod>(&self, first: usize, to: &mut [T]) {
        let size = self.bytes / self.shape.iter().product::<usize>().max(1);
        self.file.copy(self.begin + first * size, bytemuck::cast_slice_mut(to));
    }

    fn part<T: Pod>(&self, begin: usize, bytes: usize) -> Vec<T> {
        let mut numbers = vec![T::zeroed(); bytes / size_of::<T>()];
        self.file.copy(self.begin + begin, bytemuck::cast_slice_mut(&mut numbers));
        numbers
    }
}
