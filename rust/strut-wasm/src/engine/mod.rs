//! The engine: databases, inputs, stylizers and whole clips.

#[cfg(feature = "atlas")]
mod atlas;
#[cfg(feature = "bench")]
mod bench;
#[cfg(feature = "files")]
mod clip_job;
#[cfg(feature = "compare")]
mod counterpart;
mod database;
#[cfg(feature = "files")]
mod database_file;
mod input;
#[cfg(feature = "files")]
mod input_file;
#[cfg(feature = "learn")]
mod learn;
#[cfg(feature = "files")]
mod motion_facts;
#[cfg(feature = "motions")]
mod motions;
#[cfg(feature = "neutral-clips")]
mod neutral_clips;
mod packed_motions;
#[cfg(feature = "parity")]
mod parity;
mod poses;
#[cfg(feature = "recording")]
mod recording;
#[cfg(feature = "compare")]
mod search_comparison;
mod stylizer;

#[cfg(feature = "atlas")]
pub use atlas::Atlas;
#[cfg(feature = "bench")]
pub use bench::{Naive, Workload, input_of, joint_weights, leg_joints, positions_of, rows_of, stage_names};
#[cfg(feature = "files")]
pub use clip_job::ClipJob;
#[cfg(feature = "compare")]
pub use counterpart::Counterpart;
pub use database::Database;
pub use input::Input;
#[cfg(feature = "files")]
pub use input_file::FileRead;
#[cfg(feature = "learn")]
pub use learn::{ComparedCycles, Fit, FrameContacts, FrameTiming, Lens, NearestWindows, Warps};
#[cfg(feature = "files")]
pub use motion_facts::MotionFacts;
#[cfg(feature = "motions")]
pub use motions::{built_in_motions, driving_motions};
pub use packed_motions::PackedMotions;
#[cfg(feature = "parity")]
pub use parity::ParityReport;
pub use poses::interpolate_poses;
#[cfg(feature = "recording")]
pub use recording::Recording;
#[cfg(feature = "compare")]
pub use search_comparison::SearchComparison;
pub use stylizer::Stylizer;
