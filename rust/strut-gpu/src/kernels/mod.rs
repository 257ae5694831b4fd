//! Shaders, each beside its twin for the processor.

pub(crate) mod atlas;
#[cfg(not(target_family = "wasm"))]
pub(crate) mod distances;
#[cfg(not(target_family = "wasm"))]
pub(crate) mod select;
#[cfg(test)]
mod tests;
