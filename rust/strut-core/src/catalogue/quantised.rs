//! Rows of degrees of freedom as 16-bit integers: half the memory, and half the memory accesses per frame.
//!
//! A step is the 65,534th part of a degree of freedom's range in the database: about 1e-5 … 1e-4 rad. In styled clips
//! of motion capture half the channels change by less than 2e-5°, and one in a hundred by 1e-3°.

use crate::math::lanes::{Lane, WIDTH};
use crate::pose_vector::{PoseRow, ROW};

/// Rows that can be read four degrees of freedom at a time.
pub(crate) trait Rows {
    /// Values 4 `l` … of a row.
    fn lane(&self, row: usize, l: usize) -> Lane;

    /// Values of the previous row and of the row, as a function of `l`.
    #[inline]
    fn pair(&self, row: usize) -> impl Fn(usize) -> [Lane; 2] {
        move |l| [self.lane(row - 1, l), self.lane(row, l)]
    }
}

impl Rows for [PoseRow] {
    #[inline]
    fn lane(&self, row: usize, l: usize) -> Lane {
        Lane::of(&self[row], l)
    }
}

/// A row as integers.
pub(super) type Steps = [i16; ROW];

/// Conversion between integers and values within a range.
#[derive(Clone, Debug)]
pub(super) struct Quantiser {
    middle: PoseRow,
    step: PoseRow,
    /// The step; infinite if it is zero.
    divisor: PoseRow,
}

impl Quantiser {
    /// Quantiser for values between the least and the greatest of `range`.
    pub(super) fn new([least, greatest]: &[PoseRow; 2]) -> Self {
        let step: PoseRow = std::array::from_fn(|d| (greatest[d] - least[d]) / (2.0 * f32::from(i16::MAX)));
        Self {
            middle: std::array::from_fn(|d| 0.5 * (least[d] + greatest[d])),
            divisor: step.map(|step| if step > 0.0 { step } else { f32::INFINITY }),
            step,
        }
    }

    #[inline(never)] // In WebAssembly a function is optimised once it has been called often.
    pub(super) fn quantised(&self, row: &PoseRow) -> Steps {
        let mut steps = [0; ROW];
        for (l, four) in steps.chunks_exact_mut(WIDTH).enumerate() {
            let exact = (Lane::of(row, l) - Lane::of(&self.middle, l)) / Lane::of(&self.divisor, l);
            for (steps, exact) in four.iter_mut().zip(exact.to_array()) {
                // If the range is narrow and far from zero, the rounding error of its middle may be a step.
                let limited = exact.clamp(-f32::from(i16::MAX), f32::from(i16::MAX));
                // Rounded to nearest by truncating a positive number.
                *steps = ((limited + 65_536.5) as i32 - 65_536) as i16;
            }
        }
        steps
    }

    /// Row of these integers.
    pub(super) fn row(&self, steps: &Steps) -> PoseRow {
        std::array::from_fn(|d| self.middle[d] + self.step[d] * f32::from(steps[d]))
    }

    /// Values 4 `l` … of the row of these integers.
    #[inline]
    pub(super) fn lane(&self, steps: &Steps, l: usize) -> Lane {
        Lane::of(&self.middle, l) + Lane::of(&self.step, l) * Lane::of_integers(steps, l)
    }
}

/// Rows, quantised.
#[derive(Clone, Debug)]
pub struct QuantisedRows {
    quantiser: Quantiser,
    /// Parts of [`PART`] rows; the last may be shorter.
    parts: Vec<Vec<Steps>>,
}

/// Number of rows of a part, small enough that parts fit in memory freed from larger data.
const PART: usize = 4096;

impl QuantisedRows {
    /// Reserves memory for `capacity` rows between the least and the greatest values of `range`.
    pub(super) fn with_range(range: &[PoseRow; 2], capacity: usize) -> Self {
        Self { quantiser: Quantiser::new(range), parts: Vec::with_capacity(capacity.div_ceil(PART)) }
    }

    /// Memory of this number of rows, bytes.
    pub(super) fn bytes(rows: u64) -> u64 {
        let part = PART as u64;
        rows.div_ceil(part).saturating_mul(part * size_of::<Steps>() as u64)
    }

    pub(super) fn push(&mut self, row: &PoseRow) {
        let steps = self.quantiser.quantised(row);
        match self.parts.last_mut() {
            Some(part) if part.len() < PART => part.push(steps),
            _ => {
                let mut part = Vec::with_capacity(PART);
                part.push(steps);
                self.parts.push(part);
            }
        }
    }

    /// Quantiser of rows in the same range.
    pub(super) fn quantiser(&self) -> &Quantiser {
        &self.quantiser
    }

    /// A row.
    ///
    /// # Panics
    /// If the row does not exist.
    pub fn get(&self, row: usize) -> PoseRow {
        self.quantiser.row(self.steps(row))
    }

    /// Integers of a row, which must exist.
    #[inline]
    pub(super) fn steps(&self, row: usize) -> &Steps {
        &self.parts[row / PART][row % PART]
    }

    /// All rows.
    pub fn to_vec(&self) -> Vec<PoseRow> {
        self.parts.iter().flatten().enumerate().map(|(row, _)| self.get(row)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue::ExampleRows;
    use crate::pose_vector::LANES;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn rows_come_back_to_half_a_step_and_the_same_by_lanes(
            rows in prop::collection::vec(prop::array::uniform4(-4.0f32..4.0), 1..20),
        ) {
            // The last degree of freedom is the same in all rows.
            let rows: Vec<PoseRow> = rows
                .iter()
                .map(|four| std::array::from_fn(|d| if d + 1 < ROW { four[d % 4] * d as f32 } else { 0.7 }))
                .collect();
            let mut range = [rows[0]; 2];
            for row in &rows {
                range[0].iter_mut().zip(row).for_each(|(least, v)| *least = least.min(*v));
                range[1].iter_mut().zip(row).for_each(|(greatest, v)| *greatest = greatest.max(*v));
            }
            let mut quantised = QuantisedRows::with_range(&range, rows.len());
            for row in &rows {
                quantised.push(row);
            }
            for (i, row) in rows.iter().enumerate() {
                let found = quantised.get(i);
                for d in 0..ROW {
                    let step = (range[1][d] - range[0][d]) / 65_534.0;
                    prop_assert!((found[d] - row[d]).abs() <= 0.51 * step + 1e-6 * row[d].abs(), "{} {}", found[d], row[d]);
                }
                let by_lanes: Vec<f32> = (0..LANES).flat_map(|l| ExampleRows::Inputs(&quantised).lane(i, l).to_array()).collect();
                prop_assert_eq!(&by_lanes[..], &found[..]);
            }
        }
    }
}
