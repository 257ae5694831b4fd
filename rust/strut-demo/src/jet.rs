//! A moving point with its position, velocity and acceleration, and the smooth path between two of them.

use strut_core::math::Vec3;

/// A point with its velocity and acceleration.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Jet {
    pub(crate) position: Vec3,
    pub(crate) velocity: Vec3,
    pub(crate) acceleration: Vec3,
}

impl Jet {
    /// Step of the finite differences in cycles: several samples of a [`crate::periodic::PeriodicCurve`].
    const STEP: f32 = 0.008;

    /// State at the start of a motion, given as a function of the time since the start.
    pub(crate) fn forward(motion: impl Fn(f32) -> Vec3) -> Self {
        let h = Self::STEP;
        let [a, b, c] = [motion(0.0), motion(h), motion(2.0 * h)];
        Self { position: a, velocity: (b * 4.0 - a * 3.0 - c) / (2.0 * h), acceleration: (a - b * 2.0 + c) / (h * h) }
    }

    /// State at the end of a motion, given as a function of the time before the end.
    pub(crate) fn backward(motion: impl Fn(f32) -> Vec3) -> Self {
        let reversed = Self::forward(motion);
        Self { velocity: -reversed.velocity, ..reversed }
    }

    pub(crate) fn shifted(self, by: Vec3) -> Self {
        Self { position: self.position + by, ..self }
    }

    /// The same state with time measured in units of `length`.
    pub(crate) fn over(self, length: f32) -> Self {
        Self { velocity: self.velocity * length, acceleration: self.acceleration * (length * length), ..self }
    }

    /// Polynomial of least degree from one state to the next; `t` in [0, 1].
    pub(crate) fn quintic(from: &Self, to: &Self, t: f32) -> Vec3 {
        let [[p0, v0, a0], [p1, v1, a1]] = quintic_weights(t);
        from.position * p0
            + from.velocity * v0
            + from.acceleration * a0
            + to.acceleration * a1
            + to.velocity * v1
            + to.position * p1
    }
}

/// Weights of a quintic Hermite segment at `t` in [0, 1]: of value, first and second derivative at its start and at its
/// end.
pub(crate) fn quintic_weights(t: f32) -> [[f32; 3]; 2] {
    let (t2, t3) = (t * t, t * t * t);
    let (t4, t5) = (t2 * t2, t2 * t3);
    let from = [
        1.0 - 10.0 * t3 + 15.0 * t4 - 6.0 * t5,
        t - 6.0 * t3 + 8.0 * t4 - 3.0 * t5,
        0.5 * t2 - 1.5 * t3 + 1.5 * t4 - 0.5 * t5,
    ];
    let to = [10.0 * t3 - 15.0 * t4 + 6.0 * t5, 7.0 * t4 - 4.0 * t3 - 3.0 * t5, 0.5 * t3 - t4 + 0.5 * t5];
    [from, to]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_quintic_continues_both_jets() {
        let motion = |t: f32| Vec3::new(t * t, 2.0 * t, 1.0 - t * t * t);
        let (from, to) = (Jet::forward(motion), Jet::backward(|d| motion(1.0 - d)));
        for t in [0.0, 0.3, 0.7, 1.0] {
            assert!((Jet::quintic(&from, &to, t) - motion(t)).length() < 2e-3, "{t}");
        }
    }
}
