//! The built-in procedural motions.
#![forbid(unsafe_code)]
