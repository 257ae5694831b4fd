//! Container of database and model files: a [safetensors](https://github.com/huggingface/safetensors) file whose
//! metadata have one entry, a JSON object with `version`, `generator` and `checksum`.
//!
//! `checksum` is the CRC-32 (as in zlib and PNG) of the whole file, as eight hexadecimal digits in lower case. For its
//! computation these digits are replaced by the character 0, so that every changed byte is detected. Model files before
//! version 1.1 have no checksum.

mod checksum;
mod crc32;
mod error;
mod kind;
mod read;
mod source;
mod tensor;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod version_1_0;
mod write;

pub use error::ContainerError;
pub use kind::Kind;
pub use source::Source;

pub(crate) use checksum::BLANK;
pub(crate) use read::open;
pub(crate) use tensor::{Tensor, Tensors};
#[cfg(test)]
pub(crate) use version_1_0::version_1_0;
pub(crate) use write::{Written, floats, rounded, write};
