//! Inspection of a transfer for the lessons: handles of `strut_core::transfer::Lens` and `Warps`.

mod held_out;
mod lens;
mod warps;

pub use lens::{Fit, FrameContacts, FrameTiming, Lens, NearestWindows};
pub use warps::{ComparedCycles, Warps};
