//! Smoothing by local cubics (Savitzky and Golay 1964): the value of a least-squares cubic in the middle of a window of
//! samples.

/// Coefficients of a cubic.
const TERMS: usize = 4;

/// The values of least-squares cubics over windows of `2 half + 1` samples, truncated at the ends.
pub(super) fn smoothed(samples: &[[f64; 2]], half: usize) -> Vec<[f64; 2]> {
    (0..samples.len())
        .map(|i| {
            let window = i.saturating_sub(half)..(i + half + 1).min(samples.len());
            let terms = TERMS.min(window.len());
            // The normal equations Σ tʲ⁺ᵏ cₖ = Σ tʲ y, with t the distance from the middle in half windows.
            let mut moments = [0.0; 2 * TERMS - 1];
            let mut right = [[0.0; 2]; TERMS];
            for s in window {
                let t = (s as f64 - i as f64) / half.max(1) as f64;
                let mut power = 1.0;
                for (k, moment) in moments.iter_mut().enumerate() {
                    *moment += power;
                    if k < TERMS {
                        right[k][0] += power * samples[s][0];
                        right[k][1] += power * samples[s][1];
                    }
                    power *= t;
                }
            }
            constant_term(moments, right, terms)
        })
        .collect()
}

/// The constant term of the cubic that solves the normal equations, by elimination from the highest power down.
fn constant_term(moments: [f64; 2 * TERMS - 1], mut right: [[f64; 2]; TERMS], terms: usize) -> [f64; 2] {
    let mut matrix: [[f64; TERMS]; TERMS] = std::array::from_fn(|j| std::array::from_fn(|k| moments[j + k]));
    for pivot in (1..terms).rev() {
        for row in 0..pivot {
            let (above, below) = matrix.split_at_mut(pivot);
            let factor = above[row][pivot] / below[0][pivot];
            for (value, subtracted) in above[row].iter_mut().zip(&below[0]) {
                *value -= factor * subtracted;
            }
            let [x, z] = right[pivot].map(|y| factor * y);
            right[row] = [right[row][0] - x, right[row][1] - z];
        }
    }
    right[0].map(|y| y / matrix[0][0])
}

#[cfg(test)]
mod tests {
    use super::smoothed;

    #[test]
    fn leaves_cubics_as_they_are() {
        let cubic = |t: f64| [0.2 * t * t * t - t * t + 3.0, 5.0 - 2.0 * t];
        let samples: Vec<[f64; 2]> = (0..50).map(|i| cubic(f64::from(i) / 10.0)).collect();
        for (smooth, sample) in smoothed(&samples, 15).iter().zip(&samples) {
            assert!((0..2).all(|axis| (smooth[axis] - sample[axis]).abs() < 1e-8), "{smooth:?} {sample:?}");
        }
    }

    #[test]
    fn removes_nyquist_component() {
        let samples: Vec<[f64; 2]> = (0..60).map(|i| [if i % 2 == 0 { 1.0 } else { -1.0 }, 0.0]).collect();
        assert!(smoothed(&samples, 15)[20..40].iter().all(|[x, _]| x.abs() < 0.1));
    }

    #[test]
    fn has_a_value_for_every_sample_of_short_series() {
        for n in 0..5_u32 {
            let samples: Vec<[f64; 2]> = (0..n).map(|i| [f64::from(i), 1.0]).collect();
            assert_eq!(smoothed(&samples, 30).len(), samples.len());
            assert!(smoothed(&samples, 30).iter().flatten().all(|v| v.is_finite()));
        }
    }
}
