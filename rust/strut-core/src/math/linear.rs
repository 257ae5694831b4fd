//! Small dense systems of linear equations.

/// Solves A x = b for a symmetric positive definite A: see [`Factors`].
///
/// `matrix` holds A row by row and is overwritten; `right` holds b and becomes x. `None`, with both in an unspecified
/// state, if A is not positive definite to working precision.
pub(crate) fn solve_positive_definite(matrix: &mut [f64], right: &mut [f64]) -> Option<()> {
    Factors::of(matrix, right.len())?.solve(right);
    Some(())
}

/// The square-root-free Cholesky decomposition A = L D Lᵀ of a symmetric positive definite matrix.
#[derive(Debug)]
pub(crate) struct Factors<'a> {
    /// Row by row: D Lᵀ on and above the diagonal, L below.
    rows: &'a [f64],
    n: usize,
}

impl<'a> Factors<'a> {
    /// Decomposes the matrix of `n` rows in place. `None`, with it in an unspecified state, if a pivot is not positive and
    /// finite: A is not positive definite to working precision.
    pub(crate) fn of(matrix: &'a mut [f64], n: usize) -> Option<Self> {
        for i in 0..n {
            let pivot = matrix[i * n + i];
            if !(pivot > 0.0 && pivot.is_finite()) {
                return None;
            }
            for j in i + 1..n {
                let factor = matrix[j * n + i] / pivot;
                matrix[j * n + i] = factor;
                for k in i + 1..n {
                    matrix[j * n + k] -= factor * matrix[i * n + k];
                }
            }
        }
        Some(Self { rows: matrix, n })
    }

    /// Solves A x = b: `right` holds b and becomes x.
    pub(crate) fn solve(&self, right: &mut [f64]) {
        let Self { rows, n } = *self;
        for i in 0..n {
            for j in i + 1..n {
                right[j] -= rows[j * n + i] * right[i];
            }
        }
        for i in (0..n).rev() {
            let known: f64 = (i + 1..n).map(|k| rows[i * n + k] * right[k]).sum();
            right[i] = (right[i] - known) / rows[i * n + i];
        }
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
            solve_positive_definite(&mut matrix, &mut right).unwrap();
            for (found, x) in right.iter().zip(x) {
                prop_assert!((found - x).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn matrices_that_are_not_positive_definite_are_refused() {
        for matrix in [[0.0, 0.0, 0.0, 0.0], [1.0, 1.0, 1.0, 1.0], [1.0, 2.0, 2.0, 1.0], [-1.0, 0.0, 0.0, 1.0]] {
            assert_eq!(solve_positive_definite(&mut matrix.clone(), &mut [1.0, 2.0]), None, "{matrix:?}");
        }
        for bad in [f64::NAN, f64::INFINITY] {
            assert_eq!(solve_positive_definite(&mut [bad, 0.0, 0.0, 1.0], &mut [1.0, 2.0]), None);
            assert_eq!(solve_positive_definite(&mut [1.0, 0.0, 0.0, bad], &mut [1.0, 2.0]), None);
        }
    }
}
