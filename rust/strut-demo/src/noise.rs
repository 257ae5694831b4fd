//! Small, smooth, seeded irregularity, so that no two strides are identical.

use crate::periodic::b_spline;
use strut_core::math::random::SplitMix64;

/// Random functions of the script phase that repeat with the script, so that a take can be looped.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Noise {
    seed: u64,
    strides: u32,
}

/// The quantity that a noise value acts on. The same channel of the same script has the same noise in every style:
/// irregularities belong to the script, their size to the style.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Channel {
    Tempo,
    StepLength,
    StepWidth,
    ToeOut,
    Sway,
    TrunkPitch,
    TrunkYaw,
    TrunkRoll,
    HeadPitch,
    HeadYaw,
    LeftArm,
    RightArm,
    LeftElbow,
    RightElbow,
    LeftSpread,
    RightSpread,
}

impl Noise {
    /// Noise of a script of this number of strides (at least 1).
    pub(crate) fn new(seed: u64, strides: u32) -> Self {
        Self { seed, strides: strides.max(1) }
    }

    /// A smooth function of phase with about one oscillation per stride, standard deviation near 0.4, within [−1, 1].
    pub(crate) fn smooth(self, channel: Channel, phase: f32) -> f32 {
        let i = phase.floor();
        let knot = |k: i64| self.step(channel, 2 * (i as i64 + k));
        b_spline([knot(-1), knot(0), knot(1), knot(2)], phase - i)
    }

    /// An independent number in [−1, 1] for every step (two per stride), which repeats with the script.
    pub(crate) fn step(self, channel: Channel, index: i64) -> f32 {
        let index = index.rem_euclid(2 * i64::from(self.strides)) as u64;
        within_one(split_mix(split_mix(self.seed ^ (channel as u64) << 48) ^ index))
    }
}

/// A number in [−1, 1] from random bits.
pub(crate) fn within_one(bits: u64) -> f32 {
    (bits >> 40) as f32 / (1_u32 << 23) as f32 - 1.0
}

/// First random bits of a seed: a hash of it.
pub(crate) fn split_mix(seed: u64) -> u64 {
    SplitMix64::new(seed).next_u64()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_repeats_with_the_script_and_differs_between_channels() {
        let n = Noise::new(7, 12);
        assert_eq!(n.smooth(Channel::Sway, 0.25), n.smooth(Channel::Sway, 12.25));
        assert_ne!(n.smooth(Channel::Sway, 0.3), n.smooth(Channel::LeftArm, 0.3));
        assert_ne!(n.smooth(Channel::Sway, 0.3), Noise::new(8, 12).smooth(Channel::Sway, 0.3));
    }

    #[test]
    fn noise_has_no_bias_and_stays_within_bounds() {
        let n = Noise::new(1, 4000);
        let values: Vec<f32> = (0..4000).map(|i| n.smooth(Channel::Tempo, i as f32 + 0.4)).collect();
        assert!(values.iter().all(|v| v.abs() <= 1.0));
        assert!((values.iter().sum::<f32>() / 4000.0).abs() < 0.03);
    }
}
