//! Error bound of a distance that a GPU computes.
//!
//! WGSL rounds to either neighbour (u = 2⁻²³), may reassociate and fuse, and its root has an error of up to 5 ulp. In
//! any order |fl(Σ) − Σ| ≤ n u Σ|…| to first order. The product h of the heights has 100 terms, and each component of
//! the ground product g has 208. By the Cauchy–Schwarz inequality, with the root and the rounding of stored values, the
//! error of 2 (h + |g|) is at most 600 u √(N N′), and that of the other sums 10 u (N + N′). This leaves room for the
//! comparison with a limit.

/// Spacing of numbers just above 1.
const UNIT: f32 = f32::EPSILON;
/// Contribution of the lower bound under the root and of numbers too small to be represented, m².
const SMALLEST: f32 = 1e-14;

/// Returns the bound ε₁ on the error of a computed D of windows with the squared lengths `n` and at most `greatest`,
/// m².
pub(crate) fn bound(n: f32, greatest: f32) -> f32 {
    UNIT * (600.0 * (n * greatest).sqrt() + 10.0 * (n + greatest)) + SMALLEST
}

/// Returns the distance by which a candidate may exceed the k-th nearest window: 2 (ε₁ + ε₂), where ε₂ bounds the error
/// of the CPU's D.
///
/// The k-th least of two lists that differ by at most ε differ by at most ε. So a window that is as near as the k-th by
/// one list is within 2 ε of the k-th by the other.
pub(crate) fn margin(n: f32, greatest: f32, processor: f32) -> f32 {
    2.0 * (bound(n, greatest) + processor)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_margin_of_people_is_a_thousandth_of_their_nearness() {
        // Windows of human motion have a squared length of some tenths of a square metre.
        let margin = margin(0.2, 0.3, 1e-7);
        assert!((1e-5..1e-4).contains(&margin), "{margin}");
        assert!(!super::margin(1e30, f32::INFINITY, 0.0).is_finite());
    }
}
