//! Smooths the output for input that is unlike the database (`docs/methods/mar.md` §13); not in the paper.
//!
//! Far from the database several of the K nearest neighbours change from frame to frame, and with them the means and
//! slopes of the regression. Two measures, [`super::Options::coherence`], keep this jitter out of the output.
//! Neighbours enter and leave with weight zero ([`taper`]), and a [`ComplementaryFilter`] blends each prediction with
//! the row expected from the neighbours' own steps. For input at a constant distance it is a steady-state Kalman filter
//! with the neighbours' motion as its motion model, so that it lags only where they are wrong.
//!
//! Measured over the 41 clips of `cmu` and `xia` in four styles: acceleration ratio 1.58 → 0.94 and jerk ratio
//! 3.02 → 1.24, content correlation .83 → .85; in database error no change.

use super::class_weights::known_by_half_at;
use super::input::Input;
use crate::pose_vector::{PoseRow, ROW};
use crate::search::Neighbour;

/// Half-life of the difference between expected and predicted rows for known input, seconds: three quarters of it decay
/// within a frame at 60 Hz. Twice this half-life costs accuracy on runs (2.032 cm instead of 2.017).
const HALF_LIFE_SECS: f32 = 1.0 / 120.0;

/// Factor of the half-life where the input is unknown. There the neighbours' steps are closer to the truth than their
/// positions, which change whenever a neighbour changes.
const LONGEST: f32 = 6.0;

/// D of the nearest neighbour at which `known` is one half, m²: (4 cm)².
const HALF_UNKNOWN: f32 = 0.04 * 0.04;

/// Half-life of the difference between expected and predicted rows, seconds, for input whose nearest neighbour is at
/// this D, m². The mean D of all neighbours is less informative: it is also large in a small database, which has few
/// near ones.
pub(super) fn half_life_secs(nearest: f32) -> f32 {
    HALF_LIFE_SECS * (LONGEST - (LONGEST - 1.0) * known_by_half_at(HALF_UNKNOWN, nearest))
}

/// Weights of neighbours, nearest first: 1 for the nearest, decreasing with D to 0 for the last.
pub(super) fn taper(neighbours: &[Neighbour], weights: &mut Vec<f32>) {
    weights.clear();
    let (Some(first), Some(last)) = (neighbours.first(), neighbours.last()) else { return };
    let range = last.distance - first.distance;
    weights.extend(neighbours.iter().map(|n| if range > 0.0 { (last.distance - n.distance) / range } else { 1.0 }));
}

/// Expected change of a style's row in this frame: the change of the neighbours' targets, plus the share ρ of the
/// difference between the input's change and the neighbours'.
#[derive(Clone, Debug)]
pub(super) struct ComplementaryFilter {
    step: PoseRow,
}

impl ComplementaryFilter {
    /// No change.
    pub(super) const NONE: Self = Self { step: [0.0; ROW] };

    /// Initial value, without neighbours: the share ρ of the input's own step.
    pub(super) fn of_input(input: Input<'_>, rho: f32) -> Self {
        Self { step: std::array::from_fn(|d| rho * (input.current[d] - input.previous[d])) }
    }

    /// Adds the mean steps of a class's neighbours, of inputs and of targets, with the weight of the class.
    pub(super) fn add(&mut self, weight: f32, rho: f32, input_step: &PoseRow, target_step: &PoseRow) {
        for (sum, (x, y)) in self.step.iter_mut().zip(input_step.iter().zip(target_step)) {
            *sum += weight * (y - rho * x);
        }
    }

    /// Replaces the prediction by the row expected after `previous`, corrected by a share of the difference.
    pub(super) fn correct(&self, previous: &PoseRow, share: f32, predicted: &mut PoseRow) {
        for (d, y) in predicted.iter_mut().enumerate() {
            let expected = previous[d] + self.step[d];
            *y = expected + share * (*y - expected);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_last_neighbour_weighs_nothing_and_nearer_ones_more(
            mut distances in prop::collection::vec(0.0f32..1.0, 1..50),
        ) {
            distances.sort_by(f32::total_cmp);
            let list: Vec<Neighbour> = distances.iter().map(|&distance| Neighbour { distance, row: 1 }).collect();
            let mut weights = vec![9.0];
            taper(&list, &mut weights);
            prop_assert_eq!(weights.len(), list.len());
            prop_assert_eq!(weights[0], 1.0);
            prop_assert!(weights.windows(2).all(|w| w[0] >= w[1]));
            prop_assert!(weights[list.len() - 1] == 0.0 || distances[0] == distances[list.len() - 1]);
        }

        #[test]
        fn the_half_life_grows_with_the_distance_of_the_nearest(a in 0.0f32..0.01, b in 0.0f32..0.01) {
            prop_assert!(half_life_secs(a.min(b)) <= half_life_secs(a.max(b)));
            let [known, unknown] = [half_life_secs(0.0) / HALF_LIFE_SECS, half_life_secs(f32::INFINITY) / HALF_LIFE_SECS];
            prop_assert!((known - 1.0).abs() < 1e-6 && (unknown - LONGEST).abs() < 1e-6, "{known} {unknown}");
        }

        /// Where the neighbours are right, the filter adds no lag.
        #[test]
        fn a_prediction_as_expected_is_kept(step in -0.1f32..0.1, foreign in -0.1f32..0.1, rho in 0.0f32..1.0) {
            let (before, now) = ([0.2; ROW], [0.2 + step + foreign; ROW]);
            let mut filter = ComplementaryFilter::of_input(Input { current: &now, previous: &before }, rho);
            filter.add(0.25, rho, &[step; ROW], &[2.0 * step; ROW]);
            filter.add(0.75, rho, &[step; ROW], &[2.0 * step; ROW]);
            let mut row = [1.0 + 2.0 * step + rho * foreign; ROW];
            filter.correct(&[1.0; ROW], 0.75, &mut row);
            prop_assert!((row[5] - (1.0 + 2.0 * step + rho * foreign)).abs() < 1e-5);
            let mut jump = [2.0; ROW];
            ComplementaryFilter::NONE.correct(&[1.0; ROW], 0.75, &mut jump);
            prop_assert_eq!(jump[5], 1.75);
        }
    }
}
