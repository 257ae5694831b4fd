//! Keeps NaN and jumps of the input out of the model's state.

use crate::humanoid::{JOINTS, Pose};
use crate::math::float_funcs::cos;
use crate::math::{Quat, Vec3};
use std::f32::consts::FRAC_PI_2;

/// Hip speed above any person's, vehicles included, m/s: a jump.
const MAX_SPEED: f32 = 25.0;
/// Above any joint's turn rate, rad/s (a throwing arm reaches about 130 rad/s for a few milliseconds).
const MAX_TURN_RATE: f32 = 90.0;
/// After this many successive frames far from the held pose the input is accepted as a cut.
const MAX_HELD: u32 = 6;
/// Beyond this distance from the origin (m) `f32` no longer resolves millimetres.
const MAX_COORDINATE: f32 = 1e4;

/// Result for a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Admitted {
    /// Unchanged.
    Good(Pose),
    /// Joints, or the whole pose, replaced by their last valid rotation; the hips move on.
    Repaired(Pose),
    /// Unchanged, but not continuous with the frames before.
    Cut(Pose),
    /// As [`Admitted::Cut`], except that invalid joints keep their last valid rotation.
    RepairedCut(Pose),
}

/// See the module documentation.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct InputGuard {
    last: Option<Pose>,
    velocity: Vec3,
    /// Number of frames for which the whole pose, and each joint, has been held.
    held: u32,
    held_joints: [u32; JOINTS],
}

impl InputGuard {
    /// Checks the next frame, `dt_secs` after the one before.
    pub(super) fn admit(&mut self, pose: &Pose, dt_secs: f32) -> Admitted {
        let root_is_usable = pose.root.is_finite() && pose.root.abs().max_element() < MAX_COORDINATE;
        let Some(last) = self.last else {
            // Joints that are invalid from the first frame on are at rest until they become valid.
            return match root_is_usable.then(|| self.begin(pose, &Pose::default())).flatten() {
                Some((pose, false)) => Admitted::Good(pose),
                Some((pose, true)) => Admitted::Repaired(pose),
                // A default pose in place of an invalid first frame is no reference for the next frame.
                None => Admitted::Repaired(Pose::default()),
            };
        };
        let step = pose.root - last.root;
        if !root_is_usable || step.length() > MAX_SPEED * dt_secs {
            let may_cut = root_is_usable && self.held >= MAX_HELD;
            return match may_cut.then(|| self.begin(pose, &last)).flatten() {
                Some((pose, false)) => Admitted::Cut(pose),
                Some((pose, true)) => Admitted::RepairedCut(pose),
                None => Admitted::Repaired(self.hold(last, dt_secs)),
            };
        }
        let mut admitted = Pose { root: pose.root, ..last };
        let mut repaired = false;
        let least_dot = cos((0.5 * MAX_TURN_RATE * dt_secs).min(FRAC_PI_2));
        for (j, (rotation, new)) in admitted.rotations.iter_mut().zip(&pose.rotations).enumerate() {
            match usable(*new) {
                Some(new) if self.held_joints[j] >= MAX_HELD || rotation.dot(new).abs() >= least_dot => {
                    *rotation = new;
                    self.held_joints[j] = 0;
                }
                _ => {
                    self.held_joints[j] = self.held_joints[j].saturating_add(1);
                    repaired = true;
                }
            }
        }
        *self = Self { last: Some(admitted), velocity: step / dt_secs, held: 0, ..*self };
        if repaired { Admitted::Repaired(admitted) } else { Admitted::Good(admitted) }
    }

    /// Starts with a pose. Invalid joints keep their rotation of `otherwise` until they become valid; their first valid
    /// rotation is then accepted, however far it differs. Returns the accepted pose and whether a joint was replaced;
    /// `None` if no joint is valid.
    fn begin(&mut self, pose: &Pose, otherwise: &Pose) -> Option<(Pose, bool)> {
        let (mut taken, mut held_joints) = (*otherwise, [MAX_HELD; JOINTS]);
        taken.root = pose.root;
        for (j, q) in pose.rotations.iter().enumerate() {
            if let Some(q) = usable(*q) {
                (taken.rotations[j], held_joints[j]) = (q, 0);
            }
        }
        if held_joints.iter().all(|held| *held > 0) {
            return None;
        }
        *self = Self { last: Some(taken), held_joints, ..Self::default() };
        Some((taken, held_joints.iter().any(|held| *held > 0)))
    }

