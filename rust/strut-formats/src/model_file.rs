//! The container of models: a [safetensors](https://github.com/huggingface/safetensors) file of f32 tensors, whose metadata have
//! one entry, a JSON object with a `version`.

use safetensors::SafeTensors;
use safetensors::tensor::{Dtype, TensorView};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use strut_core::humanoid::JOINTS;
use strut_core::math::Quat;
use thiserror::Error;

/// A kind of model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ModelKind {
    /// What people call it.
    pub name: &'static str,
    /// The metadata entry.
    pub entry: &'static str,
    /// Version that is written, and whose major part is read.
    pub version: &'static str,
    /// Most bytes a file may have.
    pub max_bytes: usize,
}

/// Why bytes are no model of a kind.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[allow(missing_docs)]
pub enum ModelFileError {
    /// Above [`ModelKind::max_bytes`].
    #[error("the file has {bytes} bytes; a {} has at most {}", kind.name, kind.max_bytes)]
    TooManyBytes { kind: ModelKind, bytes: usize },
    /// No safetensors file, or a damaged one.
    #[error("this is no {}, or it is cut short: {reason}", kind.name)]
    NotSafetensors { kind: ModelKind, reason: String },
    /// A safetensors file of another kind.
    #[error("this safetensors file is no {}: it has no '{}' metadata", kind.name, kind.entry)]
    NoMetadata { kind: ModelKind },
    /// The metadata are no JSON of the expected form.
    #[error("the {}'s metadata cannot be read: {reason}", kind.name)]
    Metadata { kind: ModelKind, reason: String },
    /// Another major version.
    #[error("the {} has version {version}; this Strut reads version {}", kind.name, kind.version)]
    Version { kind: ModelKind, version: String },
    /// A tensor is absent, or has another type or shape.
    #[error("tensor '{name}' is {found}; f32 {expected:?} was expected")]
    Tensor { name: &'static str, found: String, expected: Vec<usize> },
    /// A number that cannot be.
    #[error("'{name}' holds {value}; {expected} was expected")]
    Value { name: &'static str, value: String, expected: &'static str },
}

/// The part of the metadata that all kinds have.
#[derive(Deserialize)]
struct Versioned {
    version: String,
}

/// A tensor to be written: its name, shape, and as many numbers as that says.
pub(crate) type Tensor<'a> = (&'a str, Vec<usize>, Vec<f32>);

/// The file of a model.
pub(crate) fn write(kind: ModelKind, metadata: &impl Serialize, tensors: Vec<Tensor<'_>>) -> Vec<u8> {
    let bytes: Vec<(&str, Vec<usize>, Vec<u8>)> = tensors
        .into_iter()
        .map(|(name, shape, values)| (name, shape, values.iter().flat_map(|v| v.to_le_bytes()).collect()))
        .collect();
    let views = bytes.iter().map(|(name, shape, bytes)| {
        (*name, TensorView::new(Dtype::F32, shape.clone(), bytes).expect("as many bytes as the shape says"))
    });
    let json = serde_json::to_string(metadata).expect("strings and numbers are JSON");
    let metadata = std::iter::once((kind.entry.to_owned(), json)).collect();
    safetensors::serialize(views, Some(metadata)).expect("tensors have distinct names")
}

/// The metadata of a file, and its tensors.
pub(crate) fn open<M: DeserializeOwned>(kind: ModelKind, file: &[u8]) -> Result<(M, Tensors<'_>), ModelFileError> {
    if file.len() > kind.max_bytes {
        return Err(ModelFileError::TooManyBytes { kind, bytes: file.len() });
    }
    let bad = |e: safetensors::SafeTensorError| ModelFileError::NotSafetensors { kind, reason: e.to_string() };
    let (_, header) = SafeTensors::read_metadata(file).map_err(bad)?;
    let json = header.metadata().as_ref().and_then(|m| m.get(kind.entry));
    let json = json.ok_or(ModelFileError::NoMetadata { kind })?;
    let unread = |e: serde_json::Error| ModelFileError::Metadata { kind, reason: e.to_string() };
    let Versioned { version } = serde_json::from_str(json).map_err(unread)?;
    let major = |v: &str| v.split('.').next().and_then(|major| major.parse::<u32>().ok());
    if major(&version) != major(kind.version) {
        return Err(ModelFileError::Version { kind, version: version.chars().take(20).collect() });
    }
    let metadata = serde_json::from_str(json).map_err(unread)?;
    Ok((metadata, Tensors(SafeTensors::deserialize(file).map_err(bad)?)))
}

/// The tensors of a file.
pub(crate) struct Tensors<'a>(SafeTensors<'a>);

impl Tensors<'_> {
    /// Rows of a tensor: its first dimension, 0 where there is none.
    pub(crate) fn rows(&self, name: &str) -> usize {
        self.0.tensor(name).ok().and_then(|tensor| tensor.shape().first().copied()).unwrap_or_default()
    }

    /// The finite numbers of a tensor of this shape.
    pub(crate) fn numbers(&self, name: &'static str, expected: &[usize]) -> Result<Vec<f32>, ModelFileError> {
        let wrong = |found: String| ModelFileError::Tensor { name, found, expected: expected.to_vec() };
        let tensor = self.0.tensor(name).map_err(|_| wrong("absent".to_owned()))?;
        if tensor.dtype() != Dtype::F32 || tensor.shape() != expected {
            return Err(wrong(format!("{:?} {:?}", tensor.dtype(), tensor.shape())));
        }
        let values = tensor.data().as_chunks().0.iter().map(|bytes| f32::from_le_bytes(*bytes)).collect();
        all(name, values, f32::is_finite, "a finite number")
    }

    /// [`Tensors::numbers`] that are above zero.
    pub(crate) fn positive(&self, name: &'static str, expected: &[usize]) -> Result<Vec<f32>, ModelFileError> {
        all(name, self.numbers(name, expected)?, |v| v > 0.0, "a positive number")
    }

    /// A rotation for every joint.
    pub(crate) fn rotations(&self, name: &'static str) -> Result<[Quat; JOINTS], ModelFileError> {
        let numbers = self.numbers(name, &[JOINTS, 4])?;
        let rotations: [Quat; JOINTS] = std::array::from_fn(|j| {
            let [x, y, z, w] = std::array::from_fn(|i| numbers[4 * j + i]);
            Quat::from_xyzw(x, y, z, w)
        });
        match rotations.iter().find(|q| (q.dot(**q) - 1.0).abs() > 1e-3) {
            Some(q) => Err(value(name, format!("{:?}", q.to_array()), "a unit quaternion")),
            None => Ok(rotations.map(Quat::normalized)),
        }
    }
}

/// A number, or several, that cannot be.
pub(crate) fn value(name: &'static str, value: String, expected: &'static str) -> ModelFileError {
    ModelFileError::Value { name, value, expected }
}

fn all(
    name: &'static str,
    values: Vec<f32>,
    is: fn(f32) -> bool,
    expected: &'static str,
) -> Result<Vec<f32>, ModelFileError> {
    match values.iter().find(|v| !is(**v)) {
        Some(v) => Err(value(name, v.to_string(), expected)),
        None => Ok(values),
    }
}
