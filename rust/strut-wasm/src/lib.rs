//! The core behind handles and typed arrays, for JavaScript; no algorithm.
//!
//! JavaScript owns every object and frees it. Arrays are copied once a call in either direction, so that no
//! view of this memory outlives a call. Errors are values ([`EngineError`]); a panic, which is a bug, ends
//! as a JavaScript exception with its message, and the instance must then be thrown away.

#[cfg(feature = "bench")]
mod bench;
mod clip_job;
#[cfg(feature = "compare")]
mod counterpart;
mod database;
mod error;
mod input;
#[cfg(feature = "parity")]
mod parity;
mod poses;
mod stylizer;

#[cfg(feature = "bench")]
pub use bench::{Naive, Workload, joint_weights, leg_joints, positions_of, rows_of, stage_names};
pub use clip_job::ClipJob;
#[cfg(feature = "compare")]
pub use counterpart::Counterpart;
pub use database::Database;
pub use error::EngineError;
pub use input::{Input, packed_inputs};
#[cfg(feature = "parity")]
pub use parity::ParityReport;
pub use poses::interpolate_poses;
pub use stylizer::Stylizer;

use wasm_bindgen::prelude::wasm_bindgen;

/// Makes a panic throw its message instead of the bare "unreachable" of a trap.
#[wasm_bindgen(start)]
fn throw_panics() {
    std::panic::set_hook(Box::new(|panic| wasm_bindgen::throw_str(&panic.to_string())));
}
