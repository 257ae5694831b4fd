//! Mixture over classes: Eq. 3–5 and `docs/methods/mar.md` §7.

use crate::math::float_funcs::{exp, ln};

/// Floor of the distances, (1 mm)². Smaller distances are noise, and a single class would get all the weight.
const FLOOR: f32 = 1e-6;

/// Floor of the weights before normalisation, so that no class is lost by underflow.
const MIN_WEIGHT: f32 = 1e-30;

/// D at which `known` is one half, m²: (5 cm)². 95 % of held-out frames of the database's own performers are nearer,
/// and 6 % of other recordings.
const HALF_KNOWN: f32 = 0.05 * 0.05;

/// Factor of the mixture's width δ where the input is unknown: a mixture of more classes is smoother there. Inside the
/// database a narrow mixture is closer to the truth.
const WIDEST: f32 = 3.0;

/// Similarity of the input to the database, 0 to 1, by the mean squared distance of its nearest class, m².
pub(super) fn known(least: f32) -> f32 {
    known_by_half_at(HALF_KNOWN, least)
}

/// Similarity of the input to the database, 0 to 1, by a squared distance; one half at the distance `half`.
pub(super) fn known_by_half_at(half: f32, distance: f32) -> f32 {
    let square = (distance / half) * (distance / half);
    1.0 / (1.0 + square * square)
}

/// Fills `weights` with λⱼ ∝ exp(−Dⱼ / (δ · min D)) from the classes' mean squared neighbour distances (m²; infinite for an
/// inactive class), where δ is up to [`WIDEST`] times as wide for unknown input. Those below `least_weight` times the largest
/// become zero; the rest sums to 1, or all are zero if no class is active.
pub(super) fn class_weights(distances: &[f32], delta: f32, least_weight: f32, weights: &mut [f32]) {
    let least = distances.iter().copied().fold(f32::INFINITY, f32::min).max(FLOOR);
    let scale = 1.0 / (width(least, delta) * least);
    for (w, &d) in weights.iter_mut().zip(distances) {
        // Relative to the nearest class, whose weight is 1.
        let weight = if d.is_finite() { exp((least - d).min(0.0) * scale).max(MIN_WEIGHT) } else { 0.0 };
        *w = if weight < least_weight { 0.0 } else { weight };
    }
    let sum: f32 = weights.iter().sum();
    if sum > 0.0 {
        for w in weights {
            *w /= sum;
        }
    }
}

/// Distance above which [`class_weights`] are certainly zero, if the smallest distance is at most `least`.
pub(super) fn greatest_distance(least: f32, delta: f32, least_weight: f32) -> f32 {
    let least = least.max(FLOOR);
    // The factor of 1.001 exceeds all rounding errors.
    1.001 * least * (1.0 - width(least, delta) * ln(least_weight))
}

/// δ for input whose nearest class is at this distance. It grows with the distance.
fn width(least: f32, delta: f32) -> f32 {
    delta * (WIDEST - (WIDEST - 1.0) * known(least))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn weights_sum_to_one_and_fall_with_distance(
            distances in prop::collection::vec(0.0f32..1.0, 1..50), delta in 0.01f32..10.0, skip in any::<bool>(),
        ) {
            let mut weights = vec![0.0; distances.len()];
            let least_weight = if skip { 1e-4 } else { 0.0 };
            class_weights(&distances, delta, least_weight, &mut weights);
            let least = distances.iter().copied().fold(f32::INFINITY, f32::min);
            let greatest = greatest_distance(least, delta, least_weight);
            prop_assert!(distances.iter().zip(&weights).all(|(d, w)| *w == 0.0 || *d < greatest));
            prop_assert!((weights.iter().sum::<f32>() - 1.0).abs() < 1e-5);
            prop_assert!(skip || weights.iter().all(|w| *w > 0.0));
            for (i, j) in (0..distances.len()).flat_map(|i| (0..distances.len()).map(move |j| (i, j))) {
                if distances[i] <= distances[j] {
                    prop_assert!(weights[i] >= weights[j]);
                }
            }
        }
    }

    #[test]
    fn unknown_input_mixes_more_classes() {
        let heaviest = |least: f32| {
            let mut weights = [0.0; 2];
            class_weights(&[least, 2.0 * least], 0.35, 0.0, &mut weights);
            weights[0]
        };
        let alone = |width: f32| 1.0 / (1.0 + exp(-1.0 / width));
        assert!((heaviest(1e-4) - alone(0.35)).abs() < 1e-3);
        assert!((heaviest(1e-1) - alone(1.05)).abs() < 1e-3);
    }

    #[test]
    fn classes_without_neighbours_take_no_part() {
        let mut weights = [9.0; 3];
        class_weights(&[f32::INFINITY, 0.0, f32::NAN], 0.7, 1e-4, &mut weights);
        assert_eq!(weights, [0.0, 1.0, 0.0]);
        class_weights(&[f32::INFINITY; 3], 0.7, 1e-4, &mut weights);
        assert_eq!(weights, [0.0; 3]);
    }
}
