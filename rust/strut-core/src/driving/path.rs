//! A path on the ground, parametrised by arc length.

use crate::math::Vec2;

/// Paths with more points than this are thinned.
const MAX_POINTS: usize = 512;
/// Range ahead of the progress in which the nearest point is searched, metres: a path may cross itself.
const REACH: f32 = 0.6;
/// Points nearer to each other than this are merged, metres.
const LEAST_DISTANCE: f32 = 1e-3;
/// Step of the search for the nearest point, metres.
const STEP: f32 = 0.02;

/// A line of at least two points.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    points: Vec<Vec2>,
    /// Length of the line up to every point, metres.
    lengths: Vec<f32>,
}

impl Path {
    /// Creates the line through points (x, z), metres; `None` if fewer than two are distinct, or one is not finite.
    pub fn new(points: &[Vec2]) -> Option<Self> {
        if !points.iter().all(|p| p.is_finite()) {
            return None;
        }
        let stride = points.len().div_ceil(MAX_POINTS).max(1);
        let last = points.len().checked_sub(1)?;
        let mut of = Self { points: vec![points[0]], lengths: vec![0.0] };
        for i in (stride..last).step_by(stride).chain([last]) {
            let (before, to) = (of.points[of.points.len() - 1], points[i]);
            let distance = before.distance(to);
            if distance > LEAST_DISTANCE {
                of.points.push(to);
                of.lengths.push(of.length() + distance);
            }
        }
        (of.points.len() > 1).then_some(of)
    }

    /// Length, metres.
    pub fn length(&self) -> f32 {
        self.lengths[self.lengths.len() - 1]
    }

    /// Returns the point at an arc length, clamped to the ends.
    pub fn at(&self, length: f32) -> Vec2 {
        let (from, to) = self.piece(length);
        let (a, b) = (self.lengths[from], self.lengths[to]);
        let t = ((length - a) / (b - a)).clamp(0.0, 1.0);
        self.points[from] + (self.points[to] - self.points[from]) * t
    }

    /// Returns the unit direction at an arc length.
    pub fn direction(&self, length: f32) -> Vec2 {
        let (from, to) = self.piece(length);
        (self.points[to] - self.points[from]) / (self.lengths[to] - self.lengths[from])
    }

    /// Returns the arc length at which the path is nearest to a place, between `progress` and a short distance ahead of
    /// it.
    pub fn nearest(&self, progress: f32, place: Vec2) -> f32 {
        let steps = (REACH / STEP) as u32;
        let lengths = (0..=steps).map(|i| (progress + i as f32 * STEP).min(self.length()));
        let distance = |length: f32| self.at(length).distance_squared(place);
        lengths.reduce(|best, other| if distance(other) < distance(best) { other } else { best }).unwrap_or(progress)
    }

    /// The points before and after an arc length.
    fn piece(&self, length: f32) -> (usize, usize) {
        let to = self.lengths.partition_point(|&l| l < length).clamp(1, self.points.len() - 1);
        (to - 1, to)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn has_a_point_and_a_direction_at_every_length() {
        let path = Path::new(&[Vec2::ZERO, Vec2::new(0.0, 2.0), Vec2::new(3.0, 2.0)]).unwrap();
        assert_eq!((path.length(), path.at(1.0), path.at(3.5)), (5.0, Vec2::new(0.0, 1.0), Vec2::new(1.5, 2.0)));
        assert_eq!((path.at(-1.0), path.at(9.0)), (Vec2::ZERO, Vec2::new(3.0, 2.0)));
        assert_eq!((path.direction(0.5), path.direction(4.0)), (Vec2::Y, Vec2::X));
    }

    #[test]
    fn needs_two_distinct_points_that_are_finite() {
        assert_eq!(Path::new(&[]), None);
        assert_eq!(Path::new(&[Vec2::ONE; 5]), None);
        assert_eq!(Path::new(&[Vec2::ZERO, Vec2::new(f32::NAN, 1.0)]), None);
    }

    #[test]
    fn of_many_points_is_thinned_and_keeps_its_ends() {
        let circle: Vec<Vec2> = (0..10_000).map(|i| Vec2::from_angle(i as f32 * 6e-4) * 10.0).collect();
        let path = Path::new(&circle).unwrap();
        assert!(path.points.len() <= MAX_POINTS + 1);
        assert_eq!((path.at(0.0), path.at(path.length())), (circle[0], circle[9_999]));
    }

    proptest! {
        #[test]
        fn progress_never_falls_and_never_leaps(
            points in prop::collection::vec((-5.0_f32..5.0, -5.0_f32..5.0), 2..20),
            places in prop::collection::vec((-6.0_f32..6.0, -6.0_f32..6.0), 1..50),
        ) {
            let points: Vec<Vec2> = points.into_iter().map(Vec2::from).collect();
            if let Some(path) = Path::new(&points) {
                let mut progress = 0.0;
                for place in places {
                    let next = path.nearest(progress, place.into());
                    prop_assert!((progress..=progress + REACH + STEP).contains(&next) && next <= path.length());
                    progress = next;
                }
            }
        }
    }
}
