//! Baselines with training, for comparison: global autoregression, linear
//! time-invariant systems and Gaussian processes. (Nearest neighbour, KNN interpolation and the local
//! autoregression share the search and live beside the mixture in [`crate::transfer`].)
//!
//! All learn from the same pairs: rows of a database and their registered targets in one style. They are
//! reached through [`crate::transfer::Method`] like every other method; training happens when a style is
//! activated, once a model. Sums are in double precision. In the browser only the Compare view's package contains them.

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
    /// See [`global_ar`].
    GlobalAr,
    /// See [`lti`]: one system a degree of freedom.
    Lti,
    /// See [`lti`]: one system for the principal components of all.
    LtiJoint,
    /// See [`gp`].
    Gp,
}

impl Baseline {
    /// Whether what is trained depends on λ.
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
    /// yₜ₋₁; for the first frame a guess.
    pub(crate) previous_output: &'a PoseRow,
}

/// A predicted frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Prediction {
    /// yₜ.
    pub(crate) output: PoseRow,
    /// How long it lasts, seconds.
    pub(crate) step_secs: f32,
}

/// A method trained for one target style.
pub(crate) trait Predictor: Debug + Send + Sync {
    /// Numbers that [`Predictor::predict`] keeps from frame to frame.
    fn memory_len(&self) -> usize;

    /// Sets the memory to its value after the rows of `past`, the stored frames up to the one nearest to the first input.
    /// May be empty.
    fn start(&self, memory: &mut [f64], past: &[PoseRow]);

    /// Predicts the next frame. Allocates nothing.
    fn predict(&self, memory: &mut [f64], now: Now<'_>) -> Prediction;
}

#[cfg(test)]
mod tests;
