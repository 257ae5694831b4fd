//! Style transfer: Xia, Wang, Chai, Hodgins, "Realtime Style Transfer for Unlabeled Heterogeneous Human
//! Motion", 2015, with the decisions of the specification in `docs/`.
//!
//! [`Model`] is what all characters share, [`Stylizer`] one character's stream of frames,
//! [`stylize_clip`] the same over a whole clip.

mod bias;
mod blend;
mod body_part;
mod clip;
mod clip_footplant;
mod coherence;
mod contact_likelihood;
mod examples;
mod footplant;
mod frame;
mod input_guard;
mod joint_limits;
mod mar;
mod mixture;
mod model;
mod options;
mod regression;
#[cfg(test)]
pub(crate) mod sine_walk;
mod sole;
mod stylizer;
mod timing;
#[cfg_attr(not(feature = "offline"), path = "untrained.rs")]
mod trained;

pub use blend::{MAX_WEIGHT, StyleError};
pub use body_part::{BodyPart, PARTS};
pub use clip::{ClipJob, Resampled, StyledMotion, stylize_clip};
pub use clip_footplant::plant_feet;
pub use examples::Examples;
pub use footplant::{Footplant, ground_clearance};
pub use frame::{NoClock, Stage, StageClock, StyledFrame, Trace, TracedNeighbour};
pub use joint_limits::beyond_anatomy;
pub use mixture::class_weights;
pub use model::Model;
pub use options::{MAX_K, Method, Options, OptionsError};
pub use regression::MAX_FEEDBACK;
pub use sole::{Sole, Soles};
pub use stylizer::Stylizer;
