//! Sums of products in a fixed order. nalgebra's own matrix product uses instructions that only some CPUs have, and its
//! last bits depend on them.

use nalgebra::DMatrix;

/// Sum of products in eight lanes.
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut lanes = [0.0; 8];
    let (a_lanes, b_lanes) = (a.chunks_exact(8), b.chunks_exact(8));
    let rest: f64 = a_lanes.remainder().iter().zip(b_lanes.remainder()).map(|(a, b)| a * b).sum();
    for (a, b) in a_lanes.zip(b_lanes) {
        for i in 0..8 {
            lanes[i] += a[i] * b[i];
        }
    }
    lanes.iter().sum::<f64>() + rest
}

/// The matrix product a · b.
pub(super) fn product(a: &DMatrix<f64>, b: &DMatrix<f64>) -> DMatrix<f64> {
    let mut out = DMatrix::zeros(a.nrows(), b.ncols());
    for j in 0..b.ncols() {
        let mut column = out.column_mut(j);
        for k in 0..a.ncols() {
            column.axpy(b[(k, j)], &a.column(k), 1.0);
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_are_those_of_the_definition() {
        let a: Vec<f64> = (0..19).map(f64::from).collect();
        assert_eq!(dot(&a, &a), 2109.0);
        assert_eq!(dot(&a[..3], &a[..3]), 5.0);
        let m = DMatrix::from_row_slice(2, 3, &a[..6]);
        assert_eq!(product(&m, &m.transpose()), &m * m.transpose());
    }
}
