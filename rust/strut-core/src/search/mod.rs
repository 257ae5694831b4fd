//! Exact search for the stored windows that are nearest to the last frames of the input.
//!
//! A window ends at a row and contains it and the rows before it in the same clip, [`WINDOW`] in total; no window ends
//! at the first rows of a clip. Rows are stored once, in a frame of reference of their clip that is computed by
//! integrating the rows' velocities and turn rates, so that overlapping windows share them.

mod atlas;
mod block;
mod brute_force;
mod index;
mod lanes;
mod leaves;
mod metric;
mod neighbours;
mod order;
mod packed;
mod plan;
mod points;
mod principal;
mod profile;
mod raw;
mod subspace;
mod windows;

pub use atlas::{Atlas, AtlasView, NearestOfLine, nearest_placement};
pub use index::{CandidateSource, Index, Query, Scratch};
pub use metric::{MAX_WINDOW, Metric, QueryWindow, WINDOW};
pub use neighbours::{Neighbour, Neighbours};
pub use packed::{
    BodyPart, FAR, PACKED_JOINTS, PACKED_ROW, PACKED_TILE, PACKED_WINDOW, PackedClass, PackedQuery, PackedRow,
    PackedWindow, PackedWindows, TRAVEL,
};
pub use plan::{Plan, PlanError, PlanSource};
pub use points::JOINT_WEIGHTS;
pub(crate) use points::{FEET_ROLES, Feet};
pub use profile::Profile;
pub use raw::RawPoints;
pub(crate) use windows::{Places, Windows};

#[cfg(test)]
mod tests;
