//! A route over the ground that the crowd follows.

use super::limits::{CrowdError, MAX_ROUTE_POINTS, check_place};
use crate::math::Vec2;

/// A route is a loop if its ends are nearer than this to each other, metres.
const LOOP: f32 = 2.0;
/// A route of less than this length, back and forth, is ignored, metres.
const SHORTEST: f32 = 0.1;
/// Distance ahead on the route of the place that agents walk to, metres.
const AHEAD: f32 = 2.5;
/// Area of the route per agent, m², and the least and the greatest width of the lanes beside it, metres.
const ROOM: f32 = 2.0;
const WIDTH: [f32; 2] = [1.0, 8.0];
/// Distance of the first lane to the right of the line, metres.
const ASIDE: f32 = 0.4;
/// How much farther than another a part of the route may be if its direction is the agent's, metres.
const TURNING_BACK: f32 = 3.0;

/// A line that is walked endlessly, as a loop or back and forth. Agents keep to the right of it.
#[derive(Clone, Debug, Default)]
pub(super) struct Route {
    /// Points of the closed line; the last one is followed by the first. Empty without a route.
    way: Vec<Vec2>,
    length: f32,
}

impl Route {
    /// Creates a route through points [x, z] on the ground, metres. No points, or points that are all in one place, give an
    /// empty route.
    pub(super) fn new(points: &[[f32; 2]]) -> Result<Self, CrowdError> {
        if points.len() == 1 || points.len() > MAX_ROUTE_POINTS {
            return Err(CrowdError::Route(points.len()));
        }
        points.iter().try_for_each(|point| check_place(*point))?;
        let mut way: Vec<Vec2> = points.iter().copied().map(Vec2::from).collect();
        if let [first, .., last] = way[..]
            && first.distance(last) >= LOOP
        {
            way.extend_from_within(1..way.len() - 1);
            way[points.len()..].reverse();
        }
        way.dedup();
        let mut route = Self { way, length: 0.0 };
        route.length = route.parts().map(|[from, to]| from.distance(to)).sum();
        Ok(if route.length >= SHORTEST { route } else { Self::default() })
    }

    /// Returns the place to walk to for an agent at a place with a unit direction, in a lane from 0 (next to the line) to 1
    /// of a route that `count` agents walk on; `None` without a route.
    pub(super) fn target(&self, at: Vec2, facing: Vec2, lane: f32, count: usize) -> Option<Vec2> {
        let cost = |[from, to]: [Vec2; 2]| {
            let way = to - from;
            let share = ((at - from).dot(way) / way.length_squared().max(f32::MIN_POSITIVE)).clamp(0.0, 1.0);
            let turning = 1.0 - facing.dot(way.normalize_or_zero());
            (at.distance(from + share * way) + TURNING_BACK / 2.0 * turning, share)
        };
        let costs = self.parts().map(cost).enumerate();
        let (part, (_, share)) = costs.min_by(|a, b| a.1.0.total_cmp(&b.1.0))?;
        let (mut at, mut ahead) = (share, AHEAD);
        // Bounds the rounds of the shortest route; for a place that is NaN there is no target.
        let rounds = (AHEAD / SHORTEST) as usize + 2;
        for [from, to] in self.parts().cycle().skip(part).take(rounds * self.way.len()) {
            let rest = (1.0 - at) * from.distance(to);
            if rest >= ahead {
                let way = (to - from).normalize_or_zero();
                let width = (ROOM * count as f32 / self.length).clamp(WIDTH[0], WIDTH[1]);
                let right = Vec2::new(-way.y, way.x);
                return Some(to - (rest - ahead) * way + (ASIDE + lane * width) * right);
            }
            (at, ahead) = (0.0, ahead - rest);
        }
        None
    }

    /// The line segments of the route.
    fn parts(&self) -> impl Iterator<Item = [Vec2; 2]> + Clone {
        let next = self.way.iter().cycle().skip(1);
        self.way.iter().zip(next).map(|(from, to)| [*from, *to])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_loop_is_walked_round_and_a_line_there_and_back() {
        let square = Route::new(&[[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0], [0.0, 0.5]]).unwrap();
        assert!((square.length - 40.0).abs() < 1e-4);
        let line = Route::new(&[[0.0, 0.0], [6.0, 0.0], [6.0, 8.0]]).unwrap();
        assert_eq!((line.way.len(), line.length), (4, 28.0));
        // Along +X the right is +Z, back along −X it is −Z.
        let target = |x: f32| line.target(Vec2::new(3.0, 0.0), Vec2::new(x, 0.0), 0.0, 1).unwrap();
        assert!(target(1.0).distance(Vec2::new(5.5, ASIDE)) < 1e-5, "{}", target(1.0));
        assert!(target(-1.0).distance(Vec2::new(0.5, -ASIDE)) < 1e-5, "{}", target(-1.0));
        // Around the corner.
        let corner = line.target(Vec2::new(5.0, 0.0), Vec2::new(1.0, 0.0), 0.0, 1).unwrap();
        assert!(corner.distance(Vec2::new(6.0 - ASIDE, 1.5)) < 1e-5, "{corner}");
    }

    #[test]
    fn a_loop_of_no_size_is_no_route() {
        for size in [f32::MIN_POSITIVE, 1e-8, 1e-6, 0.03] {
            let route = Route::new(&[[0.0, 0.0], [size, 0.0]]).unwrap();
            assert_eq!(route.target(Vec2::ZERO, Vec2::X, 0.5, 10), None, "{size}");
        }
        // For a loop of the least size there is a target, whatever the place.
        for at in [Vec2::ZERO, Vec2::splat(1e30), Vec2::NAN] {
            let route = Route::new(&[[0.0, 0.0], [0.06, 0.0]]).unwrap();
            assert!(route.target(at, Vec2::X, 0.5, 10).is_none_or(|target| target.is_finite() || at.is_nan()));
        }
    }

    #[test]
    fn a_route_has_two_points_or_none() {
        assert_eq!(Route::new(&[[1.0, 1.0]]).unwrap_err(), CrowdError::Route(1));
        assert_eq!(Route::new(&[[1.0, 1.0]; MAX_ROUTE_POINTS + 1]).unwrap_err(), CrowdError::Route(65));
        assert!(matches!(Route::new(&[[0.0, 0.0], [f32::NAN, 1.0]]).unwrap_err(), CrowdError::Place(_)));
        for points in [&[][..], &[[2.0, 3.0]; 4]] {
            let route = Route::new(points).unwrap();
            assert_eq!(route.target(Vec2::ZERO, Vec2::X, 0.5, 10), None);
        }
    }
}
