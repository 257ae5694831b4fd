//! How far a distance that a graphics processor computes may be off.
//!
//! WGSL rounds to either neighbour (u = 2⁻²³), may reassociate and fuse, and its root is good to 5 ulp. In any order
//! |fl(Σ) − Σ| ≤ n u Σ|…| to first order. The heights' product h has 100 terms and each part of the ground's product g has
//! 208. By the inequality of Cauchy and Schwarz, with the root and the rounding of what is stored, 2 (h + |g|) is off by at
//! most 600 u √(N N′), and the other sums by 10 u (N + N′), which leaves room for the comparison with a limit.

/// Spacing of numbers just above 1.
const UNIT: f32 = f32::EPSILON;
/// What the floor under the root and numbers too small to be represented add, m².
const SMALLEST: f32 = 1e-14;

/// Bound ε₁ on the error of a computed D of windows with the squared lengths `n` and at most `greatest`, m².
pub(crate) fn bound(n: f32, greatest: f32) -> f32 {
    UNIT * (600.0 * (n * greatest).sqrt() + 10.0 * (n + greatest)) + SMALLEST
}

/// How much farther than the k-th nearest window a candidate may seem: 2 (ε₁ + ε₂), ε₂ the bound of the processor's own D.
///
/// The k-th least of two lists that differ by at most ε differ by at most ε; so a window as near as the k-th by one list is
/// within 2 ε of the k-th by the other.
pub(crate) fn margin(n: f32, greatest: f32, processor: f32) -> f32 {
    2.0 * (bound(n, greatest) + processor)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_margin_of_people_is_a_thousandth_of_their_nearness() {
        // Windows of people have a squared length of some tenth of a square metre.
        let margin = margin(0.2, 0.3, 1e-7);
        assert!((1e-5..1e-4).contains(&margin), "{margin}");
        assert!(!super::margin(1e30, f32::INFINITY, 0.0).is_finite());
    }
}
