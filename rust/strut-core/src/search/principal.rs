//! Directions of greatest variance, by orthogonal iteration on the covariance.

/// A complex number.
pub(super) type Complex = [f64; 2];

/// Number of iterations. Any orthonormal directions give valid bounds; more iterations would slightly improve the last
/// ones.
const ITERATIONS: usize = 8;

/// The `count` orthonormal directions of greatest variance of vectors about zero; real for real vectors. `count` is at
/// most the dimension of the vectors.
pub(super) fn principal_directions(vectors: &[Vec<Complex>], dimension: usize, count: usize) -> Vec<Vec<Complex>> {
    let covariance = covariance(vectors, dimension);
    let mut seed = 1_u32;
    let mut random = || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(seed >> 8) / f64::from(1_u32 << 24) - 0.5
    };
    let mut directions: Vec<Vec<Complex>> =
        (0..count).map(|_| (0..dimension).map(|_| [random(), 0.0]).collect()).collect();
    orthonormalise(&mut directions);
    for _ in 0..ITERATIONS {
        for direction in &mut directions {
            *direction = covariance.chunks_exact(dimension).map(|row| product(direction, row)).collect();
        }
        orthonormalise(&mut directions);
    }
    directions
}

/// Σ v vᴴ, with a ridge that gives it full rank.
fn covariance(vectors: &[Vec<Complex>], dimension: usize) -> Vec<Complex> {
    let mut sums = vec![[0.0; 2]; dimension * dimension];
    for v in vectors {
        for (i, a) in v.iter().enumerate().filter(|(_, a)| **a != [0.0; 2]) {
            for (sum, b) in sums[i * dimension..].iter_mut().zip(&v[..=i]) {
                sum[0] += a[0] * b[0] + a[1] * b[1];
                sum[1] += a[1] * b[0] - a[0] * b[1];
            }
        }
    }
    let trace: f64 = (0..dimension).map(|i| sums[i * dimension + i][0]).sum();
    for i in 0..dimension {
        for j in 0..i {
            let [re, im] = sums[i * dimension + j];
            sums[j * dimension + i] = [re, -im];
        }
        sums[i * dimension + i][0] += 1e-9 * trace + 1e-30;
    }
    sums
}

/// Modified Gram–Schmidt orthonormalisation, done twice for accuracy if vectors are nearly parallel.
fn orthonormalise(vectors: &mut [Vec<Complex>]) {
    for i in 0..vectors.len() {
        let (done, rest) = vectors.split_at_mut(i);
        for _ in 0..2 {
            for d in &*done {
                let [re, im] = inner(&rest[0], d);
                for (v, d) in rest[0].iter_mut().zip(d) {
                    v[0] -= re * d[0] - im * d[1];
                    v[1] -= re * d[1] + im * d[0];
                }
            }
            let length = inner(&rest[0], &rest[0])[0].sqrt();
            rest[0].iter_mut().flatten().for_each(|v| *v /= length);
        }
    }
}

/// Σ a b.
fn product(a: &[Complex], b: &[Complex]) -> Complex {
    a.iter().zip(b).fold([0.0; 2], |s, (a, b)| [s[0] + a[0] * b[0] - a[1] * b[1], s[1] + a[0] * b[1] + a[1] * b[0]])
}

/// Σ a b*.
pub(super) fn inner(a: &[Complex], b: &[Complex]) -> Complex {
    a.iter().zip(b).fold([0.0; 2], |s, (a, b)| [s[0] + a[0] * b[0] + a[1] * b[1], s[1] + a[1] * b[0] - a[0] * b[1]])
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn vectors() -> impl Strategy<Value = Vec<Vec<Complex>>> {
        prop::collection::vec(prop::collection::vec(prop::array::uniform2(-1.0f64..1.0), 5), 0..12)
    }

    /// Share of the vectors' squared lengths that lies in the directions.
    fn captured(vectors: &[Vec<Complex>], directions: &[Vec<Complex>]) -> f64 {
        let all = vectors.iter().flat_map(|v| directions.iter().map(|d| inner(v, d)));
        all.map(|[re, im]| re * re + im * im).sum()
    }

    proptest! {
        #[test]
        fn directions_are_orthonormal_even_of_nothing(vectors in vectors(), count in 1usize..5) {
            let directions = principal_directions(&vectors, 5, count);
            for (i, a) in directions.iter().enumerate() {
                for (j, b) in directions.iter().enumerate() {
                    let [re, im] = inner(a, b);
                    prop_assert!((re - f64::from(u8::from(i == j))).abs() < 1e-12 && im.abs() < 1e-12);
                }
            }
        }

        #[test]
        fn they_capture_the_variance(mut vectors in vectors(), scale in 0.001f64..0.1) {
            // Two strong axes and three weak ones.
            for x in vectors.iter_mut().flat_map(|v| v[2..].iter_mut().flatten()) {
                *x *= scale;
            }
            let axes = |n: usize| (0..n).map(|i| (0..5).map(|j| [f64::from(u8::from(i == j)), 0.0]).collect()).collect::<Vec<_>>();
            let found = captured(&vectors, &principal_directions(&vectors, 5, 2));
            prop_assert!(found >= captured(&vectors, &axes(2)) * (1.0 - 1e-6));
            prop_assert!(found <= captured(&vectors, &axes(5)) * (1.0 + 1e-12));
        }
    }
}
