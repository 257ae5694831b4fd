//! Motion style transfer: pure algorithms over plain data.
//!
//! A [`Database`] of registered motion in several styles becomes a [`Model`], which is shared by all characters. A
//! [`Stylizer`] styles one character's stream of poses:
//!
//! ```
//! use std::sync::Arc;
//! use strut_core::{Model, Options, Stylizer};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! // Built-in motions; `database::build` builds databases from recordings, which `strut-motion-formats` reads.
//! let database = strut_demo::benchmark::database(5000)?;
//! let mut weights = vec![0.0; database.styles.len()];
//! weights[usize::from(database.style_index("proud").ok_or("no such style")?)] = 1.0;
//!
//! let model = Arc::new(Model::new(database));
//! let mut stylizer = Stylizer::new(model, Options::DEFAULT)?;
//! stylizer.set_styles(&weights)?;
//!
//! let walk = &strut_demo::benchmark::queries()[0].motion;
//! for pose in &walk.poses[..60] {
//!     let frame = stylizer.push(pose);
//!     assert!(frame.pose.is_finite());
//! }
//! # Ok(())
//! # }
//! ```
//!
//! `examples/stylize_bvh.rs` of `strut-motion-formats` styles a file. A file's skeleton is bound to the canonical humanoid by
//! a [`Binding`]; [`retarget`] converts motion in both directions.
//!
//! No files, clocks, threads, browser or GPU. Units are metres, seconds and radians; +Y is up, right-handed. Every function
//! returns the same bits natively and in WebAssembly: transcendental functions are called through [`math::float_funcs`],
//! reductions have a fixed order, nothing contracts to FMA.
#![deny(unsafe_code)]

// The fixtures are shared with `strut-motion-evaluation`.
#[cfg(test)]
extern crate self as strut_core;

pub mod catalogue;
pub mod contact;
pub mod crowd;
pub mod database;
pub mod driving;
#[cfg(test)]
mod fixtures;
pub mod hsmm;
pub mod humanoid;
pub mod incremental;
pub mod kinematics;
pub mod math;
pub mod metrics;
pub mod motion;
pub mod note;
pub mod parallel;
pub mod pose_vector;
pub mod registration;
pub mod retarget;
pub mod search;
pub mod skeleton;
pub mod somn;
pub mod stream;
pub mod transfer;

pub use database::Database;
pub use humanoid::{HumanoidMotion, Pose, Proportions};
pub use math::Quat;
pub use retarget::Binding;
pub use skeleton::Skeleton;
pub use transfer::{Model, Options, Stylizer};
