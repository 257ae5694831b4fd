//! Explicit 4-lane arithmetic: the one place that decides the order of floating-point sums in a search.
//!
//! Plain arrays of four that the compiler turns into SIMD registers where there are any. The additions
//! are the same, in the same order, with and without SIMD, so the bits are too.

/// Four numbers side by side.
pub(super) type Lane = [f32; 4];

/// Inner product of two windows of equally many frames of `N` lanes, with `SUMS` running sums (a divisor of `N`) so
/// that additions need not wait for each other.
///
/// Called for every window of a class: a function call would be half of its time.
#[allow(clippy::inline_always)]
#[inline(always)]
pub(super) fn inner_product<const N: usize, const SUMS: usize>(a: &[[Lane; N]], b: &[[Lane; N]]) -> f32 {
    let mut sums = [[0.0; 4]; SUMS];
    for (a, b) in a.iter().zip(b) {
        for first in (0..N).step_by(SUMS) {
            for (l, sum) in sums.iter_mut().enumerate() {
                let (a, b) = (&a[first + l], &b[first + l]);
                for i in 0..4 {
                    sum[i] += a[i] * b[i];
                }
            }
        }
    }
    let mut total = [0.0; 4];
    for sum in sums {
        for i in 0..4 {
            total[i] += sum[i];
        }
    }
    (total[0] + total[1]) + (total[2] + total[3])
}
