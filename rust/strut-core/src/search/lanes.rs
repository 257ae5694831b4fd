//! Explicit 4-lane arithmetic: the one place that decides the order of floating-point sums in a search.
//!
//! Plain arrays of four that the compiler turns into SIMD registers where there are any. The additions
//! are the same, in the same order, with and without SIMD, so the bits are too.

/// Four numbers side by side.
pub(super) type Lane = [f32; 4];

/// `sum + a·b`, lane by lane; two roundings, never contracted.
#[allow(clippy::inline_always)] // one function call a window is half of its time
#[inline(always)]
pub(super) fn add_product(sum: Lane, a: &Lane, b: &Lane) -> Lane {
    [sum[0] + a[0] * b[0], sum[1] + a[1] * b[1], sum[2] + a[2] * b[2], sum[3] + a[3] * b[3]]
}

/// Sum of the lanes: pairs first.
#[allow(clippy::inline_always)] // one function call a window is half of its time
#[inline(always)]
pub(super) fn total(v: Lane) -> f32 {
    (v[0] + v[1]) + (v[2] + v[3])
}
