//! Shaders, each with its CPU twin.

pub(crate) mod atlas;
pub(crate) mod distances;
pub(crate) mod select;
#[cfg(test)]
mod tests;
