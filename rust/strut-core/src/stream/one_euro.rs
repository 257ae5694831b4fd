//! The one-euro filter (Casiez, Roussel and Vogel 2012): a low-pass filter whose cutoff rises with speed, which reduces both
//! jitter at rest and lag in motion.

use crate::math::Vec3;
use std::f32::consts::TAU;

/// Cutoff frequency for the speed, Hz.
const SPEED_CUTOFF_HZ: f32 = 1.0;

/// Parameters of a [`OneEuro`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct OneEuroSettings {
    /// Cutoff frequency at rest, Hz.
    pub(super) least_cutoff_hz: f32,
    /// β: increase of the cutoff frequency with speed, Hz per m/s.
    pub(super) beta: f32,
}

/// Filter of a point, metres.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct OneEuro {
    last: Option<(Vec3, Vec3)>,
}

impl OneEuro {
    /// Returns the filtered point, `dt_secs` after the last.
    pub(super) fn next(&mut self, point: Vec3, dt_secs: f32, settings: OneEuroSettings) -> Vec3 {
        let Some((last, velocity)) = self.last else {
            self.last = Some((point, Vec3::ZERO));
            return point;
        };
        let raw = (point - last) / dt_secs;
        let velocity = velocity + (raw - velocity) * smoothing(SPEED_CUTOFF_HZ, dt_secs);
        let cutoff = settings.least_cutoff_hz + settings.beta * velocity.length();
        let filtered = last + (point - last) * smoothing(cutoff, dt_secs);
        self.last = Some((filtered, velocity));
        filtered
    }
}

/// α of an exponential filter: 1 / (1 + τ/Δt), τ = 1 / 2πf.
fn smoothing(cutoff_hz: f32, dt_secs: f32) -> f32 {
    let r = TAU * cutoff_hz * dt_secs;
    r / (r + 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixtures::noise;

    const SETTINGS: OneEuroSettings = OneEuroSettings { least_cutoff_hz: 1.0, beta: 0.3 };

    #[test]
    fn what_rests_trembles_less() {
        let (mut filter, mut sums) = (OneEuro::default(), [0.0_f32; 2]);
        for n in noise(3).take(600) {
            let filtered = filter.next(Vec3::X * n as f32 * 0.01, 1.0 / 30.0, SETTINGS);
            sums[0] += (n as f32 * 0.01).abs();
            sums[1] += filtered.x.abs();
        }
        assert!(sums[1] < 0.5 * sums[0], "{sums:?}");
    }

    #[test]
    fn what_is_faster_lags_for_a_shorter_time() {
        let lag_secs = |speed: f32| {
            let mut filter = OneEuro::default();
            let places = (0..300).map(|i| Vec3::X * speed * i as f32 / 60.0);
            let last = places.map(|p| (p, filter.next(p, 1.0 / 60.0, SETTINGS))).last().unwrap();
            (last.0.x - last.1.x) / speed
        };
        assert!(lag_secs(4.0) < 0.6 * lag_secs(0.1), "{} {}", lag_secs(4.0), lag_secs(0.1));
    }
}
