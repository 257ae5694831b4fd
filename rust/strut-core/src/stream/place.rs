//! Place of the styled figure relative to the performer: a style has its own stride length, so the places drift apart.

use crate::math::Vec2;
use crate::math::float_funcs::half_life_share;

/// Half-life of the distance to the performer, seconds.
const HALF_LIFE_SECS: f32 = 1.0;
/// Greatest speed of the correction, as a share of the figure's own.
const MOST_OF_SPEED: f32 = 0.1;

/// Whether the styled figure follows the performer's place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Place {
    /// It is pulled to the performer's place while it walks.
    #[default]
    Follow,
    /// Its place follows from its own steps.
    Free,
}

/// Correction of the place, metres on the ground.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Follower {
    shift: Vec2,
    last: Option<Vec2>,
}

impl Follower {
    /// Returns the correction of the next frame, `dt_secs` after the last. `styled` is the place from the figure's own steps,
    /// and `shown` that place with the last correction. The correction changes only while a foot `swings`.
    pub(super) fn next(&mut self, styled: Vec2, shown: Vec2, performer: Vec2, swings: bool, dt_secs: f32) -> Vec2 {
        let travel = self.last.map_or(0.0, |last| last.distance(styled));
        self.last = Some(styled);
        if swings {
            let step = (performer - shown) * half_life_share(dt_secs, HALF_LIFE_SECS);
            self.shift += step.clamp_length_max(MOST_OF_SPEED * travel);
        }
        self.shift
    }

    /// The present correction.
    pub(super) fn shift(&self) -> Vec2 {
        self.shift
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DT: f32 = 1.0 / 60.0;

    /// Distance to a performer that walks at 1.2 m/s, once per second, of a figure that walks at `speed`.
    fn distances(speed: f32, swings: bool) -> Vec<f32> {
        let mut follower = Follower::default();
        let mut distances = Vec::new();
        for frame in 0..600 {
            let at = |speed: f32| Vec2::new(0.0, frame as f32 * DT * speed);
            let shown = at(speed) + follower.shift();
            let shift = follower.next(at(speed), shown, at(1.2), swings, DT);
            if frame % 60 == 59 {
                distances.push(at(1.2).distance(at(speed) + shift));
            }
        }
        distances
    }

    #[test]
    fn a_figure_that_is_slower_stays_within_reach() {
        // The distance at which the pull is 7 % of its speed: 0.084 m/s · 1 s / ln 2.
        assert!((distances(1.2 / 1.07, true)[9] - 0.113).abs() < 0.01, "{:?}", distances(1.2 / 1.07, true));
        assert!(distances(1.2 / 1.07, false)[9] > 0.7);
    }

    #[test]
    fn it_is_drawn_by_no_more_than_a_tenth_of_its_speed() {
        let (slow, still) = (distances(0.6, true), distances(0.0, true));
        let left = |distances: &[f32]| distances[9] - distances[8];
        assert!((left(&slow) - 0.54).abs() < 0.01, "{slow:?}");
        assert!((left(&still) - 1.2).abs() < 0.01, "a figure that stands is not moved: {still:?}");
    }
}
