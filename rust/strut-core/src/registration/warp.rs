//! A warp: the frame of one sequence that corresponds to each frame of another.

use crate::math::gaussian::smoothed_with_fixed_ends;

/// Allowed differences between the ends of a segment and those of the frames to which it is warped.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Ends {
    /// The first frame may correspond to any of the first frames, up to this number after the very first.
    pub open_begin: usize,
    /// The last frame may correspond to any of the last frames, up to this number before the very last.
    pub open_end: usize,
    /// Cost of skipping a frame at either end of either sequence, up to a quarter of the shorter, in place of a
    /// distance; `None` forbids it. Skipped frames of the segment are warped beyond the other's ends: below 0 or after
    /// the last frame.
    pub skip: Option<f32>,
}

impl Ends {
    /// Any number of frames.
    pub(super) const OPEN: usize = usize::MAX;
}

/// Fractional frame of b for every frame of a, strictly increasing.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Warp {
    /// Frames of b.
    pub at: Vec<f32>,
    /// Mean cost per frame of a.
    pub cost: f32,
}

impl Warp {
    /// Linear time from `n` frames to the frames from `first` to `last`.
    pub(super) fn linear(n: usize, first: f32, last: f32, cost: f32) -> Self {
        let steps = n.saturating_sub(1).max(1) as f32;
        Self { at: (0..n).map(|i| first + (last - first) * (i as f32 / steps)).collect(), cost }
    }

    /// The warp smoothed over time; ends and order are kept.
    pub(super) fn smoothed(self, sigma_frames: f32) -> Self {
        Self { at: smoothed_with_fixed_ends(&self.at, sigma_frames), cost: self.cost }
    }

    /// Frame of b at a frame of a; outside a by linear extrapolation with the warp's mean slope.
    pub(super) fn extrapolated(&self, frame: isize) -> f32 {
        let last = self.at.len() as isize - 1;
        let inside = frame.clamp(0, last);
        let slope = (self.at[last as usize] - self.at[0]) / last.max(1) as f32;
        self.at[inside as usize] + slope * (frame - inside) as f32
    }
}
