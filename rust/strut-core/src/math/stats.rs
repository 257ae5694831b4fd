//! Statistics of numbers.

/// The mean of points; 0 without any.
pub fn mean_of<const D: usize>(points: &[[f64; D]]) -> [f64; D] {
    let share = 1.0 / points.len().max(1) as f64;
    let mut mean = [0.0; D];
    for point in points {
        mean.iter_mut().zip(point).for_each(|(sum, v)| *sum += v * share);
    }
    mean
}
