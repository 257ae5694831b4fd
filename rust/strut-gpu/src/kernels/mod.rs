//! Shaders, each beside its twin for the processor.

pub(crate) mod atlas;
pub(crate) mod distances;
pub(crate) mod select;
#[cfg(test)]
mod tests;
