//! Smooth transitions and cubic interpolation.

use std::ops::{Add, Mul, Sub};

/// Rises from 0 at `from` to 1 at `to` with zero slope and curvature at both ends; constant beyond them.
pub fn smooth_step(from: f32, to: f32, x: f32) -> f32 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * t * (t * (6.0 * t - 15.0) + 10.0)
}

/// Weights of a cubic Hermite piece at `t` in [0, 1]: of the value and the slope at its beginning, then of the value and
/// the slope at its end. Slopes are changes per piece.
pub fn hermite_weights<T>(t: T) -> [T; 4]
where
    T: Copy + From<f32> + Add<Output = T> + Sub<Output = T> + Mul<Output = T>,
{
    let [one, two, three] = [1.0, 2.0, 3.0].map(T::from);
    let (t2, t3) = (t * t, t * t * t);
    [two * t3 - three * t2 + one, t3 - two * t2 + t, three * t2 - two * t3, t3 - t2]
}

/// Slope at a knot for which a cubic stays between its values, from the slopes of the chords before and after it: their
/// harmonic mean, zero at an extremum (Fritsch and Butland 1984, for equidistant knots).
pub fn monotone_slope(before: f32, after: f32) -> f32 {
    if before * after <= 0.0 { 0.0 } else { 2.0 * before * after / (before + after) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_hermite_piece_reproduces_cubics(c in prop::array::uniform4(-2.0f64..2.0), t in 0.0f64..1.0) {
            let value = |t: f64| c[0] + t * (c[1] + t * (c[2] + t * c[3]));
            let slope = |t: f64| c[1] + t * (2.0 * c[2] + t * 3.0 * c[3]);
            let [a, b, c, d] = hermite_weights(t);
            let piece = a * value(0.0) + b * slope(0.0) + c * value(1.0) + d * slope(1.0);
            prop_assert!((piece - value(t)).abs() < 1e-12);
        }

        #[test]
        fn pieces_with_monotone_slopes_stay_between_their_values(
            chords in prop::array::uniform3(-3.0f32..3.0), t in 0.0f32..1.0,
        ) {
            let [from, to] = [monotone_slope(chords[0], chords[1]), monotone_slope(chords[1], chords[2])];
            let [_, b, c, d] = hermite_weights(t);
            let risen = b * from + c * chords[1] + d * to;
            prop_assert!(risen >= chords[1].min(0.0) - 1e-5 && risen <= chords[1].max(0.0) + 1e-5);
        }
    }

    #[test]
    fn a_smooth_step_is_level_at_both_ends() {
        assert_eq!([-1.0, 2.0, 3.0, 4.0, 9.0].map(|x| smooth_step(2.0, 4.0, x)), [0.0, 0.0, 0.5, 1.0, 1.0]);
        assert!(smooth_step(0.0, 1.0, 0.01) < 1e-4 && smooth_step(0.0, 1.0, 0.99) > 1.0 - 1e-4);
    }
}
