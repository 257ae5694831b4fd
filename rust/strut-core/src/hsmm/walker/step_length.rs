//! Correction of step lengths to those of the mixture of styles (`docs/methods/hsmm.md` §11).

use crate::math::Vec3;

/// Share of the length error of two steps that the next two steps correct.
const GAIN: f32 = 0.5;
/// Range of the factor of the legs' swing. Beyond 1.2 the steps of an exaggerated style may get shorter again: a stretched
/// leg comes down early and pushes the body back.
pub(super) const SHARE: [f32; 2] = [0.75, 1.2];

/// A frame of a walk.
#[derive(Clone, Copy, Debug)]
pub(super) struct WalkedFrame {
    /// Number of its step.
    pub(super) step: u64,
    /// Target length of that step, metres; `None` without a target.
    pub(super) length: Option<f32>,
    /// Place of the body.
    pub(super) place: Vec3,
}

/// A pair of walked steps.
#[derive(Clone, Copy, Debug)]
struct Stride {
    from: Vec3,
    /// Total target length of its completed steps, metres.
    expected: f32,
}

/// Controls the factor of the legs' swing so that steps reach their target lengths. The length of a step is not a linear
/// function of the joints' angles, and limits of joints shorten it, so it is measured: the next two steps correct the error
/// of the last two, and the distance over many steps is accurate. Feet stay planted, because the path follows from the legs.
#[derive(Clone, Copy, Debug)]
pub(super) struct StepLength {
    share: f32,
    /// Step and target length of the last frame.
    step: u64,
    length: Option<f32>,
    stride: Option<Stride>,
}

impl Default for StepLength {
    fn default() -> Self {
        Self { share: 1.0, step: 0, length: None, stride: None }
    }
}

impl StepLength {
    /// Processes a frame; returns the new factor of the swing after every pair of steps.
    pub(super) fn advance(&mut self, frame: WalkedFrame) -> Option<f32> {
        let (last_step, last_length) = (self.step, self.length);
        (self.step, self.length) = (frame.step, frame.length);
        if frame.length.is_none() {
            self.stride = None;
        }
        let mut share = None;
        if let Some(length) = last_length
            && frame.length.is_some()
            && frame.step != last_step
        {
            if let Some(stride) = &mut self.stride {
                stride.expected += length;
            }
            if frame.step.is_multiple_of(2) {
                let next = Stride { from: frame.place, expected: 0.0 };
                share = self.stride.replace(next).map(|stride| stride.corrected(self.share, frame.place));
                self.share = share.unwrap_or(self.share);
            }
        }
        share
    }
}

impl Stride {
    /// The factor of the swing after these steps, if they had the factor `share` and ended at a place.
    fn corrected(&self, share: f32, to: Vec3) -> f32 {
        let found = (to - self.from).length();
        let longest = found.max(self.expected);
        let lacks = if longest > 0.0 { (self.expected - found) / longest } else { 0.0 };
        (share + GAIN * lacks).clamp(SHARE[0], SHARE[1])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Frames of a step.
    const FRAMES: u64 = 15;

    /// Walks steps with a target length whose real length is a function of the factor; returns the distance and the last
    /// factor.
    fn walk(steps: u64, length: Option<f32>, length_of: impl Fn(f32) -> f32) -> (f32, f32) {
        let (mut controlled, mut share, mut way) = (StepLength::default(), 1.0, 0.0);
        for frame in 0..steps * FRAMES {
            let place = Vec3::new(0.0, 0.0, way);
            share = controlled.advance(WalkedFrame { step: frame / FRAMES, length, place }).unwrap_or(share);
            way += length_of(share) / FRAMES as f32;
        }
        (way, share)
    }

    proptest! {
        #[test]
        fn the_way_is_that_of_all_steps(length in 0.3f32..0.9, bent in -0.3f32..0.3, should_be in 0.85f32..1.15) {
            // The length of a step is not linear in the factor.
            let length_of = |share: f32| length * (share + bent * (share - 1.0) * share);
            let asked = length_of(should_be);
            let (first, _) = walk(20, Some(asked), length_of);
            let (all, share) = walk(60, Some(asked), length_of);
            prop_assert!((share - should_be).abs() < 0.002, "{share} instead of {should_be}");
            prop_assert!(((all - first) / 40.0 - asked).abs() < 0.002 * asked);
        }
    }

    #[test]
    fn legs_swing_no_farther_than_helps() {
        assert_eq!(walk(80, Some(2.0), |share| 0.6 * share).1, SHARE[1]);
        assert_eq!(walk(80, Some(0.0), |share| 0.6 * share).1, SHARE[0]);
    }

    #[test]
    fn nothing_changes_where_no_length_is_asked_for() {
        assert_eq!(walk(40, None, |share| 0.6 * share).1, 1.0);
    }
}
