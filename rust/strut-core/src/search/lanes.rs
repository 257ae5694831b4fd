//! Explicit arithmetic on lanes. This module alone determines the order of floating-point sums in a search.
//!
//! [`Floats`] and [`Integers`] are SIMD registers in WebAssembly, where compilers do not vectorise arrays, and arrays
//! elsewhere, where they do. The operations are the same, in the same order, with and without SIMD, and so are the bits.
//! `crate::math::lanes` wraps glam's vector instead, which has neither a vectorised square root nor products of pairs of
//! 16-bit integers.

/// Four numbers side by side.
pub(super) type FloatLane = [f32; 4];

/// Four pairs of integers side by side.
pub(super) type Pairs = [i16; 8];

#[cfg(not(all(target_arch = "wasm32", target_feature = "simd128")))]
pub(super) use arrays::{Floats, Integers};
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
pub(super) use registers::{Floats, Integers};

/// Sum of the four numbers, always in this order.
#[inline]
pub(super) fn total(sum: Floats) -> f32 {
    let [a, b, c, d] = sum.array();
    (a + b) + (c + d)
}

/// Inner product of two windows with equal numbers of frames, over the first `USED` of their `N` lanes, with `SUMS`
/// running sums so that additions need not wait for each other. If the other lanes are zero, the result is
/// bit-identical to that of all lanes.
///
/// Called for every window that is compared: a function call would take half of the time.
#[allow(clippy::inline_always)]
#[inline(always)]
pub(super) fn inner_product<const N: usize, const USED: usize, const SUMS: usize>(
    a: &[[FloatLane; N]],
    b: &[[FloatLane; N]],
) -> f32 {
    let mut sums = [Floats::splat(0.0); SUMS];
    for (a, b) in a.iter().zip(b) {
        for l in 0..USED {
            sums[l % SUMS] = sums[l % SUMS].plus(Floats::of(&a[l]).times(Floats::of(&b[l])));
        }
    }
    total(sums.into_iter().fold(Floats::splat(0.0), Floats::plus))
}

/// ⟨y, y'⟩ and the real and the imaginary part of ⟨z, z'⟩ of a query, whose heights y are separate from x and z on the
/// ground, and of a stored window with the same number of frames, in which four heights, four x and four z alternate.
/// The first `USED` lanes of heights are used, with `SUMS` running sums each as in [`inner_product`].
#[allow(clippy::inline_always)] // see `inner_product`
#[inline(always)]
pub(super) fn products<const H: usize, const G: usize, const N: usize, const USED: usize, const SUMS: usize>(
    height: &[[FloatLane; H]],
    ground: &[[FloatLane; G]],
    stored: &[[FloatLane; N]],
) -> [f32; 3] {
    let mut heights = [Floats::splat(0.0); SUMS];
    for (own, stored) in height.iter().zip(stored) {
        for l in 0..USED {
            heights[l % SUMS] = heights[l % SUMS].plus(Floats::of(&own[l]).times(Floats::of(&stored[3 * l])));
        }
    }
    // A second pass, so that all sums fit in registers.
    let (mut real, mut imaginary) = ([Floats::splat(0.0); SUMS], [Floats::splat(0.0); SUMS]);
    for (own, stored) in ground.iter().zip(stored) {
        for l in 0..USED {
            let [x, z] = [&own[2 * l], &own[2 * l + 1]].map(Floats::of);
            let [stored_x, stored_z] = [&stored[3 * l + 1], &stored[3 * l + 2]].map(Floats::of);
            let (first, second) = (2 * l % SUMS, (2 * l + 1) % SUMS);
            real[first] = real[first].plus(x.times(stored_x));
            real[second] = real[second].plus(z.times(stored_z));
            imaginary[first] = imaginary[first].minus(z.times(stored_x));
            imaginary[second] = imaginary[second].plus(x.times(stored_z));
        }
    }
    [heights, real, imaginary].map(|sums| total(sums.into_iter().fold(Floats::splat(0.0), Floats::plus)))
}

#[cfg(not(all(target_arch = "wasm32", target_feature = "simd128")))]
#[allow(clippy::inline_always)] // single instructions
mod arrays {
    use super::{FloatLane, Pairs};
    use std::array::from_fn;

    #[derive(Clone, Copy)]
    pub(in super::super) struct Floats(FloatLane);

    impl Floats {
        #[inline(always)]
        pub(in super::super) fn of(lane: &FloatLane) -> Self {
            Self(*lane)
        }

        #[inline(always)]
        pub(in super::super) fn splat(v: f32) -> Self {
            Self([v; 4])
        }

        #[inline(always)]
        pub(in super::super) fn array(self) -> FloatLane {
            self.0
        }

        #[inline(always)]
        pub(in super::super) fn plus(self, other: Self) -> Self {
            Self(from_fn(|i| self.0[i] + other.0[i]))
        }

        #[inline(always)]
        pub(in super::super) fn minus(self, other: Self) -> Self {
            Self(from_fn(|i| self.0[i] - other.0[i]))
        }

