//! The `strut` command: files, arguments, progress, printing; no algorithm.
#![forbid(unsafe_code)]

fn main() {}
