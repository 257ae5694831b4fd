//! Key-styling. Its package is loaded with the Key-style view.

mod drag_character;
mod frame;
mod learning;
mod measure;
mod mode;
mod model;
mod styling;

pub use drag_character::DragCharacter;
pub use learning::Somn;
pub use measure::{CheckedMeasure, check_measure};
pub use model::KeyStyleModel;
pub use styling::Styling;
