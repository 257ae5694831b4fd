//! Statistics of numbers.

use std::ops::Range;

/// The median of numbers, the greater of the middle two if their count is even; `None` without any.
pub fn median(values: impl IntoIterator<Item = f64>) -> Option<f64> {
    middle_of(values.into_iter().collect())
}

/// [`median`] of a vector: compiled once for all kinds of iterators.
#[inline(never)]
fn middle_of(mut values: Vec<f64>) -> Option<f64> {
    let middle = values.len() / 2;
    (!values.is_empty()).then(|| *values.select_nth_unstable_by(middle, f64::total_cmp).1)
}

/// The number at a share, 0 to 1, of ascending numbers, by the nearest rank; 0 without any.
pub(crate) fn quantile(sorted: &[f32], share: f32) -> f32 {
    let last = sorted.len().saturating_sub(1);
    sorted.get((share * last as f32).round() as usize).copied().unwrap_or(0.0)
}

/// Runs of successive indices below `count` that satisfy a predicate, each as long as possible.
pub fn runs_where(count: usize, holds: impl Fn(usize) -> bool) -> Vec<Range<usize>> {
    let mut runs: Vec<Range<usize>> = Vec::new();
    for i in (0..count).filter(|&i| holds(i)) {
        match runs.last_mut() {
            Some(run) if run.end == i => run.end = i + 1,
            _ => runs.push(i..i + 1),
        }
    }
    runs
}

/// The mean of points; 0 without any.
pub fn mean_of<const D: usize>(points: &[[f64; D]]) -> [f64; D] {
    let share = 1.0 / points.len().max(1) as f64;
    let mut mean = [0.0; D];
    for point in points {
        mean.iter_mut().zip(point).for_each(|(sum, v)| *sum += v * share);
    }
    mean
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_is_the_greater_of_the_middle_two() {
        assert_eq!(median([]), None);
        assert_eq!(median([3.0, 1.0, 2.0]), Some(2.0));
        assert_eq!(median([4.0, 1.0, 2.0, 3.0]), Some(3.0));
    }

    #[test]
    fn runs_are_as_long_as_possible() {
        let holds = [true, true, false, true, false, false, true];
        assert_eq!(runs_where(7, |i| holds[i]), [0..2, 3..4, 6..7]);
        assert!(runs_where(0, |_| true).is_empty());
    }
}
