//! Labels the foot contacts of a clip (`docs/methods/mar.md` §3).
//!
//! A foot is planted while one of its two points, ankle (heel) or toes, is low *and* slow. Each point has
//! its own hysteresis, so that a point that rolls or jitters near a threshold does not flicker. Heights are
//! measured from the clip's floor: a low percentile of the point's own heights, since marker offsets and
//! shoes put the "ground" of ankle and toes at different levels from clip to clip.

use crate::humanoid::{HumanoidMotion, Proportions, Role};
use crate::kinematics::world_from_local;
use crate::math::Vec3;
use crate::math::stats::quantile;

/// Leg length that the thresholds of §3 were measured on, metres.
const REFERENCE_LEG_LENGTH: f32 = 0.8;
/// Speeds are central differences over about this time: one frame at 60 Hz.
const SPEED_HALF_WINDOW_SECS: f32 = 1.0 / 60.0;

/// Contact thresholds of a point of the foot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Thresholds {
    /// Planted below this height above the floor, metres …
    pub on_height: f32,
    /// … and below this speed, m/s.
    pub on_speed: f32,
    /// Lifted above this height, metres …
    pub off_height: f32,
    /// … or above this speed, m/s.
    pub off_speed: f32,
    /// Quantile of the point's heights that is its floor, in [0, 1].
    pub floor_percentile: f32,
    /// Contacts and gaps shorter than this are removed, seconds.
    pub min_duration_secs: f32,
}

impl Default for Thresholds {
    /// Measured on a person whose legs are 0.8 m long (`docs/methods/mar.md` §3): clean gait cycles on every
    /// locomotion clip.
    fn default() -> Self {
        Self {
            on_height: 0.03,
            on_speed: 0.45,
            off_height: 0.06,
            off_speed: 0.90,
            floor_percentile: 0.05,
            min_duration_secs: 0.1,
        }
    }
}

impl Thresholds {
    /// The defaults with heights and speeds in proportion to the legs, within a factor of 2.5.
    pub fn scaled_to(proportions: &Proportions) -> Self {
        let scale = (proportions.leg_length() / REFERENCE_LEG_LENGTH).clamp(0.4, 2.5);
        let t = Self::default();
        Self {
            on_height: t.on_height * scale,
            on_speed: t.on_speed * scale,
            off_height: t.off_height * scale,
            off_speed: t.off_speed * scale,
            ..t
        }
    }
}

/// Whether the left and the right foot is planted, for every frame; with thresholds scaled to the legs.
pub fn label(motion: &HumanoidMotion) -> Vec<[bool; 2]> {
    label_with(motion, &Thresholds::scaled_to(&motion.proportions))
}

/// Whether the left and the right foot is planted, for every frame.
pub fn label_with(motion: &HumanoidMotion, thresholds: &Thresholds) -> Vec<[bool; 2]> {
    const POINTS: [[Role; 2]; 2] = [[Role::LeftFoot, Role::RightFoot], [Role::LeftToes, Role::RightToes]];
    let mut tracks: [[Vec<Vec3>; 2]; 2] = Default::default();
    for pose in &motion.poses {
        let world = world_from_local(&motion.proportions, pose);
        for (sides, roles) in tracks.iter_mut().zip(POINTS) {
            for (track, role) in sides.iter_mut().zip(roles) {
                track.push(world.positions[role.index()]);
            }
        }
    }
    let mut labels = vec![[false; 2]; motion.poses.len()];
    for sides in &tracks {
        // Both feet stand on the same floor; a foot that never touches it would give a wrong height.
        let floor = percentile(sides.iter().flatten().map(|p| p.y), thresholds.floor_percentile);
        for (side, track) in sides.iter().enumerate() {
            let mut planted = false;
            for (f, label) in labels.iter_mut().enumerate() {
                let height = track[f].y - floor;
                let speed = speed(track, f, motion.rate_hz);
                planted = if planted {
                    height <= thresholds.off_height && speed <= thresholds.off_speed
                } else {
                    height < thresholds.on_height && speed < thresholds.on_speed
                };
                label[side] |= planted;
            }
        }
    }
    let shortest = (thresholds.min_duration_secs * motion.rate_hz).round() as usize;
    for side in 0..2 {
        // Gaps first: a short gap inside a contact is a flicker, not two short contacts.
        flip_short_runs(&mut labels, side, false, shortest);
        flip_short_runs(&mut labels, side, true, shortest);
    }
    labels
}

/// The quantile `p` of the numbers; 0 if there are none.
fn percentile(values: impl Iterator<Item = f32>, p: f32) -> f32 {
    let mut sorted: Vec<f32> = values.collect();
    sorted.sort_by(f32::total_cmp);
    quantile(&sorted, p)
}

/// Speed of a point at a frame, m/s: a central difference, one-sided at the ends; 0 for a single frame.
fn speed(track: &[Vec3], frame: usize, rate_hz: f32) -> f32 {
    let half = ((SPEED_HALF_WINDOW_SECS * rate_hz).round() as usize).max(1);
    let (before, after) = (frame.saturating_sub(half), (frame + half).min(track.len() - 1));
    (track[after] - track[before]).length() * rate_hz / (after - before).max(1) as f32
}

