//! Where the styled figure is, against the performer: a style has its own length of stride, so that places drift apart.

use crate::math::Vec2;
use crate::math::float_funcs::half_life_share;

/// Half-life of the distance to the performer, seconds.
const HALF_LIFE_SECS: f32 = 1.0;
/// Greatest speed of the correction, as a share of the figure's own.
const MOST_OF_SPEED: f32 = 0.1;

/// Whether the styled figure keeps to the performer's place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Place {
    /// It is drawn to it while it walks.
    #[default]
    Follow,
    /// It goes where its steps lead.
    Free,
}

/// The correction of the place, metres on the ground.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Follower {
    shift: Vec2,
    last: Option<Vec2>,
}

impl Follower {
    /// The correction in the next frame, `dt_secs` after the last, of a figure whose steps led to `styled`; `shown` is where
    /// that with the last correction would be seen. It changes while a foot `swings`.
    pub(super) fn next(&mut self, styled: Vec2, shown: Vec2, performer: Vec2, swings: bool, dt_secs: f32) -> Vec2 {
        let travel = self.last.map_or(0.0, |last| last.distance(styled));
        self.last = Some(styled);
        if swings {
            let step = (performer - shown) * half_life_share(dt_secs, HALF_LIFE_SECS);
            self.shift += step.clamp_length_max(MOST_OF_SPEED * travel);
        }
        self.shift
    }

    /// The correction as it is.
    pub(super) fn shift(&self) -> Vec2 {
        self.shift
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DT: f32 = 1.0 / 60.0;

    /// Distance to a performer who walks at 1.2 m/s, second by second, of a figure that walks at `speed`.
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
        // Where 7 % of its speed draws it: 0.084 m/s · 1 s / ln 2.
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
