//! A BVH file as the engine sees it.

use crate::failure::{Failure, Outcome};
use crate::files;
use std::path::Path;
use strut_core::database::Database;
use strut_core::motion::Motion;
use strut_core::retarget::Binding;
use strut_formats::bvh::{self, Bvh};
use strut_formats::strutdb;

/// A file, its motion, and which of its joints are which.
pub(crate) struct Clip {
    pub(crate) file: Bvh,
    pub(crate) motion: Motion,
    pub(crate) binding: Binding,
}

impl Clip {
    /// The clip in a file.
    pub(crate) fn read(path: &Path) -> Outcome<Self> {
        Self::parse(&files::read(path, bvh::MAX_BYTES)?).map_err(|reason| Failure::in_file(path, reason))
    }

    /// The clip in these bytes, or why there is none.
    pub(crate) fn parse(bytes: &[u8]) -> Result<Self, String> {
        let file = bvh::parse(bytes).map_err(|e| e.to_string())?;
        let motion = file.to_motion().map_err(|e| e.to_string())?;
        let binding = Binding::detect(&motion).map_err(|e| e.to_string())?;
        Ok(Self { file, motion, binding })
    }
}

/// The database in a file.
pub(crate) fn read_database(path: &Path) -> Outcome<Database> {
    strutdb::read(&files::read(path, strutdb::MAX_BYTES)?).map_err(|reason| Failure::in_file(path, reason))
}
