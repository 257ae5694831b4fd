//! Style transfer: Xia, Wang, Chai, Hodgins, "Realtime Style Transfer for Unlabeled Heterogeneous Human
//! Motion", 2015, with the decisions in `docs/methods/mar.md`.
//!
//! A [`Model`] is shared by all characters, a [`Stylizer`] styles one character's stream of frames, and
//! [`stylize_clip`] a whole clip.

mod bias;
mod blend;
mod body_part;
mod class_weights;
mod clip;
mod clip_footplant;
mod clip_input;
mod clip_search;
mod coherence;
mod contact_likelihood;
mod ensemble;
mod examples;
mod familiarity;
mod footplant;
mod found;
mod frame;
mod input;
mod input_guard;
mod input_stream;
mod joint_limits;
mod lens;
mod mar;
mod model;
mod options;
mod output;
mod phase_lock;
mod regression;
mod stylizer;
mod target_tables;
mod timing;
mod trained;
mod travel;

pub use blend::{MAX_WEIGHT, StyleError};
pub use body_part::{BodyPart, PARTS};
pub use clip::{ClipJob, Resampled, StyledMotion, stylize_clip};
pub use clip_input::ClipInput;
pub use clip_search::ClipSearch;
pub use ensemble::{FADE_FRAMES, Performer, Predictions, PredictionsError, Recorder};
pub use examples::Examples;
pub use familiarity::Familiarity;
pub use footplant::{Footplant, ground_clearance};
pub use found::{Found, FoundFrame};
pub use frame::{NoClock, Stage, StageClock, StyledFrame, Trace, TracedNeighbour};
pub use joint_limits::beyond_anatomy;
pub use lens::{
    ClassDistance, Contacts, Fit, FitSettings, Lens, LensError, QueryChange, Timing, Warps, WeightedNeighbour,
};
pub use model::Model;
pub use options::{MAX_K, Method, Options, OptionsError};
pub use regression::MAX_FEEDBACK;
pub use stylizer::Stylizer;
pub use trained::{PredictedFrame, Predictor, PredictorInput, TrainedMethod, Training};
