//! Soft limits of the joints for exaggerated styles (`docs/methods/hsmm.md` §10; the paper's future work).

use crate::math::float_funcs::exp;

/// Greatest margin of a soft limit, radians, and as a share of the range.
const MARGIN: f32 = 0.1;
const MARGIN_SHARE: f32 = 0.1;

/// Limits a degree of freedom softly: unchanged inside its range, and at most a margin outside.
pub(super) fn limited(x: f32, [low, high]: [f32; 2]) -> f32 {
    let margin = MARGIN.min(MARGIN_SHARE * (high - low));
    if margin <= 0.0 {
        return x.clamp(low, high);
    }
    // The soft limit begins a margin before the end of the range.
    if x > high - margin {
        high - margin + saturating(x - (high - margin), 2.0 * margin)
    } else if x < low + margin {
        low + margin - saturating(low + margin - x, 2.0 * margin)
    } else {
        x
    }
}

/// Saturates a non-negative number at `most` by a hyperbolic tangent; small numbers hardly change.
pub(super) fn saturating(x: f32, most: f32) -> f32 {
    let e = exp(-2.0 * (x / most));
    most * ((1.0 - e) / (1.0 + e))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn nothing_changes_inside_and_nothing_goes_far_outside(x in -20.0f32..20.0, low in -2.0f32..0.0, width in 0.01f32..3.0) {
            let high = low + width;
            let margin = MARGIN.min(MARGIN_SHARE * width);
            let y = limited(x, [low, high]);
            prop_assert!(y >= low - margin - 1e-5 && y <= high + margin + 1e-5);
            if (low + margin..=high - margin).contains(&x) {
                prop_assert_eq!(y, x);
            }
        }

        #[test]
        fn order_is_kept(x in -3.0f32..3.0, by in 0.0f32..1.0) {
            let range = [-1.0, 1.5];
            prop_assert!(limited(x, range) <= limited(x + by, range) + 1e-6);
        }
    }
}
