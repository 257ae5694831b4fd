//! Live streams: somebody's motion as it arrives over a network, styled while it goes on
//! (`../shared/spec/live-driving.md`, part B). Nothing here has a clock or a socket: times are arguments.
//!
//! A [`JitterBuffer`] makes an even stream of frames that come unevenly, late, twice or never; a [`LiveStylizer`] styles
//! it and keeps the [`LiveFigure`] where the performer is; [`LiveFloor`] says where the ground is; [`LandmarkFit`] makes
//! poses of the landmarks of a camera.

mod buffer;
mod figure;
mod floor;
mod landmarks;
mod live;
mod one_euro;
mod place;

pub use buffer::{Arrival, BufferStats, Delay, JitterBuffer, MAX_DELAY_SECS, Play, Played};
pub use figure::LiveFigure;
pub use floor::LiveFloor;
pub use landmarks::{LANDMARKS, Landmark, LandmarkFit};
pub use live::LiveStylizer;
pub use place::Place;
