//! Key-styling: Wang, Liu, Zhou, "Key-styling: Learning Motion Style for Real-time Synthesis of 3D Animation", 2006, with the
//! corrections in `docs/methods/somn.md`.
//!
//! A style is one to three scalar measures, such as the height of the hips; the model maps it to a full pose. [`Measure`]s of
//! recorded poses define its axes. [`Trainer`] learns a self-organising mixture of linear maps from style to pose from
//! [`Recording`]s, each map with its region of styles. [`Synthesis`] returns the pose of a style, [`DragCharacter`] that of a
//! style that is dragged interactively, [`KeyStyling`] a motion from a few styles over time.
//!
//! Poses are modelled at [`RATE_HZ`] in a frame that faces forward; the place of the body on the floor is not modelled.

mod diagnosis;
mod drag_character;
mod em;
mod expression;
mod flight;
mod frame;
mod key_styling;
mod learning;
mod measure;
mod mixture;
mod model;
mod named_measures;
mod pose_space;
mod recorded_styles;
mod recording;
mod spline;
mod synthesis;
mod training;

pub use drag_character::DragCharacter;
pub use expression::{ExpressionError, Fault};
pub use frame::Frame;
pub use key_styling::{Key, KeyStyling, KeysError, MAX_SECS, Method};
pub use learning::Update;
pub use measure::Measure;
pub use mixture::{Component, MAX_AXES, Style};
pub use model::{ClipSpan, KeyStyleModel};
pub use named_measures::{NamedMeasure, Unit};
pub use pose_space::{DIMS, PoseSpace, Row};
pub use recording::{Recording, RecordingError};
/// Parts of training, for evaluations of it (`strut-motion-evaluation`).
#[doc(hidden)]
pub mod parts {
    pub use super::mixture::{Gate, log_likelihood};
    pub use super::pose_space::angles;
}
pub use spline::Interpolation;
pub use synthesis::{BLUR, Mode, ModeError, Synthesis, TEMPERATURE};
pub use training::{EM_RIDGE, Learning, MAX_COMPONENTS, Options, SEED, TrainError, TrainProgress, Trainer, train};

/// Frames per second of all training recordings and of motions from keys.
pub const RATE_HZ: f32 = 30.0;

#[cfg(test)]
mod tests;