/// Inverts runs of `value` that are shorter than `shortest` frames and not at the clip's ends.
fn flip_short_runs(labels: &mut [[bool; 2]], side: usize, value: bool, shortest: usize) {
    let mut start = 0;
    while start < labels.len() {
        let this = labels[start][side];
        let run = labels[start..].iter().take_while(|l| l[side] == this).count();
        let inside = start > 0 && start + run < labels.len();
        if this == value && inside && run < shortest {
            for label in &mut labels[start..start + run] {
                label[side] = !value;
            }
        }
        start += run;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::humanoid::Pose;
    use crate::math::float_funcs::{cos, sin};

    /// A body that glides forward with stiff legs; `height` and `speed` per frame apply to both feet.
    fn gliding(frames: usize, height: impl Fn(usize) -> f32, speed: impl Fn(usize) -> f32) -> HumanoidMotion {
        let proportions = Proportions::default();
        let mut z = 0.0;
        let poses = (0..frames)
            .map(|f| {
                let mut pose = Pose::default();
                pose.root.y += height(f);
                pose.root.z = z;
                z += speed(f) / 60.0;
                pose
            })
            .collect();
        HumanoidMotion { proportions, rate_hz: 60.0, poses }
    }

    fn left(motion: &HumanoidMotion) -> Vec<bool> {
        label(motion).iter().map(|l| l[0]).collect()
    }

    #[test]
    fn a_standing_foot_is_planted_and_a_fast_or_high_one_is_not() {
        assert!(left(&gliding(60, |_| 0.0, |_| 0.0)).iter().all(|&c| c));
        assert!(left(&gliding(60, |_| 0.0, |_| 1.5)).iter().all(|&c| !c));
        let lifted = left(&gliding(60, |f| if f < 30 { 0.0 } else { 0.2 }, |_| 0.0));
        assert!(lifted[..28].iter().all(|&c| c) && lifted[32..].iter().all(|&c| !c));
    }

    #[test]
    fn between_the_thresholds_the_last_state_holds() {
        // 4 cm is above "on" (3 cm) and below "off" (6 cm): planted if the foot came from below, lifted if from above.
        let levels = [0.0, 0.04, 0.10, 0.04, 0.0, 0.0];
        let height = |f: usize| {
            // Ten frames from one level to the next, so that the speed stays below its thresholds.
            let t = ((f % 20) as f32 / 10.0 - 1.0).max(0.0);
            levels[f / 20] + (levels[f / 20 + 1] - levels[f / 20]) * t
        };
        let planted = left(&gliding(100, height, |_| 0.0));
        for (frame, expected) in [(5, true), (25, true), (45, false), (65, false), (90, true)] {
            assert_eq!(planted[frame], expected, "frame {frame}");
        }
    }

    #[test]
    fn a_flicker_shorter_than_six_frames_is_removed() {
        let fast = |f: usize| if (30..32).contains(&f) { 3.0 } else { 0.0 };
        assert!(left(&gliding(60, |_| 0.0, fast)).iter().filter(|&&c| !c).count() <= 4);
        let mut labels = vec![[true; 2]; 20];
        labels[10] = [false, true];
        flip_short_runs(&mut labels, 0, false, 3);
        assert!(labels.iter().all(|l| l[0]));
    }

    #[test]
    fn feet_that_step_in_turn_are_labelled_in_turn() {
        // Legs swing about the hips in antiphase while the hips travel: a foot is slow on the ground when
        // its backward swing cancels the travel.
        let proportions = Proportions::default();
        let poses = (0..240_u16)
            .map(|f| {
                let phase = f32::from(f) / 60.0 * std::f32::consts::TAU;
                let mut pose = Pose::default();
                pose.root.z = f32::from(f) / 60.0 * 1.0;
                for (upper, lower, phase) in [
                    (Role::LeftUpperLeg, Role::LeftLowerLeg, phase),
                    (Role::RightUpperLeg, Role::RightLowerLeg, phase + std::f32::consts::PI),
                ] {
                    pose.rotations[upper.index()] = crate::math::Quat::from_rotation_x(-0.25 * sin(phase));
                    let lift = cos(phase).max(0.0);
                    pose.rotations[lower.index()] = crate::math::Quat::from_rotation_x(0.9 * lift);
                }
                pose
            })
            .collect();
        let labels = label(&HumanoidMotion { proportions, rate_hz: 60.0, poses });
        let onsets = |side: usize| -> Vec<usize> {
            (1..labels.len()).filter(|&f| labels[f][side] && !labels[f - 1][side]).collect()
        };
        let (left, right) = (onsets(0), onsets(1));
        assert_eq!((left.len(), right.len()), (4, 4), "{left:?} {right:?}");
        assert!(left.windows(2).all(|w| w[1] - w[0] == 60), "{left:?}");
        assert!(left.iter().zip(&right).all(|(l, r)| l.abs_diff(*r) == 30), "{left:?} {right:?}");
    }

    #[test]
    fn the_labels_do_not_depend_on_where_the_floor_is() {
        let walk = |y: f32| gliding(90, move |f| y + if f % 30 < 15 { 0.0 } else { 0.15 }, |_| 0.2);
        assert_eq!(label(&walk(0.0)), label(&walk(-3.7)));
        assert!(label(&walk(0.0)).iter().any(|l| l[0]) && label(&walk(0.0)).iter().any(|l| !l[0]));
    }

    #[test]
    fn an_empty_clip_has_no_labels() {
        assert!(label(&gliding(0, |_| 0.0, |_| 0.0)).is_empty());
        assert_eq!(label(&gliding(1, |_| 0.0, |_| 0.0)), [[true; 2]]);
    }
}
