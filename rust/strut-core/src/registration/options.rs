//! Options of registration.

/// Greatest number of counterparts of a frame in a style.
pub const MAX_COUNTERPARTS: usize = 8;

/// Method of warping segments to each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum WarpMethod {
    /// Dynamic time warping of style-normalised features: the best in measurements (`docs/methods/mar.md` §4).
    #[default]
    Dtw,
    /// Iterative motion warping (Hsu et al. 2005), the paper's method.
    Imw,
    /// Linear time between the segment's ends: the baseline.
    Linear,
}

/// Options of registration. The defaults were chosen by measurements (`docs/methods/mar.md` §4).
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Method of warping segments.
    pub warp: WarpMethod,
    /// Number of counterparts of a frame in each style, 1 to 8; the target is their average. The best one gives an
    /// error of 1.84 cm, the best 3 give 1.77, the best 8 give 1.75.
    pub counterparts: usize,
    /// Number of segments of each style that are warped, chosen by their distance in linear time. Those of least cost
    /// become counterparts.
    pub candidates: usize,
}

impl Default for Options {
    fn default() -> Self {
        Self { warp: WarpMethod::Dtw, counterparts: MAX_COUNTERPARTS, candidates: 20 }
    }
}

impl Options {
    /// [`Options::counterparts`], clamped to its range.
    pub fn counterparts(&self) -> usize {
        self.counterparts.clamp(1, MAX_COUNTERPARTS)
    }
}
