//! Conversion between bytes and core types, with documented limits; no file system.
#![forbid(unsafe_code)]

pub mod bvh;
pub mod container;
pub mod corpus;
mod counted;
pub mod joints;
pub mod key_style_model;
mod quotation;
pub mod reading;
pub mod strutdb;
pub mod style_keys;
#[cfg(feature = "vmc")]
pub mod vmc;
pub mod walk_model;

pub use counted::counted;
pub use quotation::{quotation, shown_number};

/// Program and version, as recorded in files that Strut writes.
pub const GENERATOR: &str = concat!("strut ", env!("CARGO_PKG_VERSION"));
