//! The only callers of transcendental functions, in single precision and in [`double`] precision.
//!
//! `std` delegates these to the platform's C library, whose last bits differ; `libm` is the same
//! Rust code everywhere. Square root and rounding are exact in IEEE 754 and may be called directly.
#![allow(clippy::disallowed_methods)]

pub mod double;

/// Sine of `x` radians.
pub fn sin(x: f32) -> f32 {
    libm::sinf(x)
}

/// Cosine of `x` radians.
pub fn cos(x: f32) -> f32 {
    libm::cosf(x)
}

/// Sine and cosine of `x` radians.
pub fn sin_cos(x: f32) -> (f32, f32) {
    (libm::sinf(x), libm::cosf(x))
}

/// Arc cosine in radians; the argument is clamped to [−1, 1], so rounding never yields NaN.
pub fn acos(x: f32) -> f32 {
    libm::acosf(x.clamp(-1.0, 1.0))
}

/// Arc sine in radians; the argument is clamped to [−1, 1].
pub fn asin(x: f32) -> f32 {
    libm::asinf(x.clamp(-1.0, 1.0))
}

/// Angle of the point (x, y) in (−π, π].
pub fn atan2(y: f32, x: f32) -> f32 {
    libm::atan2f(y, x)
}

/// e to the power of `x`.
pub fn exp(x: f32) -> f32 {
    libm::expf(x)
}

/// Natural logarithm.
pub fn ln(x: f32) -> f32 {
    libm::logf(x)
}

/// 2 to the power of `x`; with `-dt / half_life` it is the share that remains of a decaying value.
pub fn exp2(x: f32) -> f32 {
    libm::exp2f(x)
}

/// The angle equal to `x` modulo 2π in [−π, π].
pub fn wrap_angle(x: f32) -> f32 {
    let turns = (x / std::f32::consts::TAU).round();
    x - turns * std::f32::consts::TAU
}

/// The share of the distance to a target covered in `dt` by exponential smoothing with this half-life (both in seconds); 1 if
/// the half-life is zero.
pub fn half_life_share(dt_secs: f32, half_life_secs: f32) -> f32 {
    if half_life_secs <= 0.0 { 1.0 } else { 1.0 - exp2(-dt_secs / half_life_secs) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f32::consts::PI;

    #[test]
    fn wrapped_angles_lie_within_half_a_turn() {
        for (angle, wrapped) in [(0.0, 0.0), (2.0 * PI + 0.25, 0.25), (-2.0 * PI - 0.25, -0.25), (3.5 * PI, -0.5 * PI)]
        {
            assert!((wrap_angle(angle) - wrapped).abs() < 1e-5);
        }
    }

    #[test]
    fn half_of_the_way_is_covered_in_a_half_life() {
        assert_eq!(half_life_share(0.1, 0.1), 0.5);
        assert_eq!(half_life_share(0.1, 0.0), 1.0);
    }
}
