//! Database file, `.strutdb`: a [container](crate::container).
//!
//! Tensors are little-endian. There are N frames of all clips, D = 67 degrees of freedom ([`DOFS`]) and J = 21 joints
//! ([`JOINTS`]). S styles have M ≤ 8 counterparts each. The search index has W windows and bases of L = 3900 numbers
//! ([`Plan::BASIS_LENGTH`](strut_core::search::Plan::BASIS_LENGTH)).
//!
//! | Name | Shape | Type | Content |
//! | --- | --- | --- | --- |
//! | `pose` | N, D | f32 | degrees of freedom, see below; their names are `pose_columns` of the metadata |
//! | `point_cloud` | N, J, 3 | f32 | positions x y z of the joints, metres, without the heading, the hips above the origin |
//! | `canonical_time` | N | f32 | time on the canonical timeline, canonical frames |
//! | `time_step` | N | f32 | seconds per canonical frame |
//! | `contact` | N, 2 | u8 | whether the left and right foot is planted |
//! | `class_of_clip` | clips, 2 | u16 | indices of a clip's action and style in `actions` and `styles` |
//! | `counterpart` | N, S, M | f32 | registered rows of each style, fractions between two rows; −1 where there is none |
//! | `chart` | J, 4 | f32 | mean rotations x y z w: centres of the exponential maps |
//! | `search_order` | W | u32 | rows at which windows end, near ones adjacent; may be absent |
//! | `search_basis` | 2, L | f32 | mean and principal directions of windows by both metrics; may be absent |
//! | `search_points` | 2, W, 40 | i16 | coordinates of the windows along these directions; may be absent |
//!
//! The last three are a [`Plan`] of the search index, of the version `search_version` of the metadata. They save the
//! time of building the index; search results do not depend on them.
//!
//! A row of `pose` starts with three numbers w for each joint, in the order of the skeleton. The rotation of the joint
//! relative to its parent is q · exp(w), with q the joint's row of `chart`. The length of w is the angle in radians.
//! The rotation of the hips does not include the heading. Four numbers follow: the height of the hips (m), their
//! velocity to the left and forward in the frame of the heading (m/s), and the turn rate of the heading (rad/s),
//! positive to the left. The axis +Y is up, and a body whose heading is 0 faces +Z with its left at +X.
//!
//! Further tensors are ignored. The metadata entry `strut` is a JSON object; see [`Metadata`] for its fields.
//! `examples/python/strutdb_file.py` reads a file without Strut.
//!
//! [`DOFS`]: strut_core::pose_vector::DOFS
//! [`JOINTS`]: strut_core::humanoid::JOINTS
//! [`Plan`]: strut_core::search::Plan

mod metadata;
pub mod packed;
mod read;
mod write;

pub use metadata::{ClipInfo, Metadata, SkeletonInfo};
pub use read::{Contents, STYLES, read, read_catalogue, read_metadata};
pub use write::write;

use crate::container::{ContainerError, Kind};
use strut_core::database::DatabaseError;
use thiserror::Error;

/// Greatest number of clips of a database.
pub const MAX_CLIPS: usize = 100_000;
/// The kind of file.
pub const KIND: Kind = Kind {
    name: "Strut database",
    entry: "strut",
    version: "1.0",
    checksum_since: 0,
    // The largest size that the JavaScript packages can represent.
    max_bytes: u32::MAX as usize,
};

const fn megabytes(bytes: u64) -> u64 {
    bytes / 1_000_000
}

/// Reason why bytes are not a database.
#[derive(Clone, Debug, PartialEq, Error)]
#[allow(missing_docs)]
pub enum StrutdbError {
    /// The container is of another kind or damaged.
    #[error(transparent)]
    File(#[from] ContainerError),
    /// The file does not contain packed motions ([`packed`]).
    #[error("these are not packed motions, or their beginning is damaged")]
    NotPacked,
    /// The skeleton is not the canonical humanoid, or the columns of `pose` differ.
    #[error("the database's {0} differ from those of this release of Strut")]
    Layout(&'static str),
    /// Styling would take more memory than the caller allows or than is available.
    #[error(
        "the database has {frames} frames: styling needs {} MB of memory; {} available",
        megabytes(*needed), most.map_or("less is".to_owned(), |most| format!("{} MB are", megabytes(most)))
    )]
    Memory { frames: u64, needed: u64, most: Option<u64> },
    /// The content is not consistent.
    #[error("the database is not consistent: {0}")]
    Content(#[from] DatabaseError),
    /// The header is not consistent.
    #[error("the database is not consistent: {0}")]
    Header(String),
}
