//! Exponential map between rotation vectors (axis × angle, radians) and unit quaternions.

use super::float_funcs::{atan2, sin_cos};
use super::{Quat, Vec3};

/// The rotation by |v| radians about v.
pub fn exp(v: Vec3) -> Quat {
    let angle = length(v);
    if angle < 1e-4 {
        // sin(a/2)/a = 1/2 − a²/48; beyond f32 precision here, and free of 0/0.
        return Quat::from_xyzw(0.5 * v.x, 0.5 * v.y, 0.5 * v.z, 1.0).normalized();
    }
    let (s, c) = sin_cos(0.5 * angle);
    let k = s / angle;
    Quat::from_xyzw(k * v.x, k * v.y, k * v.z, c)
}

/// The shortest rotation vector of `q`: length in [0, π].
pub fn log(q: Quat) -> Vec3 {
    let q = if q.w < 0.0 { -q } else { q };
    let v = Vec3::new(q.x, q.y, q.z);
    let s = length(v);
    if s < 1e-7 {
        return 2.0 * v;
    }
    v * (2.0 * atan2(s, q.w) / s)
}

/// `Vec3::length` without glam's own square root, which is a loop in WebAssembly; the bits are the same.
fn length(v: Vec3) -> f32 {
    v.length_squared().sqrt()
}

/// The mean rotation (Karcher mean): the one from which the logarithms of all others sum to zero.
///
/// Rotations more than a half turn apart have no unique mean; the iteration then stops at a local one.
/// An empty slice gives the identity.
pub fn karcher_mean(rotations: &[Quat]) -> Quat {
    let Some(&first) = rotations.first() else { return Quat::IDENTITY };
    let mut mean = first;
    for _ in 0..32 {
        let mut sum = Vec3::ZERO;
        for &r in rotations {
            sum += log(mean.inv_mul(r));
        }
        let step = sum / rotations.len() as f32;
        mean = (mean * exp(step)).normalized();
        if step.length() < 1e-6 {
            break;
        }
    }
    mean
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn log_inverts_exp(v in prop::array::uniform3(-1.8f32..1.8)) {
            let v = Vec3::from_array(v);
            prop_assert!((log(exp(v)) - v).length() < 1e-4);
        }
    }

    #[test]
    fn mean_of_opposite_turns_is_their_middle() {
        let centre = exp(Vec3::new(0.3, -1.0, 0.4));
        let turn = Vec3::new(0.2, 0.5, -0.1);
        let mean = karcher_mean(&[centre * exp(turn), centre * exp(-turn), centre]);
        assert!(mean.dot(centre).abs() > 1.0 - 1e-6);
    }
}