        #[inline(always)]
        pub(in super::super) fn times(self, other: Self) -> Self {
            Self(from_fn(|i| self.0[i] * other.0[i]))
        }

        #[inline(always)]
        pub(in super::super) fn root(self) -> Self {
            Self(self.0.map(f32::sqrt))
        }

        /// Bit i is set if number i is greater; never if either is NaN.
        #[inline(always)]
        pub(in super::super) fn greater_than(self, other: Self) -> u32 {
            (0..4).map(|i| u32::from(self.0[i] > other.0[i]) << i).sum()
        }
    }

    #[derive(Clone, Copy)]
    pub(in super::super) struct Integers([i32; 4]);

    impl Integers {
        #[inline(always)]
        pub(in super::super) fn zero() -> Self {
            Self([0; 4])
        }

        #[inline(always)]
        pub(in super::super) fn plus(self, other: Self) -> Self {
            Self(from_fn(|i| self.0[i].wrapping_add(other.0[i])))
        }

        /// Inner product of each pair. Compilers do not generate the instruction for it.
        #[cfg(target_arch = "x86_64")]
        #[allow(unsafe_code)]
        #[inline(always)]
        pub(in super::super) fn products(a: &Pairs, b: &Pairs) -> Self {
            use std::arch::x86_64::{_mm_loadu_si128, _mm_madd_epi16};
            // SAFETY: every x86-64 processor has SSE2; both pointers are to 16 bytes, and the result has 16 bytes.
            unsafe {
                let [a, b] = [a, b].map(|v| _mm_loadu_si128(v.as_ptr().cast()));
                Self(std::mem::transmute::<std::arch::x86_64::__m128i, [i32; 4]>(_mm_madd_epi16(a, b)))
            }
        }

        /// Inner product of each pair.
        #[cfg(not(target_arch = "x86_64"))]
        #[inline(always)]
        pub(in super::super) fn products(a: &Pairs, b: &Pairs) -> Self {
            let product = |j: usize| i32::from(a[j]) * i32::from(b[j]);
            Self(from_fn(|i| product(2 * i).wrapping_add(product(2 * i + 1))))
        }

        #[inline(always)]
        pub(in super::super) fn floats(self) -> Floats {
            Floats(self.0.map(|v| v as f32))
        }
    }
}

#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
#[allow(clippy::inline_always, unsafe_code)] // single instructions
mod registers {
    use super::{FloatLane, Pairs};
    use std::arch::wasm32 as simd;

    #[derive(Clone, Copy)]
    pub(in super::super) struct Floats(simd::v128);

    impl Floats {
        #[inline(always)]
        pub(in super::super) fn of(lane: &FloatLane) -> Self {
            // SAFETY: the pointer is that of 16 bytes. (From four numbers compilers would load four times.)
            Self(unsafe { simd::v128_load(lane.as_ptr().cast()) })
        }

        #[inline(always)]
        pub(in super::super) fn splat(v: f32) -> Self {
            Self(simd::f32x4_splat(v))
        }

        #[inline(always)]
        pub(in super::super) fn array(self) -> FloatLane {
            // SAFETY: both are 16 bytes.
            unsafe { std::mem::transmute::<simd::v128, FloatLane>(self.0) }
        }

        #[inline(always)]
        pub(in super::super) fn plus(self, other: Self) -> Self {
            Self(simd::f32x4_add(self.0, other.0))
        }

        #[inline(always)]
        pub(in super::super) fn minus(self, other: Self) -> Self {
            Self(simd::f32x4_sub(self.0, other.0))
        }

        #[inline(always)]
        pub(in super::super) fn times(self, other: Self) -> Self {
            Self(simd::f32x4_mul(self.0, other.0))
        }

        #[inline(always)]
        pub(in super::super) fn root(self) -> Self {
            Self(simd::f32x4_sqrt(self.0))
        }

        #[inline(always)]
        pub(in super::super) fn greater_than(self, other: Self) -> u32 {
            simd::i32x4_bitmask(simd::f32x4_gt(self.0, other.0)).into()
        }
    }

    #[derive(Clone, Copy)]
    pub(in super::super) struct Integers(simd::v128);

    impl Integers {
        #[inline(always)]
        pub(in super::super) fn zero() -> Self {
            Self(simd::i32x4_splat(0))
        }

        #[inline(always)]
        pub(in super::super) fn plus(self, other: Self) -> Self {
            Self(simd::i32x4_add(self.0, other.0))
        }

        #[inline(always)]
        pub(in super::super) fn products(a: &Pairs, b: &Pairs) -> Self {
            // SAFETY: both pointers are those of 16 bytes.
            let [a, b] = [a, b].map(|v| unsafe { simd::v128_load(v.as_ptr().cast()) });
            Self(simd::i32x4_dot_i16x8(a, b))
        }

        #[inline(always)]
        pub(in super::super) fn floats(self) -> Floats {
            Floats(simd::f32x4_convert_i32x4(self.0))
        }
    }
}
