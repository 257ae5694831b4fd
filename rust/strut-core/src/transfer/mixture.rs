//! Mixture over classes: Eq. 3–5 and the specification, §7.

use crate::math::float_funcs::exp;

/// Classes whose share of the weights is below this are skipped: they change the output by less than
/// 1e-5 m and are most of the work.
pub const LEAST_SHARE: f32 = 1e-3;

/// Least of the distances, (1 mm)²: below it the measurement is noise and one class would take all.
const FLOOR: f32 = 1e-6;

/// Fills `weights` with λⱼ ∝ exp(−Dⱼ / (δ · min D)) from the classes' mean squared neighbour distances
/// (m²; infinite for a class that takes no part). Shares below [`LEAST_SHARE`] become zero; the rest sums
/// to 1, or all is zero if no class takes part.
pub fn class_weights(distances: &[f32], delta: f32, weights: &mut [f32]) {
    let least = distances.iter().copied().fold(f32::INFINITY, f32::min).max(FLOOR);
    let scale = 1.0 / (delta * least);
    for (w, &d) in weights.iter_mut().zip(distances) {
        // Relative to the nearest class, so that a small δ cannot underflow all of them.
        *w = if d.is_finite() { exp((least - d).min(0.0) * scale) } else { 0.0 };
    }
    normalise(weights);
    for w in weights.iter_mut() {
        if *w < LEAST_SHARE {
            *w = 0.0;
        }
    }
    normalise(weights);
}

fn normalise(weights: &mut [f32]) {
    let sum: f32 = weights.iter().sum();
    if sum > 0.0 {
        for w in weights {
            *w /= sum;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn weights_sum_to_one_and_fall_with_distance(
            distances in prop::collection::vec(0.0f32..1.0, 1..50), delta in 0.01f32..10.0,
        ) {
            let mut weights = vec![0.0; distances.len()];
            class_weights(&distances, delta, &mut weights);
            prop_assert!((weights.iter().sum::<f32>() - 1.0).abs() < 1e-5);
            for (i, j) in (0..distances.len()).flat_map(|i| (0..distances.len()).map(move |j| (i, j))) {
                if distances[i] <= distances[j] {
                    prop_assert!(weights[i] >= weights[j]);
                }
            }
        }
    }

    #[test]
    fn classes_without_neighbours_take_no_part() {
        let mut weights = [9.0; 3];
        class_weights(&[f32::INFINITY, 0.0, f32::NAN], 0.7, &mut weights);
        assert_eq!(weights, [0.0, 1.0, 0.0]);
        class_weights(&[f32::INFINITY; 3], 0.7, &mut weights);
        assert_eq!(weights, [0.0; 3]);
    }
}
