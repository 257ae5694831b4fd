//! JavaScript interface of the core: handles and typed arrays, no algorithms. For objects, arrays, errors and panics see
//! [`common`].
//!
//! Each package of the page is a build of this crate with the features of its modules (`scripts/wasm.mjs`).

pub mod common;

#[cfg(feature = "build")]
pub mod build;
#[cfg(feature = "character")]
pub mod character;
#[cfg(feature = "drive")]
pub mod drive;
#[cfg(feature = "engine")]
pub mod engine;
#[cfg(feature = "gpu")]
pub mod gpu;
#[cfg(feature = "key-style")]
pub mod key_style;
#[cfg(feature = "live")]
pub mod live;
#[cfg(feature = "performers")]
pub mod performers;
#[cfg(feature = "walk")]
pub mod walk;
