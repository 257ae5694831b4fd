//! Common parts of the packages for JavaScript: errors as values, poses as flat arrays, files, and panics with their
//! messages.
//!
//! JavaScript owns every object and frees it. Arrays are copied once per call in either direction, so that no view of a
//! package's memory outlives a call. An invalid file or argument is thrown as an [`EngineError`]. A panic, which is a
//! bug, is thrown as a JavaScript `Error` with its message; the instance must then be discarded.

mod bytes;
mod crowd;
mod database;
mod error;
mod panic;
mod poses;
#[cfg(any(feature = "character", feature = "live"))]
mod skeleton;

pub use bytes::{Bytes, SlicedFile, Slices};
#[cfg(any(feature = "crowd", feature = "performers"))]
pub(crate) use crowd::crowd_handle;
pub use crowd::{frames_of_crowd, points_of_route, vertices_of_field};
pub use database::read_database;
pub use error::{EngineError, sentence};
pub use poses::{bvh_of, floats_of, offsets_of, poses_of, proportions_of, write_floats};
#[cfg(any(feature = "character", feature = "live"))]
pub(crate) use skeleton::skeleton_of;
