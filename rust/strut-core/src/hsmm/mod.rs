//! Walk synthesis: Tilmanne, Dutoit, "Continuous Control of Style and Style Transitions through Linear Interpolation in
//! Hidden Markov Model Based Walk Synthesis", 2012, with the decisions in `docs/methods/hsmm.md`.
//!
//! Steps of recorded walks ([`steps_of`]) train a hidden semi-Markov model of five states for either side; every style is a
//! set of its means ([`train`]). Means are added and scaled as vectors ([`WalkModel::mix`]), a banded system turns them into
//! a trajectory, and the supporting foot determines the path of the body ([`Walker`]).
//! Walks are modelled at [`RATE_HZ`]; degrees of freedom are exponential maps of the joints about their mean rotations.

mod adaptation;
mod alignment;
mod curve;
mod features;
mod joint_range;
mod landmarks;
mod mlpg;
mod model;
mod path;
mod refinement;
mod statistics;
mod steps;
mod training;
mod walker;
mod walks;

pub use crate::kinematics::rotation_row::{ROTATION_DIMS, RotationRow};
pub use curve::{CurvePoint, JointCurve};
pub use features::{Track, TrackError};
pub use landmarks::{landmarks, styles_named};
pub use model::{Observation, PerState, SIDES, STATES, Side, StyleMeans, WalkModel, flattened};
pub use path::{JointPath, MAX_RHO, PathError, PathOptions, VARIANCE_FACTOR};
pub use steps::{Step, steps_of};
pub use training::{LabelledClip, Options, TrainError, TrainProgress, Trainer, train};
pub use walker::{
    HORIZON, MAX_TRANSITIONS, MAX_TURN, MAX_WEIGHT, RuntimeWalkModel, STEP_FRAMES, STRIDE, Walker, WeightsError,
};
/// Parts of training and synthesis, for evaluations of them (`strut-motion-evaluation`).
#[doc(hidden)]
pub mod parts {
    pub use super::alignment::States;
    pub use super::features::row_of;
    pub use super::mlpg::{Banded, Choice, CostToGo, FrameState, FrameTerms, Number, Term};
    pub use super::model::Stream;
    pub use super::refinement::{Chain, chains};
    pub use super::statistics::{Sample, SharedVariances, Statistics, states, states_of};
}
pub use walks::{WALK, WalkError, walk_of, walking_action, walks_among};

/// Frames per second of every walk that is modelled (`docs/methods/hsmm.md` §2).
pub const RATE_HZ: f32 = 30.0;

#[cfg(test)]
pub(crate) mod tests;
