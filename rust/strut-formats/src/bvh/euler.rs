//! Conversion between rotations and angles about any sequence of axes.
//!
//! A sequence a₁ a₂ … aₙ with angles θ is R(a₁, θ₁)·R(a₂, θ₂)·…·R(aₙ, θₙ). Three axes of which neighbours differ can
//! represent every rotation (Bernardes & Viollet, "Quaternion to Euler angles conversion: A direct, general and
//! computationally efficient method", 2022). With one or two axes the nearest representable rotation is used. Double
//! precision, since files have more digits than `f32`.

use super::Axis;
use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, PI, TAU};
use strut_core::math::float_funcs::double;

/// A unit quaternion in double precision: x, y, z, w.
pub(super) type Quat64 = [f64; 4];

/// Below this angle (radians) between the middle rotation and gimbal lock only the sum or the difference of the outer
/// angles is well determined.
const LOCK: f64 = 1e-5;

/// Rotation of a sequence of axes with angles in radians.
pub(super) fn compose(axes_and_angles: impl Iterator<Item = (Axis, f64)>) -> Quat64 {
    axes_and_angles.fold([0.0, 0.0, 0.0, 1.0], |q, (axis, angle)| {
        let (s, c) = double::sin_cos(0.5 * angle);
        times_axis(q, axis as usize, s, c)
    })
}

/// `q` times the rotation with the components `s` on one axis and `c` as the real part.
fn times_axis(q: Quat64, i: usize, s: f64, c: f64) -> Quat64 {
    let (j, k) = ((i + 1) % 3, (i + 2) % 3);
    let mut out = [0.0; 4];
    out[i] = c * q[i] + s * q[3];
    out[j] = c * q[j] + s * q[k];
    out[k] = c * q[k] - s * q[j];
    out[3] = c * q[3] - s * q[i];
    out
}

/// Writes to `angles` (radians, one per axis) the angles whose rotation is `q`, or the nearest possible. Among
/// equivalent angles those nearest to `previous` are chosen.
pub(super) fn decompose(q: Quat64, axes: &[Axis], previous: &[f64], angles: &mut [f64]) {
    // Indices of the first three axes that differ from their neighbours; the angles of all others are zero.
    let mut used = [0; 3];
    let mut count = 0;
    for (i, axis) in axes.iter().enumerate() {
        if count < 3 && (count == 0 || axes[used[count - 1]] != *axis) {
            used[count] = i;
            count += 1;
        }
    }
    angles.fill(0.0);
    let axis = |n: usize| axes[used[n]] as usize;
    let before = |n: usize| previous[used[n]];
    match count {
        0 => {}
        1 => angles[used[0]] = nearest(2.0 * double::atan2(q[axis(0)], q[3]), before(0)),
        2 => {
            let [a, b] = two_axes(q, [axis(0), axis(1)]);
            // Adding π/2 to both half-angles gives the same rotation. The solution (a + π, b + π) is a different one,
            // but each angle alone may change by 2π.
            angles[used[0]] = nearest(a, before(0));
            angles[used[1]] = nearest(b, before(1));
        }
        _ => {
            let found = three_axes(q, [axis(0), axis(1), axis(2)], [before(0), before(1), before(2)]);
            for (n, angle) in found.into_iter().enumerate() {
                angles[used[n]] = angle;
            }
        }
    }
}

/// Angles of R(i)·R(j), i ≠ j, whose rotation is nearest to `q`: their quaternion's inner product with `q` separates
/// into terms of the sum and of the difference of the half-angles.
fn two_axes(q: Quat64, [i, j]: [usize; 2]) -> [f64; 2] {
    let k = 3 - i - j;
    let sign = if (j + 3 - i) % 3 == 1 { 1.0 } else { -1.0 };
    let (w, x, y, z) = (q[3], q[i], q[j], sign * q[k]);
    let sum = double::atan2(x + y, w - z);
    let difference = double::atan2(x - y, w + z);
    [sum + difference, sum - difference]
}

