//! Blend of several styles: s(t) of `docs/methods/mar.md` §10.

use super::body_part::{BodyPart, PARTS};
use super::joint_limits::JointLimits;
use crate::pose_vector::{DOFS, PoseRow, ROW};
use thiserror::Error;

/// Greatest absolute value of a weight.
pub const MAX_WEIGHT: f32 = 10.0;

/// A style whose weights are all below this is inactive.
const MIN_WEIGHT: f32 = 1e-6;

/// Reason why style weights are rejected.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum StyleError {
    /// The number of weights differs from the number of styles.
    #[error("{found} style weights; the database has {expected} styles")]
    Count {
        /// Weights given.
        found: usize,
        /// Styles of the database.
        expected: usize,
    },
    /// A weight is not finite or too large.
    #[error("the weight of style {style} is {weight}; -10 to 10 was expected")]
    Weight {
        /// Index of the style.
        style: usize,
        /// Its weight.
        weight: f32,
    },
}

/// Weights of all styles for each part of the body. They may be negative or above 1. The neutral style receives the
/// remainder to a sum of 1.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct StyleBlend {
    neutral: usize,
    /// Sums to 1.
    whole: Vec<f32>,
    /// Each sums to 1; empty if the part uses the weights of the whole body.
    parts: [Vec<f32>; PARTS],
}

impl StyleBlend {
    /// All neutral.
    pub(super) fn new(styles: usize, neutral: usize) -> Self {
        let mut whole = vec![0.0; styles];
        whole[neutral] = 1.0;
        Self { neutral, whole, parts: std::array::from_fn(|_| Vec::with_capacity(styles)) }
    }

    /// Sets the weights of the whole body. Parts with their own weights keep them.
    pub(super) fn set_whole(&mut self, weights: &[f32]) -> Result<(), StyleError> {
        validate(weights, self.whole.len())?;
        self.whole.copy_from_slice(weights);
        self.whole[self.neutral] += 1.0 - weights.iter().sum::<f32>();
        Ok(())
    }

    /// Sets the weights of one part. With `None` it uses the weights of the whole body again.
    pub(super) fn set_part(&mut self, part: BodyPart, weights: Option<&[f32]>) -> Result<(), StyleError> {
        let own = &mut self.parts[part as usize];
        let Some(weights) = weights else {
            own.clear();
            return Ok(());
        };
        validate(weights, self.whole.len())?;
        own.clear();
        own.extend_from_slice(weights);
        own[self.neutral] += 1.0 - weights.iter().sum::<f32>();
        Ok(())
    }

    /// Weight of a style in a part.
    pub(super) fn weight(&self, part: BodyPart, style: usize) -> f32 {
        self.parts[part as usize].get(style).copied().unwrap_or(self.whole[style])
    }

    /// Returns whether a style has a weight in any part.
    pub(super) fn is_active(&self, style: usize) -> bool {
        BodyPart::ALL.into_iter().any(|p| self.weight(p, style).abs() > MIN_WEIGHT)
    }
}

fn validate(weights: &[f32], styles: usize) -> Result<(), StyleError> {
    if weights.len() != styles {
        return Err(StyleError::Count { found: weights.len(), expected: styles });
    }
    match weights.iter().position(|w| w.is_nan() || w.abs() > MAX_WEIGHT) {
        Some(style) => Err(StyleError::Weight { style, weight: weights[style] }),
        None => Ok(()),
    }
}

