//! Small dense systems of linear equations.

/// Solves A x = b for a symmetric positive definite A, row by row, which is overwritten; `right` becomes x.
pub(crate) fn solve_symmetric(matrix: &mut [f64], right: &mut [f64]) {
    let n = right.len();
    for i in 0..n {
        for j in i + 1..n {
            let factor = matrix[j * n + i] / matrix[i * n + i];
            for k in i..n {
                matrix[j * n + k] -= factor * matrix[i * n + k];
            }
            right[j] -= factor * right[i];
        }
    }
    for i in (0..n).rev() {
        let known: f64 = (i + 1..n).map(|k| matrix[i * n + k] * right[k]).sum();
        right[i] = (right[i] - known) / matrix[i * n + i];
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_solution_solves(rows in prop::collection::vec(prop::array::uniform6(-1.0f64..1.0), 6), x in prop::array::uniform6(-2.0f64..2.0)) {
            // R Rᵀ + I is positive definite.
            let entry = |i: usize, j: usize| {
                (0..6).map(|k| rows[i][k] * rows[j][k]).sum::<f64>() + f64::from(u8::from(i == j))
            };
            let mut matrix: Vec<f64> = (0..36).map(|n| entry(n / 6, n % 6)).collect();
            let mut right: Vec<f64> = (0..6).map(|i| (0..6).map(|j| entry(i, j) * x[j]).sum()).collect();
            solve_symmetric(&mut matrix, &mut right);
            for (found, x) in right.iter().zip(x) {
                prop_assert!((found - x).abs() < 1e-9);
            }
        }
    }
}
