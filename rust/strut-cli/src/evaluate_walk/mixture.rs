//! Weights of mixed styles, and the length of the measured walks.

use strut_core::hsmm::WalkModel;

/// Number of steps of the measured walks, so many that one frame more or less hardly matters.
pub(super) const STEPS: u64 = 100;

/// Returns the weights of one style, or of two.
pub(super) fn weights(model: &WalkModel, of: &[(usize, f32)]) -> Vec<f32> {
    let mut weights = vec![0.0; model.styles.len()];
    for &(style, weight) in of {
        weights[style] += weight;
    }
    weights
}
