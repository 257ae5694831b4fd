//! Segmentation of walks into steps (`docs/methods/hsmm.md` §4).

use super::features::Track;
use super::model::Side;
use crate::humanoid::{JOINTS, Role};
use crate::math::Vec3;
use std::ops::Range;

/// Least number of frames between two strikes of a foot.
const LEAST_DISTANCE: usize = 10;
/// Least prominence of a strike in the foot's distance in front of the hips, metres, and as a share of the foot's range.
const LEAST_PROMINENCE: f32 = 0.04;
const PROMINENCE_SHARE: f32 = 0.35;
/// The foot comes to rest within this many frames of its foremost point …
const LATEST_CONTACT: usize = 5;
/// … below this share of its greatest speed in this many frames before.
const CONTACT_SPEED_SHARE: f32 = 0.25;
const SWING_FRAMES: usize = 10;
/// Range of a step's duration, frames.
const LENGTHS: Range<usize> = 6..46;

/// One step of a clip: from the strike of one foot to that of the other.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// The foot that swings and strikes last.
    pub side: Side,
    /// Its frames; the frame of the last strike belongs to the next step.
    pub frames: Range<usize>,
}

/// Returns all steps of a clip, in order; there may be gaps between them.
pub fn steps_of(track: &Track) -> Vec<Step> {
    let mut strikes: Vec<(usize, Side)> = [(Side::Left, Role::LeftFoot), (Side::Right, Role::RightFoot)]
        .into_iter()
        .flat_map(|(side, foot)| strikes(&track.positions, foot).into_iter().map(move |frame| (frame, side)))
        .collect();
    strikes.sort_unstable_by_key(|&(frame, side)| (frame, side == Side::Right));
    let pairs = strikes.windows(2).filter(|pair| pair[0].1 != pair[1].1);
    let steps = pairs.map(|pair| Step { side: pair[1].1, frames: pair[0].0..pair[1].0 });
    steps.filter(|step| LENGTHS.contains(&step.frames.len())).collect()
}

/// Frames at which a foot comes to rest in front of the hips.
fn strikes(positions: &[[Vec3; JOINTS]], foot: Role) -> Vec<usize> {
    let ahead: Vec<f32> = positions.iter().map(|p| (p[foot.index()] - p[0]).z).collect();
    let ahead = smoothed(&ahead);
    let range =
        ahead.iter().copied().fold(f32::NEG_INFINITY, f32::max) - ahead.iter().copied().fold(f32::INFINITY, f32::min);
    let speed = |t: usize| (positions[t][foot.index()] - positions[t.saturating_sub(1)][foot.index()]).length();
    let contact = |peak: usize| {
        let fastest = (peak.saturating_sub(SWING_FRAMES)..=peak).map(speed).fold(0.0, f32::max);
        let rest =
            (peak..positions.len().min(peak + LATEST_CONTACT + 1)).find(|&t| speed(t) < CONTACT_SPEED_SHARE * fastest);
        rest.unwrap_or((peak + LATEST_CONTACT).min(positions.len() - 1))
    };
    peaks(&ahead, LEAST_PROMINENCE.max(PROMINENCE_SHARE * range)).into_iter().map(contact).collect()
}

/// Savitzky-Golay filter of five points and order two; the end points are unchanged.
fn smoothed(values: &[f32]) -> Vec<f32> {
    let mut out = values.to_vec();
    for (i, w) in values.windows(5).enumerate() {
        out[i + 2] = (-3.0 * (w[0] + w[4]) + 12.0 * (w[1] + w[3]) + 17.0 * w[2]) / 35.0;
    }
    out
}

/// Local maxima of sufficient prominence in ascending order; of near ones, the greatest is kept.
fn peaks(values: &[f32], least_prominence: f32) -> Vec<usize> {
    let inner = 1..values.len().saturating_sub(1);
    let mut maxima: Vec<usize> = inner.filter(|&i| values[i] > values[i - 1] && values[i] >= values[i + 1]).collect();
    maxima.sort_by(|&a, &b| values[b].total_cmp(&values[a]).then(a.cmp(&b)));
    let mut kept: Vec<usize> = Vec::new();
    for i in maxima {
        if kept.iter().all(|k| k.abs_diff(i) >= LEAST_DISTANCE) {
            kept.push(i);
        }
    }
    kept.retain(|&i| prominence(values, i) >= least_prominence);
    kept.sort_unstable();
    kept
}

/// Prominence of a maximum: its height above the higher of the valleys between it and higher ground, or the ends.
fn prominence(values: &[f32], peak: usize) -> f32 {
    let valley = |side: &mut dyn Iterator<Item = &f32>| {
        side.take_while(|v| **v <= values[peak]).copied().fold(values[peak], f32::min)
    };
    values[peak] - valley(&mut values[..peak].iter().rev()).max(valley(&mut values[peak + 1..].iter()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_near_maxima_the_greatest_counts_and_small_ones_do_not() {
        let mut values = vec![0.0_f32; 60];
        (values[10], values[14], values[30], values[45]) = (1.0, 1.2, 0.1, 0.8);
        assert_eq!(peaks(&values, 0.3), [14, 45]);
        assert!((prominence(&values, 14) - 1.2).abs() < 1e-6);
    }

    #[test]
    fn the_filter_leaves_parabolas_alone() {
        let parabola: Vec<f32> = (0..20).map(|i| 0.5 * (i as f32 - 8.0) * (i as f32 - 8.0)).collect();
        for (a, b) in smoothed(&parabola).iter().zip(&parabola) {
            assert!((a - b).abs() < 1e-4);
        }
    }
}
