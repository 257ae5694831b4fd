//! Settings of registration.

/// Greatest number of counterparts of a frame in a style.
pub const MAX_COUNTERPARTS: usize = 8;

/// How segments are warped onto each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum WarpMethod {
    /// Dynamic time warping of style-normalised features: the best measured (`docs/methods/mar.md` §4).
    #[default]
    Dtw,
    /// Iterative motion warping (Hsu et al. 2005), the paper's choice.
    Imw,
    /// Linear time between the segment's ends: the baseline.
    Linear,
}

/// Settings of registration. The defaults were measured (`docs/methods/mar.md` §4).
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// How segments are warped.
    pub warp: WarpMethod,
    /// Counterparts of a frame in each style, 1 to 8; the target is their average. Best 1: 1.84 cm of
    /// error, best 3: 1.77, best 8: 1.75.
    pub counterparts: usize,
    /// Segments of each style that are warped, chosen by their distance in linear time; those of least cost
    /// become counterparts.
    pub candidates: usize,
}

impl Default for Options {
    fn default() -> Self {
        Self { warp: WarpMethod::Dtw, counterparts: MAX_COUNTERPARTS, candidates: 20 }
    }
}

impl Options {
    /// [`Options::counterparts`] within its range.
    pub fn counterparts(&self) -> usize {
        self.counterparts.clamp(1, MAX_COUNTERPARTS)
    }
}
