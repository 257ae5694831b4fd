//! Gaussian weights, and smoothing of short sequences with them.

use super::float_funcs::exp;

/// Weight of an offset under a Gaussian with this standard deviation, 1 at offset 0; both in the same unit.
pub fn weight(offset: f32, sigma: f32) -> f32 {
    exp(-0.5 * (offset / sigma) * (offset / sigma))
}

/// Weights of offsets 0, 1, … of a Gaussian with this deviation in frames, cut at 3 σ, summing to 1 over
/// both sides; a single 1 if σ is not positive.
fn kernel(sigma: f32) -> Vec<f32> {
    if sigma <= 0.0 {
        return vec![1.0];
    }
    let reach = (3.0 * sigma).ceil() as usize;
    let mut weights: Vec<f32> = (0..=reach).map(|k| weight(k as f32, sigma)).collect();
    let sum = weights[0] + 2.0 * weights[1..].iter().sum::<f32>();
    for w in &mut weights {
        *w /= sum;
    }
    weights
}

/// Smooths the values; the end values are repeated beyond the ends.
pub(crate) fn smoothed(values: &[f32], sigma_frames: f32) -> Vec<f32> {
    let last = values.len() as isize - 1;
    convolved(values, sigma_frames, |i| values[i.clamp(0, last) as usize])
}

/// Smooths the values, reflected through the end points beyond the ends: the ends keep their values, a straight line stays
/// straight, and an increasing sequence stays increasing, its slopes within their range. σ is at most a third of the
/// sequence, so that no value beyond the reflection is needed.
pub(crate) fn smoothed_with_fixed_ends(values: &[f32], sigma_frames: f32) -> Vec<f32> {
    let last = values.len() as isize - 1;
    let sigma_frames = sigma_frames.min((last / 3).max(0) as f32);
    let beyond = |i: isize, end: isize| {
        let mirrored = (2 * end - i).clamp(0, last);
        2.0 * values[end as usize] - values[mirrored as usize]
    };
    convolved(values, sigma_frames, |i| {
        if i < 0 {
            beyond(i, 0)
        } else if i > last {
            beyond(i, last)
        } else {
            values[i as usize]
        }
    })
}

fn convolved(values: &[f32], sigma_frames: f32, at: impl Fn(isize) -> f32) -> Vec<f32> {
    let kernel = kernel(sigma_frames);
    (0..values.len() as isize)
        .map(|i| {
            let pairs = kernel.iter().enumerate().skip(1);
            kernel[0] * values[i as usize]
                + pairs.map(|(k, w)| w * (at(i - k as isize) + at(i + k as isize))).sum::<f32>()
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn fixed_ends_keep_ends_and_order(steps in prop::collection::vec(0.34f32..3.0, 1..40), sigma in 0.0f32..4.0) {
            let mut path = vec![0.0];
            for s in &steps {
                path.push(path[path.len() - 1] + s);
            }
            let smooth = smoothed_with_fixed_ends(&path, sigma);
            prop_assert!((smooth[0]).abs() < 1e-3);
            prop_assert!((smooth[steps.len()] - path[steps.len()]).abs() < 1e-3);
            for (a, b) in smooth.iter().zip(&smooth[1..]) {
                prop_assert!(b - a > 0.33 && b - a < 3.01, "{smooth:?}");
            }
        }
    }

    #[test]
    fn a_constant_stays_and_a_step_is_spread_evenly() {
        assert!(smoothed(&[2.0; 9], 1.5).iter().all(|v| (v - 2.0).abs() < 1e-6));
        let step = smoothed(&[0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0], 1.0);
        assert!((step[3] + step[4] - 1.0).abs() < 1e-6 && step[3] > 0.1);
        assert!(smoothed(&[], 1.0).is_empty());
    }
}
