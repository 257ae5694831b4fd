//! Bytes to core types and back, with stated limits; no file system.
#![forbid(unsafe_code)]

pub mod bvh;
pub mod corpus;
pub mod key_style_model;
pub mod model_file;
pub mod strutdb;
pub mod style_keys;
pub mod walk_model;
