//! Baselines with training, for comparison: global autoregression, linear time-invariant systems and Gaussian
//! processes. (Nearest neighbour, KNN interpolation and the local autoregression use the search and are in
//! [`crate::transfer`].)
//!
//! All are trained on the same pairs: rows of a database and their registered targets in one style. They are selected
//! by [`crate::transfer::Method`] like every other method. They are trained when a style is activated, once for each
//! model. Sums are in double precision. In the browser only the package of the Compare view contains them.

mod gaussian_process;
mod global_ar;
mod gp;
mod lti;
mod memo;
mod pairs;
mod principal;
mod products;
mod subspace;

pub(crate) use memo::Baselines;
pub(crate) use pairs::Pairs;

use crate::pose_vector::PoseRow;
use std::fmt::Debug;

/// A trained method.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Baseline {
    /// Global autoregression ([`global_ar`]).
    GlobalAr,
    /// Linear systems ([`lti`]), one for each degree of freedom.
    Lti,
    /// A linear system ([`lti`]) for the principal components of all degrees of freedom.
    LtiJoint,
    /// Gaussian processes ([`gp`]).
    Gp,
}

impl Baseline {
    /// Returns whether the training depends on λ.
    pub(crate) fn has_ridge(self) -> bool {
        self == Self::GlobalAr
    }
}

/// Input of the prediction of a frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Now<'a> {
    /// xₜ.
    pub(crate) input: &'a PoseRow,
    /// xₜ₋₁.
    pub(crate) previous_input: &'a PoseRow,
    /// yₜ₋₁; an estimate for the first frame.
    pub(crate) previous_output: &'a PoseRow,
}

/// A predicted frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Prediction {
    /// yₜ.
    pub(crate) output: PoseRow,
    /// Duration of the frame, seconds.
    pub(crate) step_secs: f32,
}

/// A method trained for one target style.
pub(crate) trait Predictor: Debug + Send + Sync {
    /// Number of values that [`Predictor::predict`] keeps from frame to frame.
    fn memory_len(&self) -> usize;

    /// Sets the memory to its value after the rows of `past`, the stored frames up to the one nearest to the first
    /// input. `past` may be empty.
    fn start(&self, memory: &mut [f64], past: &[PoseRow]);

    /// Predicts the next frame. Allocates nothing.
    fn predict(&self, memory: &mut [f64], now: Now<'_>) -> Prediction;
}

#[cfg(test)]
mod tests;
