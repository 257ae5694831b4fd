//! Moving part of a clip that is registered as a whole, without standing still before and after.

use crate::humanoid::{JOINTS, Role};
use crate::math::Vec3;
use std::ops::Range;

/// Effectors whose motion is detected: hips, head, hands and feet.
pub(super) const EFFECTORS: [Role; 6] =
    [Role::Hips, Role::Head, Role::LeftHand, Role::RightHand, Role::LeftFoot, Role::RightFoot];
/// A clip stands still until its fastest effector reaches this share of its speed in a fast moment.
const ONSET_SHARE: f32 = 0.1;
/// Percentile of the speeds that defines a fast moment.
const FAST_PERCENTILE: f32 = 0.95;
/// Time at rest that is kept on either side so that the onset is included, seconds.
const KEPT_SECS: f32 = 0.1;
/// If fewer frames move than this, the whole clip is registered.
const MIN_FRAMES: usize = 8;

/// Frames from the first to the last motion of a clip; all frames if there is hardly any motion.
pub(super) fn moving(cloud: &[[Vec3; JOINTS]], rate_hz: f32) -> Range<usize> {
    let speed: Vec<f32> = cloud
        .windows(2)
        .map(|w| EFFECTORS.iter().map(|r| (w[1][r.index()] - w[0][r.index()]).length()).fold(0.0, f32::max))
        .collect();
    let mut sorted = speed.clone();
    sorted.sort_by(f32::total_cmp);
    let fast = sorted.get((FAST_PERCENTILE * sorted.len() as f32) as usize).copied().unwrap_or(0.0);
    let moves = |s: &f32| *s > ONSET_SHARE * fast;
    let (Some(first), Some(last)) = (speed.iter().position(moves), speed.iter().rposition(moves)) else {
        return 0..cloud.len();
    };
    let kept = (KEPT_SECS * rate_hz).round() as usize;
    let frames = first.saturating_sub(kept)..(last + 2 + kept).min(cloud.len());
    if frames.len() < MIN_FRAMES { 0..cloud.len() } else { frames }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A hand that swings from frame `from` to `to` and is still before and after.
    fn swing(frames: usize, from: usize, to: usize) -> Vec<[Vec3; JOINTS]> {
        (0..frames)
            .map(|f| {
                let mut points = [Vec3::ZERO; JOINTS];
                points[Role::LeftHand.index()].y = f.clamp(from, to) as f32 * 0.02;
                points
            })
            .collect()
    }

    #[test]
    fn standing_before_and_after_is_left_out() {
        assert_eq!(moving(&swing(200, 60, 120), 60.0), 54..127);
        assert_eq!(moving(&swing(200, 0, 199), 60.0), 0..200);
    }

    #[test]
    fn a_clip_that_stands_still_is_kept_whole() {
        assert_eq!(moving(&swing(50, 0, 0), 60.0), 0..50);
        assert_eq!(moving(&[], 60.0), 0..0);
    }
}
