//! Target trajectory of the root, from a stick or from a path.

use super::features::{HORIZONS_SECS, Trajectory};
use super::path::Path;
use crate::math::Vec2;
use crate::math::float_funcs::{atan2, exp, exp2, sin_cos, wrap_angle};
use std::f32::consts::LN_2;

/// Half-life with which velocity and heading follow a stick, seconds.
const STICK_HALF_LIFE_SECS: f32 = 0.27;
/// Half-life with which a character returns to its path, seconds.
const PATH_HALF_LIFE_SECS: f32 = 0.3;
/// Within this distance of the end of its path a character is told to stop, metres: stopping takes some distance.
pub(super) const STOP_BEFORE: f32 = 0.3;
/// Below this speed the heading does not follow the direction of motion, m/s.
const STILL: f32 = 1e-3;

/// Present state of the root in the world.
#[derive(Clone, Copy, Debug)]
pub(super) struct RootState {
    pub(super) place: Vec2,
    pub(super) heading: f32,
    pub(super) velocity: Vec2,
    pub(super) turn_rate: f32,
}

/// Trajectory of a root that approaches the velocity `wanted` and the heading `goal`: critically damped springs.
pub(super) fn by_stick(now: &RootState, wanted: Vec2, goal: f32) -> Trajectory {
    let y = 2.0 * LN_2 / STICK_HALF_LIFE_SECS;
    let j0 = now.velocity - wanted;
    let j1 = j0 * y;
    let d = wrap_angle(now.heading - goal);
    HORIZONS_SECS.map(|t| {
        let left = exp(-y * t);
        let travelled = (-j1 / (y * y) - (j0 + j1 * t) / y) * left + j1 / (y * y) + j0 / y + wanted * t;
        (now.place + travelled, wrap_angle(goal + left * (d + (now.turn_rate + d * y) * t)))
    })
}

/// A character's state on its path.
#[derive(Clone, Copy, Debug)]
pub(super) struct OnPath<'a> {
    pub(super) path: &'a Path,
    /// Covered arc length, metres.
    pub(super) progress: f32,
    /// Speed, m/s.
    pub(super) speed: f32,
    /// Place of the styled character, and the ratio of its speed to the root's.
    pub(super) styled: Vec2,
    pub(super) share: f32,
    /// Target offset to the right of the path, metres: compensates a lasting offset to the left.
    pub(super) aim: f32,
}

/// Trajectory of a root along a path. The styled character is what is drawn, so the root's target is the one that
/// brings the styled character onto the path.
pub(super) fn by_path(now: &RootState, on: OnPath) -> Trajectory {
    let OnPath { path, progress, speed, styled, share, aim } = on;
    let off = styled - path.at(progress);
    HORIZONS_SECS.map(|t| {
        let left = exp2(-t / PATH_HALF_LIFE_SECS);
        let along = (progress + share * speed * t).min(path.length());
        let direction = path.direction(along);
        let aside = to_the_right(direction) * aim;
        let place = now.place + (path.at(along) + aside + off * left - styled) / share;
        let way = direction * (share * speed) - (off - aside) * (left * LN_2 / PATH_HALF_LIFE_SECS);
        (place, if way.length() > STILL { atan2(way.x, way.y) } else { now.heading })
    })
}

/// The direction on the ground (x, z) to the right of another; +X is to the left of +Z.
pub(super) fn to_the_right(direction: Vec2) -> Vec2 {
    Vec2::new(-direction.y, direction.x)
}

/// Transforms a vector from the frame of a root with this heading to the world.
pub(super) fn in_world(heading: f32, v: Vec2) -> Vec2 {
    let (sine, cosine) = sin_cos(heading);
    Vec2::new(cosine * v.x + sine * v.y, cosine * v.y - sine * v.x)
}

/// Transforms a trajectory to the frame of the root.
pub(super) fn in_root(now: &RootState, of: &Trajectory) -> Trajectory {
    of.map(|(place, heading)| (in_world(-now.heading, place - now.place), wrap_angle(heading - now.heading)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn standing() -> RootState {
        RootState { place: Vec2::new(1.0, 2.0), heading: 0.5, velocity: Vec2::ZERO, turn_rate: 0.0 }
    }

    #[test]
    fn a_root_that_has_what_is_wanted_goes_straight_on() {
        let wanted = Vec2::new(0.3, 1.0);
        let now = RootState { velocity: wanted, ..standing() };
        for ((place, heading), t) in by_stick(&now, wanted, 0.5).into_iter().zip(HORIZONS_SECS) {
            assert!(place.distance(now.place + wanted * t) < 1e-5 && (heading - 0.5).abs() < 1e-6);
        }
    }

    #[test]
    fn a_spring_is_the_one_that_its_equation_says() {
        // v″ = −2 y v′ − y² (v − wanted), by small steps.
        let (wanted, goal, y) = (Vec2::new(1.2, -0.4), 2.0, 2.0 * LN_2 / STICK_HALF_LIFE_SECS);
        let now = RootState { velocity: Vec2::new(-0.5, 0.8), turn_rate: -0.7, ..standing() };
        let (mut v, mut a, mut p) = (now.velocity, Vec2::ZERO, now.place);
        let (mut h, mut w) = (now.heading, now.turn_rate);
        let dt = 1e-5;
        for _ in 0..100_000 {
            a += (a * (-2.0 * y) - (v - wanted) * (y * y)) * dt;
            v += a * dt;
            p += v * dt;
            w += (-2.0 * y * w - y * y * (h - goal)) * dt;
            h += w * dt;
        }
        let (place, heading) = by_stick(&now, wanted, goal)[2];
        assert!(place.distance(p) < 0.01 && (heading - h).abs() < 0.01, "{place} {p} {heading} {h}");
    }

    #[test]
    fn a_root_beside_its_path_comes_back_to_it() {
        let path = Path::new(&[Vec2::ZERO, Vec2::new(0.0, 10.0)]).unwrap();
        let now = RootState { place: Vec2::new(0.4, 2.0), heading: 0.0, velocity: Vec2::Y, turn_rate: 0.0 };
        let on = OnPath { path: &path, progress: 2.0, speed: 1.0, styled: now.place, share: 1.0, aim: 0.0 };
        let asked = by_path(&now, on);
        // +X is to the left.
        let right_of = by_path(&now, OnPath { aim: 0.1, ..on });
        assert!((0..3).all(|i| (asked[i].0.x - right_of[i].0.x - 0.1).abs() < 1e-5), "{right_of:?}");
        assert!(asked.windows(2).all(|pair| pair[1].0.x < pair[0].0.x));
        assert!((asked[2].0.y - 3.0).abs() < 1e-5 && asked[0].1 < 0.0, "{asked:?}");
    }

    #[test]
    fn the_frame_of_the_root_is_that_of_its_heading() {
        let now = standing();
        let (sine, cosine) = sin_cos(0.5);
        let ahead = now.place + Vec2::new(sine, cosine) * 2.0;
        let [(place, heading), ..] = in_root(&now, &[(ahead, 0.7); 3]);
        assert!(place.distance(Vec2::new(0.0, 2.0)) < 1e-5 && (heading - 0.2).abs() < 1e-6);
    }
}
