//! Motion statistics: a performance summarised in numbers, independent of its length and phase.
//!
//! Performances are compared by the mean position of each joint and its deviation from it. The unit of every statistic is the
//! spread of the takes of a class, which is unintended variation.

use super::parts::PointCloud;
use crate::humanoid::JOINTS;
use crate::math::stats::mean_of;

/// Coordinates of all joints.
const COORDINATES: usize = 3 * JOINTS;
/// Number of statistics of a performance.
pub const STATISTICS: usize = 2 * COORDINATES;
/// Statistics whose spread over takes is smaller than this are ignored, metres: those of the hips, to which the others are
/// relative.
const MIN_SPREAD: f64 = 1e-4;

/// The mean of every joint coordinate over the frames, then the standard deviation of each; metres.
pub type MotionStatistics = [f64; STATISTICS];

/// Computes the statistics of a performance, from joint positions without place and heading; 0 without frames.
pub fn motion_statistics(points: &[PointCloud]) -> MotionStatistics {
    let share = 1.0 / points.len().max(1) as f64;
    let mut mean = [0.0; COORDINATES];
    for frame in points {
        each_coordinate(frame, |i, v| mean[i] += v * share);
    }
    let mut variance = [0.0; COORDINATES];
    for frame in points {
        each_coordinate(frame, |i, v| variance[i] += (v - mean[i]) * (v - mean[i]) * share);
    }
    std::array::from_fn(|i| if i < COORDINATES { mean[i] } else { variance[i - COORDINATES].sqrt() })
}

fn each_coordinate(frame: &PointCloud, mut visit: impl FnMut(usize, f64)) {
    for (joint, point) in frame.iter().enumerate() {
        for (axis, v) in point.to_array().into_iter().enumerate() {
            visit(3 * joint + axis, f64::from(v));
        }
    }
}

/// Spread of the takes of a class in every statistic: their standard deviation within classes, over many classes.
#[derive(Clone, Debug, PartialEq)]
pub struct TakeSpread {
    /// Inverse of the spread by statistic, 1/metre; 0 for a statistic without spread.
    scale: MotionStatistics,
}

impl TakeSpread {
    /// Computes the spread of these classes' takes. Classes of one take do not contribute; without others there is no spread.
    pub fn of(classes: &[Vec<MotionStatistics>]) -> Self {
        let mut squares = [0.0; STATISTICS];
        for class in classes {
            let mean = mean_of(class);
            for take in class {
                for (sum, (v, mean)) in squares.iter_mut().zip(take.iter().zip(&mean)) {
                    *sum += (v - mean) * (v - mean);
                }
            }
        }
        let freedom: usize = classes.iter().map(|class| class.len().saturating_sub(1)).sum();
        let spread = squares.map(|sum| (sum / freedom.max(1) as f64).sqrt());
        Self { scale: spread.map(|s| if s > MIN_SPREAD { 1.0 / s } else { 0.0 }) }
    }

    /// Converts statistics to units of the spread; 0 without spread.
    pub fn standardised(&self, statistics: &MotionStatistics) -> MotionStatistics {
        std::array::from_fn(|i| statistics[i] * self.scale[i])
    }

    /// Root mean square distance of two takes of a class in standardised statistics; 0 without spread.
    pub fn distance_of_takes(&self) -> f64 {
        // The difference of two independent takes has twice the variance of one, which is 1.
        (2.0 * self.scale.iter().filter(|scale| **scale > 0.0).count() as f64).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vec3;

    #[test]
    fn statistics_are_where_joints_are_and_how_far_they_move() {
        let frame = |y: f32| std::array::from_fn(|j| if j == 4 { Vec3::new(0.5, y, 0.0) } else { Vec3::ZERO });
        let found = motion_statistics(&[frame(1.0), frame(2.0), frame(1.0), frame(2.0)]);
        let mut expected = [0.0; STATISTICS];
        expected[3 * 4] = 0.5;
        expected[3 * 4 + 1] = 1.5;
        expected[COORDINATES + 3 * 4 + 1] = 0.5;
        assert_eq!(found, expected);
        assert_eq!(motion_statistics(&[]), [0.0; STATISTICS]);
    }

    #[test]
    fn the_spread_of_takes_is_their_deviation_within_classes() {
        let take = |v: f64| std::array::from_fn(|i| if i == 7 { v } else { 1.0 });
        // Classes are far apart; within them takes are 1 and 2 from their mean.
        let classes = [vec![take(9.0), take(11.0)], vec![take(98.0), take(102.0)], vec![take(1000.0)]];
        let spread = TakeSpread::of(&classes);
        let unit = (10.0_f64 / 2.0).sqrt();
        let standardised = spread.standardised(&take(3.0));
        assert!((standardised[7] - 3.0 / unit).abs() < 1e-12 && standardised[6] == 0.0, "{standardised:?}");
        assert!((spread.distance_of_takes() - 2.0_f64.sqrt()).abs() < 1e-12);
    }

    #[test]
    fn single_takes_have_no_spread() {
        let spread = TakeSpread::of(&[vec![[1.0; STATISTICS]], vec![[5.0; STATISTICS]], Vec::new()]);
        assert_eq!(spread.standardised(&[3.0; STATISTICS]), [0.0; STATISTICS]);
        assert_eq!(spread.distance_of_takes(), 0.0);
    }
}
