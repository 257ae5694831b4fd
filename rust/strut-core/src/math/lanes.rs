//! SIMD lanes of four numbers: arithmetic on whole rows of degrees of freedom.
//!
//! glam's vector is a SIMD register where the target has them; compilers do not vectorise loops over arrays of four. Only
//! operations that act on each number separately and are exact in IEEE 754 are offered, so the bits are the same with and
//! without SIMD.

use glam::Vec4;
use std::ops::{Add, AddAssign, Div, Mul, Sub};

/// Numbers in a [`Lane`].
pub(crate) const WIDTH: usize = 4;

/// Four numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Lane(Vec4);

impl Lane {
    /// Four copies of a number.
    #[inline]
    pub(crate) fn splat(v: f32) -> Self {
        Self(Vec4::splat(v))
    }

    /// Reads the numbers `WIDTH · l` … of a row whose length is a multiple of [`WIDTH`].
    #[inline]
    pub(crate) fn of(row: &[f32], l: usize) -> Self {
        Self(bytemuck::pod_read_unaligned(bytemuck::cast_slice(&row[WIDTH * l..][..WIDTH])))
    }

    /// [`Lane::of`] for a row of integers.
    #[inline]
    pub(crate) fn of_integers(row: &[i16], l: usize) -> Self {
        let four = &row[WIDTH * l..][..WIDTH];
        Self(Vec4::from_array(std::array::from_fn(|i| f32::from(four[i]))))
    }

    /// Writes the numbers to the place that [`Lane::of`] reads.
    #[inline]
    pub(crate) fn write(self, row: &mut [f32], l: usize) {
        row[WIDTH * l..][..WIDTH].copy_from_slice(self.0.as_ref());
    }

    /// Applies a function to each number.
    #[inline]
    pub(crate) fn map(self, f: impl Fn(f32) -> f32) -> Self {
        Self(Vec4::from_array(self.to_array().map(f)))
    }

    /// The four numbers.
    #[inline]
    pub(crate) fn to_array(self) -> [f32; WIDTH] {
        self.0.to_array()
    }

    /// The sum of the four numbers, always in this order.
    #[inline]
    pub(crate) fn sum(self) -> f32 {
        let [a, b, c, d] = self.to_array();
        (a + b) + (c + d)
    }
}

impl Add for Lane {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
}

impl Sub for Lane {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0)
    }
}

impl Mul for Lane {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        Self(self.0 * other.0)
    }
}

impl Div for Lane {
    type Output = Self;
    #[inline]
    fn div(self, other: Self) -> Self {
        Self(self.0 / other.0)
    }
}

impl AddAssign for Lane {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        self.0 += other.0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn operations_are_those_of_each_number() {
        let row: [f32; 8] = std::array::from_fn(|i| i as f32);
        let (a, b) = (Lane::of(&row, 0), Lane::of(&row, 1));
        assert_eq!(((a + b) * b - a / b).to_array(), [16.0, 30.0 - 0.2, 48.0 - 2.0 / 6.0, 70.0 - 3.0 / 7.0]);
        assert_eq!(b.sum(), 22.0);
        let mut copy = [0.0; 8];
        (a + Lane::splat(1.0)).map(|v| -v).write(&mut copy, 1);
        assert_eq!(copy, [0.0, 0.0, 0.0, 0.0, -1.0, -2.0, -3.0, -4.0]);
    }
}
