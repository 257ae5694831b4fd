//! Keeps NaN and jumps of the input out of the model's state.

use crate::humanoid::Pose;
use crate::math::Vec3;

/// Faster than any person, vehicles included: a jump of the hips.
const MAX_SPEED: f32 = 25.0;
/// Faster than any joint (a thrown ball's arm reaches about 130 rad/s for a few milliseconds).
const MAX_TURN_RATE: f32 = 90.0;
/// After this many frames in a row that are far from the held pose, the input is believed: a cut.
const MAX_HELD: u32 = 6;
/// Beyond this distance from the origin (m) `f32` no longer resolves millimetres.
const MAX_COORDINATE: f32 = 1e4;

/// What became of a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Admitted {
    /// Taken as it is.
    Good(Pose),
    /// Replaced by the last good pose, its hips moving on.
    Repaired(Pose),
    /// Taken as it is, but it does not continue what came before.
    Cut(Pose),
}

/// See the module documentation.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct InputGuard {
    last: Option<Pose>,
    velocity: Vec3,
    held: u32,
}

impl InputGuard {
    /// Judges the next frame, `dt_secs` after the one before.
    pub(super) fn admit(&mut self, pose: &Pose, dt_secs: f32) -> Admitted {
        let usable = is_usable(pose).then(|| normalised(pose));
        match (usable, self.last) {
            (Some(pose), None) => {
                self.accept(&pose, Vec3::ZERO);
                Admitted::Good(pose)
            }
            (Some(pose), Some(last)) if continues(&last, &pose, dt_secs) => {
                self.accept(&pose, (pose.root - last.root) / dt_secs);
                Admitted::Good(pose)
            }
            (Some(pose), Some(_)) if self.held >= MAX_HELD => {
                self.accept(&pose, Vec3::ZERO);
                Admitted::Cut(pose)
            }
            (_, last) => {
                let mut pose = last.unwrap_or_default();
                self.held += 1;
                if self.held <= MAX_HELD {
                    pose.root += self.velocity * dt_secs;
                }
                // A default pose in place of a bad first frame is no evidence: the next frame starts afresh.
                self.last = last.map(|_| pose);
                Admitted::Repaired(pose)
            }
        }
    }

    fn accept(&mut self, pose: &Pose, velocity: Vec3) {
        *self = Self { last: Some(*pose), velocity, held: 0 };
    }
}

fn is_usable(pose: &Pose) -> bool {
    pose.is_finite()
        && pose.root.abs().max_element() < MAX_COORDINATE
        && pose.rotations.iter().all(|q| (0.5..2.0).contains(&q.dot(*q)))
}

fn normalised(pose: &Pose) -> Pose {
    Pose { root: pose.root, rotations: pose.rotations.map(crate::math::Quat::normalized) }
}

fn continues(last: &Pose, pose: &Pose, dt_secs: f32) -> bool {
    (pose.root - last.root).length() <= MAX_SPEED * dt_secs
        && last.rotations.iter().zip(&pose.rotations).all(|(a, b)| a.inv_mul(*b).angle() <= MAX_TURN_RATE * dt_secs)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Quat;

    const DT: f32 = 1.0 / 60.0;

    fn at(x: f32) -> Pose {
        Pose { root: Vec3::new(x, 0.9, 0.0), ..Pose::default() }
    }

    #[test]
    fn a_bad_frame_is_replaced_by_the_last_one_moving_on() {
        let mut guard = InputGuard::default();
        guard.admit(&at(0.0), DT);
        guard.admit(&at(0.02), DT);
        let mut bad = at(0.04);
        bad.rotations[3].w = f32::NAN;
        for bad in [bad, at(1e30), at(5.0), Pose { rotations: [Quat::from_xyzw(0.0, 0.0, 0.0, 0.0); 21], ..at(0.0) }] {
            let mut guard = guard;
            let Admitted::Repaired(pose) = guard.admit(&bad, DT) else { panic!("{bad:?} was taken") };
            assert!((pose.root.x - 0.04).abs() < 1e-6);
            assert!(matches!(guard.admit(&at(0.06), DT), Admitted::Good(_)));
        }
    }

    #[test]
    fn a_jump_that_stays_is_a_cut() {
        let mut guard = InputGuard::default();
        guard.admit(&at(0.0), DT);
        for _ in 0..MAX_HELD {
            assert!(matches!(guard.admit(&at(5.0), DT), Admitted::Repaired(_)));
        }
        assert_eq!(guard.admit(&at(5.0), DT), Admitted::Cut(at(5.0)));
        assert_eq!(guard.admit(&at(5.01), DT), Admitted::Good(at(5.01)));
    }

    #[test]
    fn a_bad_first_frame_does_not_bind_the_second() {
        let mut guard = InputGuard::default();
        assert!(matches!(guard.admit(&at(f32::NAN), DT), Admitted::Repaired(_)));
        assert!(matches!(guard.admit(&at(7.0), DT), Admitted::Good(_)));
    }
}
