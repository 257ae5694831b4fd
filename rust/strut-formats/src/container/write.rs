//! Writes metadata and tensors as bytes.

use super::{Kind, checksum};
use safetensors::View;
use safetensors::tensor::Dtype;
use serde::Serialize;
use std::borrow::Cow;

/// A tensor whose bytes are created when they are written, so that a browser does not need memory for the file twice.
pub(crate) struct Written<'a> {
    dtype: Dtype,
    shape: Vec<usize>,
    bytes: Box<dyn Fn() -> Vec<u8> + 'a>,
}

impl<'a> Written<'a> {
    /// A tensor. `bytes` returns the number of bytes that type and shape require.
    pub(crate) fn new(dtype: Dtype, shape: Vec<usize>, bytes: impl Fn() -> Vec<u8> + 'a) -> Self {
        Self { dtype, shape, bytes: Box::new(bytes) }
    }
}

/// A tensor of f32 with this shape.
pub(crate) fn floats<'a, I: Iterator<Item = f32>>(shape: Vec<usize>, values: impl Fn() -> I + 'a) -> Written<'a> {
    let length = 4 * shape.iter().product::<usize>();
    Written::new(Dtype::F32, shape, move || {
        let mut bytes = Vec::with_capacity(length);
        bytes.extend(values().flat_map(f32::to_le_bytes));
        bytes
    })
}

/// A tensor of f32 with this shape, rounded from f64.
pub(crate) fn rounded<'a, I: Iterator<Item = f64>>(shape: Vec<usize>, values: impl Fn() -> I + 'a) -> Written<'a> {
    floats(shape, move || values().map(|v| v as f32))
}

impl View for &Written<'_> {
    fn dtype(&self) -> Dtype {
        self.dtype
    }

    fn shape(&self) -> &[usize] {
        &self.shape
    }

    fn data(&self) -> Cow<'_, [u8]> {
        (self.bytes)().into()
    }

    fn data_len(&self) -> usize {
        self.shape.iter().product::<usize>() * self.dtype.bitsize() / 8
    }
}

/// Writes a file whose metadata contain a `checksum` equal to [`checksum::BLANK`].
///
/// # Panics
/// If two tensors have the same name, or the number of bytes of a tensor does not match its shape.
pub(crate) fn write(kind: Kind, metadata: &impl Serialize, tensors: &[(&str, Written<'_>)]) -> Vec<u8> {
    let json = serde_json::to_string(metadata).expect("strings and numbers are JSON");
    let metadata = std::iter::once((kind.entry.to_owned(), json)).collect();
    let views = tensors.iter().map(|(name, tensor)| (*name, tensor));
    let mut file = safetensors::serialize(views, Some(metadata)).expect("tensors have distinct names");
    checksum::enter(&mut file);
    file
}
