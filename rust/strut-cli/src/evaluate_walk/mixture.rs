//! Weights of mixed styles, and the length of the walks that are measured.

use strut_core::hsmm::WalkModel;

/// Steps of the walks that are measured: a frame more or less counts little in so many.
pub(super) const STEPS: u64 = 100;

/// Weights of one style, or of two.
pub(super) fn weights(model: &WalkModel, of: &[(usize, f32)]) -> Vec<f32> {
    let mut weights = vec![0.0; model.styles.len()];
    for &(style, weight) in of {
        weights[style] += weight;
    }
    weights
}
