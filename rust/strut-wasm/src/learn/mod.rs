//! What the lessons see of a transfer: `strut_core::transfer::Lens` and `Warps` behind handles.

mod held_out;
mod lens;
mod warps;

pub use lens::{Fit, FrameContacts, FrameTiming, Lens, NearestWindows};
pub use warps::{ComparedCycles, Warps};
