//! Motion style transfer: pure algorithms over plain data.
//!
//! No files, clocks, threads, browser or GPU. Units are metres, seconds and radians; +Y is up, right-handed. Every function
//! returns the same bits natively and in WebAssembly: transcendental functions are called through [`math::float_funcs`],
//! reductions have a fixed order, nothing contracts to FMA.
#![deny(unsafe_code)]

// The fixtures are shared with `strut-motion-evaluation`.
#[cfg(test)]
extern crate self as strut_core;

pub mod autoregression;
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
pub mod motion_statistics;
pub mod note;
pub mod parallel;
pub mod pose_vector;
pub mod registration;
pub mod retarget;
mod root_path;
mod rotation_row;
pub mod search;
pub mod skeleton;
pub mod somn;
pub mod stream;
pub mod transfer;
