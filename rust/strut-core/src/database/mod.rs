//! The offline database: registered (action × style) motion, to be built, stored and edited.
//!
//! Rows (frames) are sorted by class, an (action, style) pair, and within it by clip, so that a class is a contiguous
//! range of rows. The layout is that of the `.strutdb` file (`docs/reference/files.md`).

mod bimodal_styles;
pub mod build;
pub mod motion_statistics;
mod offline;
mod parts;
mod residual;
mod statistics;
mod validation;
mod without_clips;

pub use crate::registration::MAX_COUNTERPARTS;
pub use bimodal_styles::{BimodalStyle, bimodal_styles, statistics_of_takes};
pub use offline::Database;
pub use parts::{Class, Clip, DatabaseParts, PointCloud};
pub use residual::residuals;
pub(crate) use statistics::{RowSquares, RowSums, StepSums};
pub use validation::{DatabaseError, MAX_FRAMES};
pub(crate) use validation::{validate_point_clouds, validate_poses, validate_short_tensors, validated_classes};