/// Weighted sum of the styles' rows. Where a weight is below 0 or above 1, the sum is limited to the joint limits,
/// widened to include the values of the styles and of the input. So neither interpolation nor the input's own content
/// is clipped.
pub(super) fn blended<'a>(
    blend: &StyleBlend,
    parts: &[BodyPart; ROW],
    limits: &JointLimits,
    input: &PoseRow,
    styles: impl Iterator<Item = (usize, &'a PoseRow)> + Clone,
) -> PoseRow {
    let mut sum = [0.0; ROW];
    let mut extrapolates = [false; PARTS];
    for (style, row) in styles.clone() {
        let weights: [f32; PARTS] = std::array::from_fn(|p| blend.weight(BodyPart::ALL[p], style));
        for (e, w) in extrapolates.iter_mut().zip(&weights) {
            *e |= !(0.0..=1.0 + MIN_WEIGHT).contains(w);
        }
        for d in 0..DOFS {
            sum[d] += weights[parts[d] as usize] * row[d];
        }
    }
    if extrapolates == [false; PARTS] {
        return sum;
    }
    let (mut least, mut greatest) = (*input, *input);
    for (_, row) in styles {
        for d in 0..DOFS {
            least[d] = least[d].min(row[d]);
            greatest[d] = greatest[d].max(row[d]);
        }
    }
    for d in 0..DOFS {
        if extrapolates[parts[d] as usize] {
            sum[d] = sum[d].clamp(limits.range[0][d].min(least[d]), limits.range[1][d].max(greatest[d]));
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn blend_of(weights: [f32; 2]) -> PoseRow {
        let mut blend = StyleBlend::new(2, 0);
        blend.set_whole(&weights).unwrap();
        let limits = JointLimits::new(&[[-1.0; ROW], [2.0; ROW]]);
        let (neutral, styled) = ([0.5; ROW], [1.0; ROW]);
        let rows = [(0, &neutral), (1, &styled)];
        blended(&blend, &BodyPart::of_row(), &limits, &[0.0; ROW], rows.into_iter())
    }

    proptest! {
        #[test]
        fn blending_is_linear_and_the_remainder_is_neutral(w in -2.0f32..3.0) {
            // Within the limits −1.3 … 2.3.
            prop_assert!((blend_of([0.0, w])[7] - (0.5 + 0.5 * w)).abs() < 1e-5);
        }
    }

    proptest! {
        #[test]
        fn three_styles_make_a_plane(a in 0.0f32..1.0, b in 0.0f32..1.0) {
            let mut blend = StyleBlend::new(3, 0);
            blend.set_whole(&[0.0, a, b]).unwrap();
            let limits = JointLimits::new(&[[-9.0; ROW], [9.0; ROW]]);
            let rows = [[0.1; ROW], [1.0; ROW], [-2.0; ROW]];
            let row = blended(&blend, &BodyPart::of_row(), &limits, &[0.0; ROW], rows.iter().enumerate());
            prop_assert!((row[7] - (0.1 + 0.9 * a - 2.1 * b)).abs() < 1e-5);
        }
    }

    #[test]
    fn extrapolation_stops_at_the_widened_limits() {
        assert!((blend_of([0.0, 9.0])[7] - 2.3).abs() < 1e-5);
        assert!((blend_of([0.0, -9.0])[7] + 1.3).abs() < 1e-5);
    }

    #[test]
    fn parts_take_their_own_weights() {
        let mut blend = StyleBlend::new(2, 0);
        blend.set_part(BodyPart::Head, Some(&[0.0, 1.0])).unwrap();
        assert_eq!(blend.weight(BodyPart::Head, 1), 1.0);
        assert_eq!(blend.weight(BodyPart::Head, 0), 0.0);
        assert_eq!(blend.weight(BodyPart::Legs, 0), 1.0);
        assert!(blend.is_active(0) && blend.is_active(1));
        blend.set_part(BodyPart::Head, None).unwrap();
        assert!(!blend.is_active(1));
    }

    #[test]
    fn bad_weights_are_refused_and_change_nothing() {
        let mut blend = StyleBlend::new(2, 0);
        assert_eq!(blend.set_whole(&[1.0]), Err(StyleError::Count { found: 1, expected: 2 }));
        assert!(blend.set_whole(&[f32::NAN, 0.0]).is_err());
        assert!(blend.set_whole(&[0.0, 11.0]).is_err());
        assert_eq!(blend.weight(BodyPart::Legs, 0), 1.0);
    }
}
