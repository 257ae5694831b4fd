//! Built-in procedural motions. They are synthesised because no recorded motion may be distributed.
//!
//! The feet are planned first: a [`Script`] specifies speed and turns, a [`Style`] the movement. Together they define a
//! path with footprints. Feet roll over their prints and swing between them, the pelvis travels above them, legs are
//! solved in between, trunk and arms follow published gait curves. Every style performs the same script, so that frames
//! of equal script phase are exact counterparts.
//!
//! Deterministic: the same arguments give the same bits on every platform.
#![forbid(unsafe_code)]

mod action;
pub mod benchmark;
mod database;
mod drill;
mod drills;
mod drive;
mod feet;
pub mod forms;
mod full;
mod interlude;
mod jet;
mod keys;
pub mod measure;
mod noise;
mod normative;
mod path;
mod pelvis;
mod perform;
mod periodic;
mod script;
mod smoothing;
mod style;
mod styles;
mod takes;
mod upper_body;

pub use action::Action;
pub use database::{
    Counterpart, NamedMotion, RATE_HZ, clips, counterpart, database, database_without, first_walk_database,
    input_clips, walk_database, walk_input,
};
pub use drill::{Drill, Move, keys_of, perform_drill};
pub use drills::{JUMPS, KICKS, PUNCHES};
pub use drive::driving_database;
pub use full::{FULL_RATE_HZ, PlannedClip, TABLE_1, full_clips, full_database};
pub use interlude::{Interlude, perform_interlude};
pub use normative::{Band, WALKING_BANDS};
pub use perform::{Excursion, Performance, Transition, perform, perform_excursion, perform_transition};
pub use script::{Passage, Script};
pub use style::Style;
pub use styles::STYLES;
pub use takes::{INPUT_TAKES, INTERLUDES, RUN_TAKES, TRANSITIONS, WALK_TAKES};
