//! The database file, `.strutdb`: a [safetensors](https://github.com/huggingface/safetensors) container.
//!
//! Tensors, little-endian; N frames of all clips, D = [`DOFS`] degrees of freedom, J = [`JOINTS`] joints,
//! S styles, M ≤ 8 counterparts:
//!
//! | Name | Shape | Type | Content |
//! | --- | --- | --- | --- |
//! | `pose` | N, D | f32 | degrees of freedom; their names are `pose_columns` of the metadata |
//! | `point_cloud` | N, J, 3 | f32 | heading-free joint positions, metres |
//! | `canonical_time` | N | f32 | time on the canonical timeline, canonical frames |
//! | `time_step` | N | f32 | seconds per canonical frame |
//! | `contact` | N, 2 | u8 | whether the left and right foot is planted |
//! | `class_of_clip` | clips, 2 | u16 | indices of action and style |
//! | `counterpart` | N, S, M | f32 | registered frames of each style; −1 where there is none |
//! | `chart` | J, 4 | f32 | mean rotations x y z w: centres of the exponential maps |
//! | `search_order` | W | u32 | rows at which windows end, near ones together; may be absent |
//! | `search_basis` | 2, L | f32 | mean and principal directions of windows by both metrics; may be absent |
//! | `search_points` | 2, W, 40 | i16 | where the windows lie by these directions; may be absent |
//!
//! The last three are a [`Plan`] of the search index, of the version `search_version` of the metadata. They save the time
//! to make one; searches find the same without.
//!
//! Further tensors are ignored. The metadata entry `strut` is a JSON object; see [`Metadata`] for its
//! fields. In Python:
//!
//! ```python
//! import json, safetensors
//! with safetensors.safe_open("cast.strutdb", "numpy") as f:
//!     info, pose = json.loads(f.metadata()["strut"]), f.get_tensor("pose")
//! ```
//!
//! `checksum` is the CRC-32 (that of zlib and PNG) of the whole file with the checksum's own eight
//! hexadecimal digits replaced by zeros, so that every changed byte is noticed.
//!
//! [`DOFS`]: strut_core::pose_vector::DOFS
//! [`JOINTS`]: strut_core::humanoid::JOINTS
//! [`Plan`]: strut_core::search::Plan

mod checksum;
mod crc32;
mod metadata;
pub mod packed;
mod read;
mod source;
mod write;

pub use metadata::{ClipInfo, Metadata, SkeletonInfo};
pub use read::{Contents, read, read_metadata};
pub use source::Source;
pub use write::write;

use strut_core::database::DatabaseError;
use thiserror::Error;

/// Most bytes a file may have: 1 GiB.
pub const MAX_BYTES: usize = 1 << 30;
/// Most clips a database may have.
pub const MAX_CLIPS: usize = 100_000;
/// Program and version, as files that Strut writes record it.
pub const GENERATOR: &str = concat!("strut ", env!("CARGO_PKG_VERSION"));
/// Version that is written, and whose major part is read.
pub const VERSION: &str = "1.0";

/// Why bytes are no database.
#[derive(Clone, Debug, PartialEq, Error)]
#[allow(missing_docs)]
pub enum StrutdbError {
    /// Above [`MAX_BYTES`].
    #[error("the file has {bytes} bytes; at most {MAX_BYTES} are supported")]
    TooManyBytes { bytes: usize },
    /// No safetensors header, or a damaged one.
    #[error("this is no Strut database, or its beginning is damaged; a safetensors header was expected")]
    NotSafetensors,
    /// No packed motions ([`packed`]).
    #[error("these are no packed motions, or their beginning is damaged")]
    NotPacked,
    /// The tensors do not fill the file exactly.
    #[error("the file is cut short or damaged: its length does not agree with its header")]
    Length,
    /// A safetensors file of another kind.
    #[error("this safetensors file is no Strut database: it has no 'strut' metadata")]
    NoMetadata,
    /// The metadata are no JSON of the expected form.
    #[error("the database's metadata cannot be read: {0}")]
    Metadata(String),
    /// Another major version.
    #[error("the database has version {found}; this Strut reads version {}", VERSION)]
    Version { found: String },
    /// Bytes were changed.
    #[error("the database is damaged: its checksum is {found}, its bytes give {computed}")]
    Checksum { found: String, computed: String },
    /// The skeleton is not the canonical humanoid, or the columns of `pose` are others.
    #[error("the database's {0} differ from those of this Strut")]
    Layout(&'static str),
    /// A tensor is absent.
    #[error("the database has no tensor '{0}'")]
    MissingTensor(&'static str),
    /// A tensor has another type or shape.
    #[error("tensor '{name}' is {found}; {expected} was expected")]
    Tensor { name: &'static str, found: String, expected: String },
    /// The content is not consistent.
    #[error("the database is not consistent: {0}")]
    Content(#[from] DatabaseError),
}
