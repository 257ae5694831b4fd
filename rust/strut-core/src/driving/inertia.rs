//! Transitions by inertialisation (Bollo 2016): the new motion starts from the pose shown, and the difference decays.

use crate::humanoid::{JOINTS, Pose};
use crate::math::exp_map::{exp, log};
use crate::math::float_funcs::exp as e_to;
use crate::math::{Quat, Vec3};
use std::f32::consts::LN_2;

/// Half-life of a difference, seconds.
pub(crate) const HALF_LIFE_SECS: f32 = 0.1;

/// The difference between the pose shown and the pose played, in the frame of the root.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Inertia {
    hips: Decay,
    /// Rotation vectors.
    rotations: [Decay; JOINTS],
}

/// A pose and its rates of change, per second.
#[derive(Clone, Copy)]
pub(crate) struct Moving {
    pub(crate) pose: Pose,
    pub(crate) hips: Vec3,
    /// Rotation vectors.
    pub(crate) rotations: [Vec3; JOINTS],
}

impl Moving {
    /// A pose and the next one, `1 / rate_hz` later.
    pub(crate) fn between(pose: &Pose, next: &Pose, rate_hz: f32) -> Self {
        let turned = |j: usize| log(next.rotations[j] * pose.rotations[j].inverse()) * rate_hz;
        Self { pose: *pose, hips: (next.root - pose.root) * rate_hz, rotations: std::array::from_fn(turned) }
    }
}

/// A difference that decays as a critically damped spring.
#[derive(Clone, Copy, Debug, Default)]
struct Decay {
    x: Vec3,
    v: Vec3,
}

impl Decay {
    fn advance(&mut self, dt_secs: f32) {
        let y = 2.0 * LN_2 / HALF_LIFE_SECS;
        let j = self.v + self.x * y;
        let left = e_to(-y * dt_secs);
        self.x = (self.x + j * dt_secs) * left;
        self.v = (self.v - j * (y * dt_secs)) * left;
    }
}

impl Default for Inertia {
    fn default() -> Self {
        Self { hips: Decay::default(), rotations: [Decay::default(); JOINTS] }
    }
}

impl Inertia {
    /// Lets the difference decay for a time step.
    pub(crate) fn advance(&mut self, dt_secs: f32) {
        self.hips.advance(dt_secs);
        for rotation in &mut self.rotations {
            rotation.advance(dt_secs);
        }
    }

    /// The pose shown while `pose` is played.
    pub(crate) fn shown(&self, pose: &Pose) -> Pose {
        let mut out = *pose;
        out.root += self.hips.x;
        for (q, offset) in out.rotations.iter_mut().zip(&self.rotations) {
            *q = turned(offset.x, *q);
        }
        out
    }

    /// Continues with the pose `to` where `from` was played, without a jump in pose or velocity.
    pub(crate) fn go_on(&mut self, from: &Moving, to: &Moving) {
        let shown = self.shown(&from.pose);
        self.hips = Decay { x: shown.root - to.pose.root, v: from.hips + self.hips.v - to.hips };
        for (j, offset) in self.rotations.iter_mut().enumerate() {
            offset.x = log(shown.rotations[j] * to.pose.rotations[j].inverse());
            offset.v += from.rotations[j] - to.rotations[j];
        }
    }
}

fn turned(by: Vec3, q: Quat) -> Quat {
    exp(by) * q
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bent(angle: f32) -> Pose {
        let mut pose = Pose::default();
        pose.root.x = angle;
        for q in &mut pose.rotations {
            *q = Quat::from_rotation_x(angle);
        }
        pose
    }

    #[test]
    fn goes_on_from_what_was_shown_and_ends_with_what_plays() {
        let mut inertia = Inertia::default();
        let (from, to) = (bent(0.5), bent(-0.2));
        let still = |pose: &Pose| Moving::between(pose, pose, 60.0);
        inertia.go_on(&still(&from), &still(&to));
        let distance = |a: &Pose, b: &Pose| a.rotations[5].inv_mul(b.rotations[5]).angle() + a.root.distance(b.root);
        assert!(distance(&inertia.shown(&to), &from) < 1e-5);
        let mut last = f32::INFINITY;
        for _ in 0..60 {
            inertia.advance(1.0 / 60.0);
            let left = distance(&inertia.shown(&to), &to);
            assert!(left < last);
            last = left;
        }
        assert!(last < 1e-3);
    }

    #[test]
    fn keeps_the_velocity_at_first() {
        let mut inertia = Inertia::default();
        let (from, next, to) = (bent(0.1), bent(0.12), bent(0.0));
        inertia.go_on(&Moving::between(&from, &next, 60.0), &Moving::between(&to, &to, 60.0));
        inertia.advance(1e-3);
        let step = inertia.shown(&to).root.x - from.root.x;
        assert!((step / 1e-3 - 0.02 * 60.0).abs() < 0.1, "{step}");
    }
}
