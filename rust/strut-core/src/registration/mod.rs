//! Finds the frames of differently styled clips of an action that show the same instant (`docs/methods/mar.md` §4).
//!
//! Every example becomes a sequence of feature vectors (`features`) and is divided into segments: gait cycles for
//! actions that walk or run (`gait`), otherwise the clip from its first motion to its last (`rest`). Segments are
//! matched by a slope-limited time warp (`dtw`, `imw` or linear time; parts of an action that only one clip
//! contains are skipped at a cost): once to the action's reference cycle, which gives canonical time (`timeline`),
//! and once to the segments of every style that fit best, which gives counterparts (`pairing`). Known correspondence
//! (`script`) replaces all of this.

mod addition;
mod comparison;
mod dtw;
mod example;
mod features;
mod gait;
mod imw;
mod job;
mod matching;
mod options;
mod outcome;
mod pairing;
mod rest;
mod run;
mod script;
mod timeline;
mod warp;

pub use addition::Addition;
pub use comparison::{Compared, Comparison, Stretch};
pub use example::Example;
pub use job::Job;
pub use options::{MAX_COUNTERPARTS, Options, WarpMethod};
pub use outcome::{Counterpart, Counterparts, CycleFault, FaultyCycle, Method, Outcome, Refusal, Registered};
pub use run::Registration;
pub(crate) use timeline::time_steps;

#[cfg(test)]
mod tests;
