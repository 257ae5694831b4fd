//! Scripts of takes, the same in every style: strides with a speed and a turn rate.

use crate::action::Action;
use strut_core::math::float_funcs::wrap_angle;
use strut_core::math::interpolation::smooth_step;

/// A section of a script.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Passage {
    /// Length in strides (two steps each).
    pub strides: u32,
    /// Speed as a multiple of the style's preferred one.
    pub speed: f32,
    /// Degrees turned to the left over the passage; negative is to the right.
    pub turn_degrees: f32,
}

/// A take: its name, its action and passages, and the seed of its irregularities.
///
/// Time within a script is counted in strides (the *phase*): whole numbers are heel strikes of the left foot, halves of
/// the right. Frames of two styles with the same phase are counterparts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Script {
    /// Name, part of the clips' names.
    pub name: &'static str,
    /// The action.
    pub action: Action,
    /// Sections in order; the last one leads back to the first. At least one.
    pub passages: &'static [Passage],
    /// Seed of all irregularities.
    pub seed: u64,
}

/// Strides before and after a change of passage over which speed and turn rate change.
const EASE_STRIDES: f32 = 0.75;

impl Script {
    /// Length in strides.
    pub fn strides(&self) -> u32 {
        self.passages.iter().map(|p| p.strides).sum()
    }

    /// Speed at a phase as a multiple of the style's preferred one; periodic with the script.
    pub(crate) fn speed(&self, phase: f32) -> f32 {
        self.eased(phase, |p| p.speed)
    }

    /// Turn rate at a phase, radians to the left per stride; periodic with the script.
    pub(crate) fn turn_rate(&self, phase: f32) -> f32 {
        self.eased(phase, |p| p.turn_degrees.to_radians() / p.strides as f32)
    }

    /// Heading at the end, relative to the start, radians.
    pub fn net_turn(&self) -> f32 {
        wrap_angle(self.passages.iter().map(|p| p.turn_degrees.to_radians()).sum())
    }

    fn eased(&self, phase: f32, value: impl Fn(&Passage) -> f32) -> f32 {
        let n = self.passages.len();
        let length = self.strides() as f32;
        let phase = phase - (phase / length).floor() * length;
        let mut begin = 0.0;
        for (i, p) in self.passages.iter().enumerate() {
            let end = begin + p.strides as f32;
            if phase < end || i + 1 == n {
                let from = value(&self.passages[(i + n - 1) % n]);
                let to = value(&self.passages[(i + 1) % n]);
                let here = value(p);
                let entered = smooth_step(begin - EASE_STRIDES, begin + EASE_STRIDES, phase);
                let left = smooth_step(end - EASE_STRIDES, end + EASE_STRIDES, phase);
                return from + (here - from) * entered + (to - here) * left;
            }
            begin = end;
        }
        1.0
    }
}

pub(crate) const fn passage(strides: u32, speed: f32, turn_degrees: f32) -> Passage {
    Passage { strides, speed, turn_degrees }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::takes::{INPUT_TAKES, RUN_TAKES, WALK_TAKES};

    #[test]
    fn turning_adds_up_to_what_the_passages_say() {
        let s = &WALK_TAKES[1];
        let n = 200 * s.strides();
        let total: f32 = (0..n).map(|i| s.turn_rate((i as f32 + 0.5) / 200.0) / 200.0).sum();
        assert!((wrap_angle(total) - s.net_turn()).abs() < 1e-3, "{total} {}", s.net_turn());
    }

    #[test]
    fn speed_changes_without_a_step_also_where_the_script_repeats() {
        for s in WALK_TAKES.iter().chain(&RUN_TAKES).chain(&INPUT_TAKES) {
            let n = 100 * s.strides();
            for i in 0..=n {
                let x = i as f32 / 100.0;
                assert!((s.speed(x + 0.01) - s.speed(x)).abs() < 0.01);
            }
        }
    }
}
