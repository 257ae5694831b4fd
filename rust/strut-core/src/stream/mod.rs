//! Live streams: motion that is styled while it arrives over a network. Nothing here has a clock or a socket: times are
//! arguments.
//!
//! A [`JitterBuffer`] turns frames that arrive irregularly, late, twice or never into a regular stream. A [`LiveStylizer`]
//! styles it and keeps the [`LiveFigure`] near the performer. [`LiveFloor`] estimates the height of the ground.
//! [`LandmarkFit`] converts the landmarks of a camera to poses.

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
