//! Means and deviations of rows that are added in order, in parts of any length.

use crate::pose_vector::{DOFS, PoseRow, ROW};

/// Sums and ranges of rows.
#[derive(Clone, Debug)]
pub(crate) struct RowSums {
    count: usize,
    sums: [f64; ROW],
    range: [PoseRow; 2],
}

impl Default for RowSums {
    fn default() -> Self {
        Self { count: 0, sums: [0.0; ROW], range: [[0.0; ROW]; 2] }
    }
}

impl RowSums {
    pub(crate) fn add(&mut self, rows: &[PoseRow]) {
        if let (0, Some(first)) = (self.count, rows.first()) {
            self.range = [*first; 2];
        }
        self.count += rows.len();
        for row in rows {
            add(row, &mut self.sums);
            widen(&mut self.range, row);
        }
    }

    /// Means of the rows so far.
    pub(crate) fn mean(&self) -> RowMean {
        let n = self.count.max(1) as f64;
        RowMean { n, mean: self.sums.map(|sum| sum / n) }
    }

    /// Least and greatest values so far.
    pub(crate) fn range(&self) -> [PoseRow; 2] {
        self.range
    }
}

/// Mean of a set of rows.
#[derive(Clone, Debug)]
pub(crate) struct RowMean {
    n: f64,
    mean: [f64; ROW],
}

/// Sums of the squared differences of rows from their mean.
#[derive(Clone, Debug)]
pub(crate) struct RowSquares {
    around: RowMean,
    sums: [f64; ROW],
}

impl RowSquares {
    pub(crate) fn around(around: RowMean) -> Self {
        Self { around, sums: [0.0; ROW] }
    }

    pub(crate) fn add(&mut self, rows: &[PoseRow]) {
        for row in rows {
            add_squared_differences(row, &self.around.mean, &mut self.sums);
        }
    }

    /// Standard deviations, floored at 1e-4; padding is 1.
    pub(crate) fn deviation(&self) -> PoseRow {
        let deviation = |d: usize| (self.sums[d] / self.around.n).sqrt() as f32;
        std::array::from_fn(|d| if d < DOFS { deviation(d).max(1e-4) } else { 1.0 })
    }
}

/// Sums of the steps from one row of a clip to the next.
#[derive(Clone, Debug)]
pub(crate) struct StepSums {
    count: f64,
    sums: [f64; ROW],
    squares: [f64; ROW],
}

impl Default for StepSums {
    fn default() -> Self {
        Self { count: 0.0, sums: [0.0; ROW], squares: [0.0; ROW] }
    }
}

impl StepSums {
    /// Adds the step between two rows.
    pub(crate) fn add(&mut self, from: &PoseRow, to: &PoseRow) {
        self.count += 1.0;
        add_step([from, to], &mut self.sums, &mut self.squares);
    }

    /// Standard deviations, floored at 1e-5; padding is 1.
    pub(crate) fn deviation(&self) -> PoseRow {
        let n = self.count.max(1.0);
        let [sums, squares] = [&self.sums, &self.squares];
        let deviation = |d: usize| (squares[d] / n - (sums[d] / n) * (sums[d] / n)).max(0.0).sqrt() as f32;
        std::array::from_fn(|d| if d < DOFS { deviation(d).max(1e-5) } else { 1.0 })
    }
}

#[inline(never)] // In WebAssembly a function is optimised once it has been called often.
fn add(row: &PoseRow, sums: &mut [f64; ROW]) {
    sums.iter_mut().zip(row).for_each(|(sum, &v)| *sum += f64::from(v));
}

#[inline(never)] // In WebAssembly a function is optimised once it has been called often.
fn add_squared_differences(row: &PoseRow, mean: &[f64; ROW], sums: &mut [f64; ROW]) {
    for ((sum, mean), &v) in sums.iter_mut().zip(mean).zip(row) {
        let difference = f64::from(v) - mean;
        *sum += difference * difference;
    }
}

#[inline(never)] // In WebAssembly a function is optimised once it has been called often.
fn add_step([from, to]: [&PoseRow; 2], sums: &mut [f64; ROW], squares: &mut [f64; ROW]) {
    for (d, (sum, square)) in sums.iter_mut().zip(squares).enumerate() {
        let step = f64::from(to[d]) - f64::from(from[d]);
        *sum += step;
        *square += step * step;
    }
}

#[inline(never)] // In WebAssembly a function is optimised once it has been called often.
fn widen([least, greatest]: &mut [PoseRow; 2], row: &PoseRow) {
    for ((least, greatest), &v) in least.iter_mut().zip(greatest).zip(row) {
        // `f32::min` would be a function call in WebAssembly.
        *least = if v < *least { v } else { *least };
        *greatest = if v > *greatest { v } else { *greatest };
    }
}
