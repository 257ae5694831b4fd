//! Errors of reading a container.

use super::Kind;
use thiserror::Error;

/// Reason why bytes are not a file of a kind.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[allow(missing_docs)]
pub enum ContainerError {
    /// The file is larger than [`Kind::max_bytes`].
    #[error("the file has {bytes} bytes; a {} has at most {}", kind.name, kind.max_bytes)]
    TooManyBytes { kind: Kind, bytes: usize },
    /// The safetensors header is missing or damaged.
    #[error("this is not a {}, or its beginning is damaged; a safetensors header was expected", kind.name)]
    NotSafetensors { kind: Kind },
    /// The tensors do not fill the file exactly.
    #[error("the file is cut short or damaged: its length does not agree with its header")]
    Length,
    /// The safetensors file is of another kind.
    #[error("this safetensors file is not a {}: it has no '{}' metadata", kind.name, kind.entry)]
    NoMetadata { kind: Kind },
    /// The metadata are not JSON of the expected form.
    #[error("the {}'s metadata cannot be read: {reason}", kind.name)]
    Metadata { kind: Kind, reason: String },
    /// The file has another major version.
    #[error("the {} has version {found}; this release of Strut reads version {}", kind.name, kind.version)]
    Version { kind: Kind, found: String },
    /// The file was changed.
    #[error("the {} is damaged: its checksum is {found}, its bytes give {computed}", kind.name)]
    Checksum { kind: Kind, found: String, computed: String },
    /// A tensor is missing.
    #[error("the {} has no tensor '{tensor}'", kind.name)]
    MissingTensor { kind: Kind, tensor: &'static str },
    /// A tensor has another type or shape.
    #[error("tensor '{tensor}' is {found}; {expected} was expected")]
    Tensor { tensor: &'static str, found: String, expected: String },
    /// A number is out of range.
    #[error("'{name}' holds {value}; {expected} was expected")]
    Value { name: &'static str, value: String, expected: &'static str },
}

impl ContainerError {
    /// A number in a tensor or in the metadata is out of range.
    pub(crate) fn value(name: &'static str, value: impl ToString, expected: &'static str) -> Self {
        Self::Value { name, value: value.to_string(), expected }
    }
}
