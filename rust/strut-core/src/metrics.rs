//! Quality measures of a motion: numbers only, no thresholds.

use crate::humanoid::{HumanoidMotion, JOINTS};
use crate::kinematics::{Sole, Soles, world_from_local};
use crate::math::Vec3;

/// Joint positions of a frame, metres.
pub type Points = [Vec3; JOINTS];

/// Mean distance of corresponding joints over the frames that both have, metres; 0 without frames. With
/// [`crate::pose_vector::point_cloud`]s, which have no root and heading, it is the pose error of `docs/methods/mar.md` §12.
pub fn pose_error(a: &[Points], b: &[Points]) -> f32 {
    let frames = a.len().min(b.len());
    let sum: f64 = a.iter().zip(b).flat_map(|(a, b)| a.iter().zip(b)).map(|(p, q)| f64::from((*p - *q).length())).sum();
    (sum / (frames * JOINTS).max(1) as f64) as f32
}

/// Mean horizontal speed of the pivot of a foot (heel or ball, whichever is lower) over all pairs of successive planted
/// frames, m/s; 0 if no foot is ever planted.
pub fn foot_skate(motion: &HumanoidMotion, planted: &[[bool; 2]]) -> f32 {
    let soles = Soles::new(&motion.proportions);
    let feet: Vec<[Sole; 2]> = motion
        .poses
        .iter()
        .map(|pose| {
            let world = world_from_local(&motion.proportions, pose);
            std::array::from_fn(|side| soles.of(&world, side))
        })
        .collect();
    let (mut travel, mut steps) = (0.0_f64, 0_usize);
    for (feet, planted) in feet.windows(2).zip(planted.windows(2)) {
        for side in 0..2 {
            if planted[0][side] && planted[1][side] {
                travel += f64::from(feet[1][side].pivot_travel(&feet[0][side]).length());
                steps += 1;
            }
        }
    }
    (travel * f64::from(motion.rate_hz) / steps.max(1) as f64) as f32
}

/// Mean magnitude of the joints' acceleration in the world, m/s²; 0 for fewer than 3 frames.
pub fn mean_acceleration(motion: &HumanoidMotion) -> f32 {
    let rate = f64::from(motion.rate_hz);
    mean_difference(motion, |w| w[2] - 2.0 * w[1] + w[0], 3) * (rate * rate) as f32
}

/// Mean magnitude of the joints' jerk in the world, m/s³; 0 for fewer than 4 frames.
pub fn mean_jerk(motion: &HumanoidMotion) -> f32 {
    let rate = f64::from(motion.rate_hz);
    mean_difference(motion, |w| w[3] - 3.0 * w[2] + 3.0 * w[1] - w[0], 4) * (rate * rate * rate) as f32
}

fn mean_difference(motion: &HumanoidMotion, difference: impl Fn(&[Vec3]) -> Vec3, width: usize) -> f32 {
    let points: Vec<Points> = motion.poses.iter().map(|p| world_from_local(&motion.proportions, p).positions).collect();
    let (mut sum, mut count) = (0.0_f64, 0_usize);
    let mut track = vec![Vec3::ZERO; width];
    for frames in points.windows(width) {
        for joint in 0..JOINTS {
            for (p, frame) in track.iter_mut().zip(frames) {
                *p = frame[joint];
            }
            sum += f64::from(difference(&track).length());
            count += 1;
        }
    }
    (sum / count.max(1) as f64) as f32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::humanoid::{Pose, Proportions};

    /// The T-pose sliding along z = f(frame).
    fn sliding(frames: usize, z: impl Fn(f32) -> f32) -> HumanoidMotion {
        let poses = (0..frames)
            .map(|i| {
                let mut pose = Pose::default();
                pose.root.z = z(i as f32);
                pose
            })
            .collect();
        HumanoidMotion { proportions: Proportions::default(), rate_hz: 10.0, poses }
    }

    #[test]
    fn a_slide_is_skate_only_while_planted() {
        let motion = sliding(11, |f| 0.02 * f);
        assert!((foot_skate(&motion, &[[true, false]; 11]) - 0.2).abs() < 1e-5);
        assert_eq!(foot_skate(&motion, &[[false; 2]; 11]), 0.0);
        let mut half = [[true; 2]; 11];
        half[5..].fill([false; 2]);
        assert!((foot_skate(&motion, &half) - 0.2).abs() < 1e-5);
    }

    #[test]
    fn differences_of_a_cubic_are_its_derivatives() {
        // z = t³ with t = frame / 10: z''' = 6; mean z'' over the middle frames 1 … 9 is 6 · 0.5.
        let motion = sliding(11, |f| (0.1 * f) * (0.1 * f) * (0.1 * f));
        assert!((mean_jerk(&motion) - 6.0).abs() < 0.01);
        assert!((mean_acceleration(&motion) - 3.0).abs() < 0.001);
        assert_eq!(mean_jerk(&sliding(3, |f| f * f)), 0.0);
    }

    #[test]
    fn pose_error_is_the_mean_distance() {
        let (mut a, b) = ([Vec3::ZERO; JOINTS], [Vec3::ZERO; JOINTS]);
        a[0] = Vec3::new(0.0, 0.21, 0.0);
        assert!((pose_error(&[a, b], &[b, b]) - 0.005).abs() < 1e-6);
        assert_eq!(pose_error(&[], &[]), 0.0);
    }
}
