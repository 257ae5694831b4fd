//! The height of the ground under a live performer, estimated from the soles.

use crate::humanoid::{Pose, Proportions};
use crate::kinematics::{Soles, world_from_local};
use crate::math::float_funcs::exp2;

/// In the first second the height of the lowest sole is used directly …
const FIRST_SECS: f64 = 1.0;
/// … if it is farther than this from 0, metres. The height of the ankles is known to about 2 cm.
const DISPLACED: f32 = 0.03;
/// Later the estimate follows a ground that is farther away than this, metres. Smaller differences come from sitting and
/// lying.
const MOVED: f32 = 0.1;
/// Half-life with which the estimate follows, seconds.
const HALF_LIFE_SECS: f64 = 2.0;
/// Length of a window, seconds. The ground is the lowest sole in the last two windows, which are longer than a jump.
const SEEN_SECS: f64 = 0.5;
/// Longer times between frames are clamped to this, seconds.
const LONGEST_SECS: f64 = 0.1;

/// Height of the ground of a stream.
#[derive(Clone, Debug)]
pub struct LiveFloor {
    soles: Soles,
    body: Proportions,
    began_secs: Option<f64>,
    last_secs: f64,
    /// Start of the present window, and the lowest sole in it and in the one before.
    since_secs: f64,
    lowest: [f32; 2],
    height: f32,
    is_followed: bool,
}

impl LiveFloor {
    /// Creates the estimator for a body.
    pub fn new(body: &Proportions) -> Self {
        Self {
            soles: Soles::new(body),
            body: *body,
            began_secs: None,
            last_secs: 0.0,
            since_secs: 0.0,
            lowest: [f32::INFINITY; 2],
            height: 0.0,
            is_followed: false,
        }
    }

    /// Returns the height of the ground under a pose of the body that was sent at a time, metres and seconds. A body that
    /// `has_root` moves relative to the ground; one without a root stands on it in every frame.
    pub fn under(&mut self, pose: &Pose, sent_secs: f64, has_root: bool) -> f32 {
        let world = world_from_local(&self.body, pose);
        let lowest = [0, 1].map(|side| self.soles.of(&world, side).lowest()).into_iter().fold(f32::INFINITY, f32::min);
        if !has_root {
            return lowest;
        }
        let began_secs = *self.began_secs.get_or_insert(sent_secs);
        if sent_secs - self.since_secs > SEEN_SECS || sent_secs < self.since_secs {
            self.lowest = [f32::INFINITY, self.lowest[0]];
            self.since_secs = sent_secs;
        }
        self.lowest[0] = self.lowest[0].min(lowest);
        let seen = self.lowest[0].min(self.lowest[1]);
        let passed_secs = (sent_secs - self.last_secs).clamp(0.0, LONGEST_SECS);
        self.last_secs = sent_secs;
        if (0.0..FIRST_SECS).contains(&(sent_secs - began_secs)) {
            self.is_followed = seen.abs() > DISPLACED;
            self.height = if self.is_followed { seen } else { 0.0 };
        } else {
            self.is_followed |= (seen - self.height).abs() > MOVED;
            if self.is_followed {
                let share = 1.0 - exp2(-(passed_secs / HALF_LIFE_SECS) as f32);
                self.height += (seen - self.height) * share;
            }
        }
        self.height
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixtures::{NEUTRAL, RATE_HZ, walk};
    use crate::math::Vec3;

    /// Heights estimated under a walk of six seconds over ground at the height `ground`.
    fn under(ground: impl Fn(f64) -> f32) -> Vec<f32> {
        let (motion, body) = (walk(&NEUTRAL, 360, 0.0), Proportions::default());
        let mut floor = LiveFloor::new(&body);
        let frame = |(f, pose): (usize, &Pose)| {
            let secs = f as f64 / f64::from(RATE_HZ);
            let mut pose = *pose;
            pose.root.y += ground(secs);
            floor.under(&pose, 100.0 + secs, true)
        };
        motion.poses.iter().enumerate().map(frame).collect()
    }

    #[test]
    fn a_ground_at_height_0_stays_there() {
        assert!(under(|_| 0.0).iter().all(|height| *height == 0.0));
    }

    #[test]
    fn another_ground_is_found_in_the_first_second() {
        let heights = under(|_| -0.9);
        assert!(heights.iter().all(|height| (height + 0.9).abs() < 0.1), "{heights:?}");
        assert!((heights[120] + 0.9).abs() < 0.03, "{}", heights[120]);
    }

    #[test]
    fn a_ground_that_changes_later_is_followed_slowly() {
        let heights = under(|secs| if secs < 1.5 { 0.0 } else { 0.4 });
        let steps = heights.windows(2).map(|w| (w[1] - w[0]).abs()).fold(0.0, f32::max);
        assert!(steps < 0.01, "{steps}");
        assert!(heights[heights.len() - 1] > 0.1, "{:?}", heights.last());
    }

    #[test]
    fn a_body_without_a_root_stands_in_every_frame() {
        let (motion, body) = (walk(&NEUTRAL, 120, 0.0), Proportions::default());
        let mut floor = LiveFloor::new(&body);
        let soles = Soles::new(&body);
        for pose in &motion.poses {
            let mut pose = Pose { root: Vec3::ZERO, ..*pose };
            pose.root.y -= floor.under(&pose, 0.0, false);
            let world = world_from_local(&body, &pose);
            let lowest = soles.of(&world, 0).lowest().min(soles.of(&world, 1).lowest());
            assert!(lowest.abs() < 1e-5, "{lowest}");
        }
    }
}
