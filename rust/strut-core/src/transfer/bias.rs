//! Input outside the database: Eq. 6–7 with consistent signs (`docs/methods/mar.md` §8).
//!
//! The part of the input that the neighbours cannot explain, Δx, is subtracted before the regression, and a share ρ of
//! it is added to the output: the performer's own content is kept, the rest of the pose is styled.

use crate::pose_vector::{PoseRow, ROW};

/// Floor of the neighbours' deviation, as a share of the global one. Without it, every millimetre would count as bias
/// when the neighbours are identical.
const MIN_SHARE: f32 = 0.05;
/// Absolute floor of the deviation, in the units of the degrees of freedom (0.3°, 5 mm): joints that never move in the
/// database have no deviation at all.
const MIN_DEVIATION: f32 = 0.005;

/// Mean μ and standard deviation σ of a class's neighbours, for each degree of freedom.
#[derive(Clone, Debug)]
pub(super) struct InputStatistics {
    pub(super) mean: PoseRow,
    pub(super) deviation: PoseRow,
}

/// σ of a degree of freedom among the neighbours, with its floors.
pub(super) fn deviation(statistics: &InputStatistics, sigma: &PoseRow, dof: usize) -> f32 {
    statistics.deviation[dof].max(MIN_SHARE * sigma[dof]).max(MIN_DEVIATION)
}

/// Δx of one class.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Bias {
    /// Δx: subtracted from xₜ and xₜ₋₁.
    pub(super) input: PoseRow,
    /// ρΔx: subtracted from yₜ₋₁, added to yₜ.
    pub(super) output: PoseRow,
    /// Largest |Δx| in σ.
    pub(super) largest: f32,
}

impl Bias {
    /// No bias, for other methods than MAR.
    pub(super) const NONE: Self = Self { input: [0.0; ROW], output: [0.0; ROW], largest: 0.0 };

    /// Δx = xₜ − clamp(xₜ, μ ± κσ), with σ at least a share of the global deviation `sigma`.
    pub(super) fn new(input: &PoseRow, statistics: &InputStatistics, sigma: &PoseRow, kappa: f32, rho: f32) -> Self {
        let mut bias = Self::NONE;
        for (d, &x) in input.iter().enumerate() {
            let deviation = deviation(statistics, sigma, d);
            let (mean, reach) = (statistics.mean[d], kappa * deviation);
            let delta = x - x.clamp(mean - reach, mean + reach);
            bias.input[d] = delta;
            bias.output[d] = rho * delta;
            bias.largest = bias.largest.max(delta.abs() / deviation);
        }
        bias
    }

    /// Adds the output's share of the bias to a row.
    pub(super) fn put_on(&self, mut row: PoseRow) -> PoseRow {
        row.iter_mut().zip(&self.output).for_each(|(v, b)| *v += b);
        row
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn there_is_no_bias_within_kappa_deviations(mean in -1.0f32..1.0, share in -0.999f32..0.999) {
            let statistics = InputStatistics { mean: [mean; ROW], deviation: [0.2; ROW] };
            let bias = Bias::new(&[mean + share * 3.0 * 0.2; ROW], &statistics, &[1.0; ROW], 3.0, 0.7);
            prop_assert_eq!(bias, Bias::NONE);
        }

        #[test]
        fn beyond_the_clamp_the_bias_is_the_excess(mean in -1.0f32..1.0, excess in 0.01f32..5.0) {
            let statistics = InputStatistics { mean: [mean; ROW], deviation: [0.0; ROW] };
            // The deviation is floored at 0.05 · 2.
            let bias = Bias::new(&[mean - 0.3 - excess; ROW], &statistics, &[2.0; ROW], 3.0, 0.7);
            prop_assert!((bias.input[0] + excess).abs() < 1e-5);
            prop_assert!((bias.output[0] + 0.7 * excess).abs() < 1e-5);
            prop_assert!((bias.largest - excess / 0.1).abs() < 1e-3);
        }
    }

    #[test]
    fn an_infinite_kappa_switches_it_off() {
        let statistics = InputStatistics { mean: [0.0; ROW], deviation: [0.1; ROW] };
        assert_eq!(Bias::new(&[9.0; ROW], &statistics, &[1.0; ROW], f32::INFINITY, 0.7), Bias::NONE);
    }
}
