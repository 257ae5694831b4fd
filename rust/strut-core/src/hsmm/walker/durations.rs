//! State durations of a step: mixed from the styles, within plausible limits.

use crate::hsmm::joint_range::saturating;
use crate::hsmm::model::STATES;

/// Durations of the states of a step, frames.
pub(super) type Durations = [f32; STATES];

/// Range of a state's duration, frames.
pub(super) const STATE_FRAMES: [f32; 2] = [1.0, 14.0];
/// How much a step may be shorter than the shortest style's or longer than the longest style's, as a share.
const STEP_BEYOND: f32 = 0.15;
/// Tolerance for rounding by which a state's share of the step may exceed the range of the mixed styles, as a share.
const SHARE_BEYOND: f32 = 0.001;

/// Returns the frame at which a state ends, given the frame where it began and the unrounded end in frames. Rounding the sum
/// keeps the cadence exact; every state has at least one frame.
pub(in crate::hsmm) fn counted_end(begin: u64, end: f64) -> u64 {
    (end.round() as u64).max(begin + 1)
}

/// Changes durations by ρ times their variances: d + ρν (the paper's d = d̄ + ρν, in which ρ sets the cadence).
pub(super) fn stretched(durations: &Durations, rho: f32, variances: &Durations) -> Durations {
    let [least, greatest] = STATE_FRAMES;
    std::array::from_fn(|s| (durations[s] + rho * variances[s]).clamp(least, greatest))
}

/// Frames of the shortest and of the longest step.
pub(super) fn shortest_and_longest<'a>(steps: impl Iterator<Item = &'a Durations>) -> [f32; 2] {
    steps.fold([f32::INFINITY, 0.0], |[shortest, longest], step| {
        let frames = step.iter().sum::<f32>();
        [shortest.min(frames), longest.max(frames)]
    })
}

/// Limits the durations of a mixture to plausible ones. In extrapolations states would soon have no duration, and the feet
/// would not alternate any more. So the step gets longer or shorter as a whole, within the range of all styles' steps, while
/// the states' shares of it stay between those of the mixed styles.
pub(super) fn limited<'a>(
    durations: &Durations,
    mixed: impl Iterator<Item = &'a Durations>,
    [shortest, longest]: [f32; 2],
    variances: &Durations,
) -> Durations {
    let asked = durations.iter().sum::<f32>();
    let longer = saturating((asked - longest).max(0.0), STEP_BEYOND * longest);
    let shorter = saturating((shortest - asked).max(0.0), STEP_BEYOND * shortest);
    let frames = asked.clamp(shortest, longest) + longer - shorter;
    let mut shares = [[1.0_f32, 0.0_f32]; STATES];
    for step in mixed {
        let all = step.iter().sum::<f32>();
        for (share, state) in shares.iter_mut().zip(step) {
            *share = [share[0].min(state / all), share[1].max(state / all)];
        }
    }
    let [least, greatest] = STATE_FRAMES;
    let limits = shares.map(|[low, high]| {
        let low = (frames * low * (1.0 - SHARE_BEYOND)).clamp(least, greatest);
        [low, (frames * high * (1.0 + SHARE_BEYOND)).clamp(low, greatest)]
    });
    lasting(durations, frames, &limits, variances)
}

/// Returns durations within their limits that sum to `frames`: each changes in proportion to its variance. If the limits do
/// not allow it, the sum is as near as possible.
pub(super) fn lasting(
    durations: &Durations,
    frames: f32,
    limits: &[[f32; 2]; STATES],
    variances: &Durations,
) -> Durations {
    let mut durations: Durations = std::array::from_fn(|s| durations[s].clamp(limits[s][0], limits[s][1]));
    for _ in 0..STATES {
        let rest = frames - durations.iter().sum::<f32>();
        let gives: [bool; STATES] =
            std::array::from_fn(|s| if rest < 0.0 { durations[s] > limits[s][0] } else { durations[s] < limits[s][1] });
        let all = (0..STATES).filter(|s| gives[*s]).map(|s| variances[s]).sum::<f32>();
        if rest == 0.0 || all <= 0.0 {
            break;
        }
        for s in (0..STATES).filter(|s| gives[*s]) {
            durations[s] = (durations[s] + rest * variances[s] / all).clamp(limits[s][0], limits[s][1]);
        }
    }
    durations
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const VARIANCES: Durations = [1.0, 0.5, 1.0, 2.0, 1.0];

    fn styles() -> impl Strategy<Value = [Durations; 2]> {
        proptest::array::uniform2(proptest::array::uniform5(1.5f32..8.0))
    }

    fn mix([a, b]: &[Durations; 2], k: f32) -> Durations {
        std::array::from_fn(|s| (1.0 - k) * a[s] + k * b[s])
    }

    fn walked(styles: &[Durations; 2], k: f32) -> Durations {
        limited(&mix(styles, k), styles.iter(), shortest_and_longest(styles.iter()), &VARIANCES)
    }

    proptest! {
        #[test]
        fn nothing_changes_between_two_styles(styles in styles(), k in 0.0f32..1.0) {
            for (walked, mixed) in walked(&styles, k).iter().zip(mix(&styles, k)) {
                prop_assert!((walked - mixed).abs() < 1e-4, "{walked} instead of {mixed}");
            }
        }

        #[test]
        fn steps_get_longer_or_shorter_all_the_way(styles in styles(), k in -3.0f32..3.0, by in 0.0f32..1.0) {
            let frames = |k: f32| walked(&styles, k).iter().sum::<f32>();
            let grows = frames(1.0) - frames(0.0);
            prop_assert!((frames(k + by) - frames(k)) * grows.signum() > -1e-3);
        }

        #[test]
        fn every_state_can_be_walked(styles in styles(), k in -5.0f32..5.0) {
            let [least, greatest] = STATE_FRAMES;
            prop_assert!(walked(&styles, k).iter().all(|d| (least..=greatest).contains(d)));
        }
    }
}
