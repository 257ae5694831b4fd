//! Bytes to core types and back, with stated limits; no file system.
#![forbid(unsafe_code)]

pub mod bvh;
pub mod corpus;
pub mod strutdb;
pub mod walk_model;
