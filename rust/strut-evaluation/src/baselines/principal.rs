//! Principal components.

use nalgebra::{DMatrix, SymmetricEigen};

/// Mean and leading principal directions of some vectors.
#[derive(Clone, Debug)]
pub(super) struct Principal {
    mean: Vec<f64>,
    /// Directions of unit length in sequence, by decreasing variance.
    directions: Vec<f64>,
    /// Variance of the vectors along each direction.
    variance: Vec<f64>,
}

impl Principal {
    /// Computes the principal components of the vectors of `width` numbers in `data`; at most `count` directions, only
    /// those of positive variance.
    pub(super) fn new(data: &[f64], width: usize, count: usize) -> Self {
        let n = (data.len() / width).max(1) as f64;
        let mut mean = vec![0.0; width];
        for vector in data.chunks_exact(width) {
            mean.iter_mut().zip(vector).for_each(|(m, v)| *m += v / n);
        }
        let mut covariance = DMatrix::<f64>::zeros(width, width);
        let mut centred = vec![0.0; width];
        for vector in data.chunks_exact(width) {
            centred.iter_mut().zip(vector.iter().zip(&mean)).for_each(|(c, (v, m))| *c = v - m);
            for (j, column) in covariance.as_mut_slice().chunks_exact_mut(width).enumerate() {
                let c = centred[j] / n;
                column.iter_mut().zip(&centred).for_each(|(sum, v)| *sum += c * v);
            }
        }
        let eigen = SymmetricEigen::new(covariance);
        let mut order: Vec<usize> = (0..width).collect();
        order.sort_by(|&a, &b| eigen.eigenvalues[b].total_cmp(&eigen.eigenvalues[a]).then(a.cmp(&b)));
        let negligible = 1e-9 * eigen.eigenvalues.iter().copied().fold(0.0, f64::max);
        order.retain(|&i| eigen.eigenvalues[i] > negligible);
        order.truncate(count);
        let directions = order.iter().flat_map(|&i| eigen.eigenvectors.column(i).iter().copied().collect::<Vec<_>>());
        Self { mean, directions: directions.collect(), variance: order.iter().map(|&i| eigen.eigenvalues[i]).collect() }
    }

    /// Number of components.
    pub(super) fn len(&self) -> usize {
        self.variance.len()
    }

    /// Variance along each direction.
    pub(super) fn variance(&self) -> &[f64] {
        &self.variance
    }

    /// Writes the components of a vector, [`Principal::len`] numbers.
    pub(super) fn project(&self, vector: &[f64], out: &mut [f64]) {
        for (out, direction) in out.iter_mut().zip(self.directions.chunks_exact(self.mean.len())) {
            *out = direction.iter().zip(vector.iter().zip(&self.mean)).map(|(d, (v, m))| d * (v - m)).sum();
        }
    }

    /// Writes the vector with these components.
    pub(super) fn reconstruct(&self, components: &[f64], out: &mut [f64]) {
        out.copy_from_slice(&self.mean);
        for (c, direction) in components.iter().zip(self.directions.chunks_exact(self.mean.len())) {
            out.iter_mut().zip(direction).for_each(|(o, d)| *o += c * d);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vectors_in_a_plane_have_two_components_and_come_back() {
        let plane = |i: usize| {
            let (a, b) = (0.1 * i as f64, f64::from((i * i) as u32 % 7));
            [1.0 + a + b, 2.0 - a, 3.0 + 2.0 * b, a - b]
        };
        let data: Vec<f64> = (0..50).flat_map(plane).collect();
        let p = Principal::new(&data, 4, 3);
        assert_eq!(p.len(), 2);
        assert!(p.variance()[0] > p.variance()[1]);
        let (mut components, mut back) = ([0.0; 2], [0.0; 4]);
        p.project(&plane(60), &mut components);
        p.reconstruct(&components, &mut back);
        assert!(back.iter().zip(plane(60)).all(|(a, b)| (a - b).abs() < 1e-9));
        assert_eq!(Principal::new(&[1.0, 2.0], 2, 3).len(), 0);
    }
}