/// Angles of R(i)·R(j)·R(k), i ≠ j ≠ k, whose rotation is `q`, nearest to `previous`.
fn three_axes(q: Quat64, [i, j, k]: [usize; 3], previous: [f64; 3]) -> [f64; 3] {
    let sign = if (j + 3 - i) % 3 == 1 { 1.0 } else { -1.0 };
    // With Q = R(j, −sign·π/2), which takes axis i to axis k, R(k, γ) is Q·R(i, γ)·Q⁻¹. Hence
    // q·Q = R(i, α)·R(j, β − sign·π/2)·R(i, γ): three different axes become a symmetric sequence.
    let symmetric = i == k;
    let shift = if symmetric { 0.0 } else { sign * FRAC_PI_2 };
    let q = if symmetric { q } else { times_axis(q, j, -sign * FRAC_1_SQRT_2, FRAC_1_SQRT_2) };
    // Components of R(i, α)·R(j, μ)·R(i, γ): w and i are cos μ/2 times cosine and sine of (α + γ)/2,
    // j and k are sin μ/2 times those of (α − γ)/2.
    let (a, b, c, d) = (q[3], q[i], q[j], sign * q[3 - i - j]);
    let middle = 2.0 * double::atan2(double::hypot(c, d), double::hypot(a, b));
    let half_sum = double::atan2(b, a);
    let half_difference = double::atan2(d, c);
    let nearest_each = |angles: [f64; 3]| [0, 1, 2].map(|n| nearest(angles[n], previous[n]));
    if !(LOCK..=PI - LOCK).contains(&middle) {
        // Only the sum or only the difference is determined: the third angle keeps its previous value.
        let third = previous[2];
        let first = if middle < LOCK { 2.0 * half_sum - third } else { 2.0 * half_difference + third };
        return nearest_each([first, middle + shift, third]);
    }
    let (first, third) = (half_sum + half_difference, half_sum - half_difference);
    let one = nearest_each([first, middle + shift, third]);
    let other = nearest_each([first + PI, shift - middle, third + PI]);
    let distance = |angles: [f64; 3]| (0..3).map(|n| (angles[n] - previous[n]).abs()).sum::<f64>();
    if distance(other) < distance(one) { other } else { one }
}

/// The angle equal to `angle` modulo 2π that is nearest to `to`.
fn nearest(angle: f64, to: f64) -> f64 {
    angle - TAU * ((angle - to) / TAU).round()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn axis() -> impl Strategy<Value = Axis> {
        prop_oneof![Just(Axis::X), Just(Axis::Y), Just(Axis::Z)]
    }

    fn rotation(axes: &[Axis], angles: &[f64]) -> Quat64 {
        compose(axes.iter().copied().zip(angles.iter().copied()))
    }

    fn likeness(a: Quat64, b: Quat64) -> f64 {
        a.iter().zip(&b).map(|(a, b)| a * b).sum::<f64>().abs()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        #[test]
        fn angles_give_the_rotation_back_for_any_sequence(
            axes in prop::collection::vec(axis(), 0..6),
            angles in prop::array::uniform6(-7.0f64..7.0),
            previous in prop::array::uniform6(-7.0f64..7.0),
        ) {
            let n = axes.len();
            let q = rotation(&axes, &angles[..n]);
            let mut found = vec![0.0; n];
            decompose(q, &axes, &previous[..n], &mut found);
            prop_assert!(likeness(q, rotation(&axes, &found)) > 1.0 - 1e-9);
        }

        #[test]
        fn angles_at_gimbal_lock_give_the_rotation_back(
            first in -3.0f64..3.0, third in -3.0f64..3.0, off in -1e-6f64..1e-6, turns in 0..4, previous in -9.0f64..9.0,
        ) {
            for axes in [[Axis::Z, Axis::X, Axis::Y], [Axis::X, Axis::Z, Axis::Y], [Axis::Y, Axis::Z, Axis::Y]] {
                let q = rotation(&axes, &[first, FRAC_PI_2 * f64::from(turns) + off, third]);
                let mut found = [0.0; 3];
                decompose(q, &axes, &[0.1, 0.2, previous], &mut found);
                prop_assert!(likeness(q, rotation(&axes, &found)) > 1.0 - 1e-9);
            }
        }

        #[test]
        fn smooth_rotations_give_smooth_angles(
            first in 0_usize..3, second in 1_usize..3, third in 1_usize..3, rate in prop::array::uniform3(-4.0f64..4.0),
        ) {
            // The outer angles make several full turns, the middle one stays away from gimbal lock.
            let axes = [first, first + second, first + second + third].map(|i| [Axis::X, Axis::Y, Axis::Z][i % 3]);
            let symmetric = axes[0] == axes[2];
            let at = |t: f64| {
                let middle = 0.9 * double::sin(rate[1] * t) + if symmetric { FRAC_PI_2 } else { 0.0 };
                [rate[0] * t, middle, rate[2] * t]
            };
            let mut previous = at(0.0);
            for frame in 1..200 {
                let wanted = at(f64::from(frame) * 0.02);
                let mut found = [0.0; 3];
                decompose(rotation(&axes, &wanted), &axes, &previous, &mut found);
                for (f, w) in found.iter().zip(&wanted) {
                    prop_assert!((f - w).abs() < 1e-9);
                }
                previous = found;
            }
        }
    }

    #[test]
    fn two_axes_that_cannot_reach_a_rotation_come_as_near_as_possible() {
        let q = rotation(&[Axis::X, Axis::Y, Axis::Z], &[0.4, -0.3, 0.2]);
        let axes = [Axis::X, Axis::Y];
        let mut found = [0.0; 2];
        decompose(q, &axes, &[0.0; 2], &mut found);
        let best = likeness(q, rotation(&axes, &found));
        for step in [[0.01, 0.0], [-0.01, 0.0], [0.0, 0.01], [0.0, -0.01]] {
            assert!(likeness(q, rotation(&axes, &[found[0] + step[0], found[1] + step[1]])) < best);
        }
    }
}