    fn hold(&mut self, mut pose: Pose, dt_secs: f32) -> Pose {
        self.held = self.held.saturating_add(1);
        if self.held <= MAX_HELD {
            pose.root += self.velocity * dt_secs;
        }
        self.last = Some(pose);
        pose
    }
}

/// The rotation at unit length if its length is plausible.
fn usable(q: Quat) -> Option<Quat> {
    (q.is_finite() && (0.5..2.0).contains(&q.dot(q))).then(|| q.normalized())
}

#[cfg(test)]
mod tests {
    use super::*;

    const DT: f32 = 1.0 / 60.0;

    fn at(x: f32) -> Pose {
        Pose { root: Vec3::new(x, 0.9, 0.0), ..Pose::default() }
    }

    #[test]
    fn a_bad_frame_is_replaced_by_the_last_one_moving_on() {
        let mut guard = InputGuard::default();
        guard.admit(&at(0.0), DT);
        guard.admit(&at(0.02), DT);
        for bad in [at(f32::NAN), at(1e30), at(5.0)] {
            let mut guard = guard;
            let Admitted::Repaired(pose) = guard.admit(&bad, DT) else { panic!("{bad:?} was taken") };
            assert!((pose.root.x - 0.04).abs() < 1e-6);
            assert!(matches!(guard.admit(&at(0.06), DT), Admitted::Good(_)));
        }
    }

    #[test]
    fn a_bad_joint_is_held_alone() {
        let mut guard = InputGuard::default();
        guard.admit(&at(0.0), DT);
        let mut moved = at(0.02);
        moved.rotations[5] = Quat::from_rotation_x(0.1);
        for bad in
            [Quat::from_xyzw(f32::NAN, 0.0, 0.0, 1.0), Quat::from_xyzw(0.0, 0.0, 0.0, 0.0), Quat::from_rotation_z(3.0)]
        {
            let (mut guard, mut pose) = (guard, moved);
            pose.rotations[9] = bad;
            assert_eq!(guard.admit(&pose, DT), Admitted::Repaired(moved));
        }
        moved.rotations[9] = Quat::from_rotation_z(3.0);
        for _ in 0..MAX_HELD {
            assert!(matches!(guard.admit(&moved, DT), Admitted::Repaired(_)));
        }
        assert_eq!(guard.admit(&moved, DT), Admitted::Good(moved));
    }

    #[test]
    fn a_joint_that_is_unusable_from_the_first_frame_on_stays_at_rest() {
        let mut guard = InputGuard::default();
        let mut pose = at(0.0);
        pose.rotations[5] = Quat::from_rotation_x(0.4);
        pose.rotations[9] = Quat::from_xyzw(0.0, 0.0, 0.0, 0.0);
        let mut expected = pose;
        expected.rotations[9] = Quat::IDENTITY;
        for frame in 0..20 {
            pose.root.x = 0.02 * frame as f32;
            expected.root.x = pose.root.x;
            assert_eq!(guard.admit(&pose, DT), Admitted::Repaired(expected), "frame {frame}");
        }
        // It is accepted as soon as it is valid, whatever its rotation.
        pose.rotations[9] = Quat::from_rotation_z(3.0);
        assert_eq!(guard.admit(&pose, DT), Admitted::Good(pose));
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
    fn a_jump_that_stays_is_a_cut_also_where_a_joint_is_never_usable() {
        let bad = Quat::from_xyzw(0.0, 0.0, 0.0, 0.0);
        let with = |mut pose: Pose, q: Quat| {
            pose.rotations[9] = q;
            pose
        };
        let last_good = Quat::from_rotation_x(0.3);
        for (first, at_cut) in [(bad, Quat::IDENTITY), (last_good, last_good)] {
            let mut guard = InputGuard::default();
            guard.admit(&with(at(0.0), first), DT);
            for _ in 0..MAX_HELD {
                assert!(matches!(guard.admit(&with(at(5.0), bad), DT), Admitted::Repaired(_)));
            }
            let expected = Admitted::RepairedCut(with(at(5.0), at_cut));
            assert_eq!(guard.admit(&with(at(5.0), bad), DT), expected);
            assert_eq!(guard.admit(&with(at(5.01), bad), DT), Admitted::Repaired(with(at(5.01), at_cut)));
        }
    }

    #[test]
    fn a_bad_first_frame_does_not_bind_the_second() {
        let mut guard = InputGuard::default();
        assert!(matches!(guard.admit(&at(f32::NAN), DT), Admitted::Repaired(_)));
        assert!(matches!(guard.admit(&at(7.0), DT), Admitted::Good(_)));
    }
}
