//! Builds the WASM package.
#![forbid(unsafe_code)]

fn main() {}
