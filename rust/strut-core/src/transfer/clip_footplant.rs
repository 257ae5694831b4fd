//! Plants the feet of a whole clip, using past and future frames (`docs/methods/mar.md` §11).
//!
//! A foot is held in the frames that the caller gives, and in those in which the corrected foot is low and slow by the
//! rule of §3. The slide of planted feet is split in two. The low-frequency part is an error of the root's velocity and
//! moves the root. The rest moves the foot relative to the root, in each hold about the middle of its slide. During the
//! swing the correction changes smoothly from the value of one hold to that of the next.

use crate::contact;
use crate::humanoid::{HumanoidMotion, Proportions};
use crate::kinematics::{Limb, SOFT_SHARE, Sole, Soles, WorldPose, two_bone_ik, world_from_local};
use crate::math::Vec3;
use crate::math::gaussian;
use crate::math::interpolation::smooth_step;
use crate::math::stats::runs_where;
use std::collections::VecDeque;
use std::ops::{Add, Mul, Range, Sub};

/// Minimum rate at which smoothed values are computed; between these frames they are interpolated linearly. At the rate
/// of a fast file each value would take as many steps as its window has frames, although neighbouring values hardly
/// differ.
const SMOOTH_HZ: f32 = 240.0;
/// The correction of the slide fades in and out around a hold over this time, seconds.
const EASE_SECS: f32 = 0.034;
/// After a hold the foot returns to its original path within this time, or within the swing if that is shorter; seconds.
const RETURN_SECS: f32 = 0.35;
/// Standard deviation of the low-pass filter that computes the root's share of the slide, seconds.
const ROOT_SIGMA_SECS: f32 = 0.12;
/// At the ends of a hold the foot rolls on or off. Within this time its slide has less weight for the root, seconds.
const ROLL_SECS: f32 = 0.15;
/// Half width of the envelope by which feet are lifted and hips lowered, seconds.
const ENVELOPE_SECS: f32 = 0.1;
/// Depth of a sole below the ground that is tolerated, metres.
const TOLERATED_DEPTH: f32 = 0.003;
/// A foot whose sole is higher than this is not held, whatever the labels are; metres.
const MAX_HELD_HEIGHT: f32 = 0.08;
/// Swings shorter than this, which the rule of §3 can hardly detect, count as part of the hold; seconds.
const MIN_SWING_SECS: f32 = 0.15;
/// A hold starts and ends only with a foot slower than this, m/s …
const MAX_TOUCH_SPEED: f32 = 1.5;
/// … but each end is shortened by no more than this, seconds.
const MAX_TRIM_SECS: f32 = 0.1;
/// The hips are lowered by at most this distance so that a foot can reach its position, metres.
const MAX_DROP: f32 = 0.15;

/// Holds the feet of a clip, left and right, in place while they are planted, and keeps soles above the ground. Returns
/// which feet are held in each frame.
///
/// # Panics
/// If `stands` has fewer entries than the clip has frames.
pub(super) fn plant_feet(motion: &mut HumanoidMotion, stands: &[[bool; 2]]) -> Vec<[bool; 2]> {
    let steps = Steps::of(motion);
    let mut held = steps.plausible(&stands[..motion.poses.len()]);
    // Held feet slow the body, so that the other foot may become planted too. Further iterations change almost nothing.
    let labels = contact::label(&steps.corrected(motion, &held));
    for (held, label) in held.iter_mut().zip(labels) {
        *held = [held[0] || label[0], held[1] || label[1]];
    }
    let shortest = steps.frames(MIN_SWING_SECS);
    for side in 0..2 {
        for gap in runs(&held, side).windows(2).map(|w| w[0].end..w[1].start).filter(|gap| gap.len() < shortest) {
            held[gap].iter_mut().for_each(|h| h[side] = true);
        }
    }
    *motion = steps.corrected(motion, &held);
    held
}

/// Quantities of the uncorrected motion.
struct Steps {
    worlds: Vec<WorldPose>,
    soles: [Vec<Sole>; 2],
    rate_hz: f32,
}

impl Steps {
    fn of(motion: &HumanoidMotion) -> Self {
        let worlds: Vec<WorldPose> = motion.poses.iter().map(|p| world_from_local(&motion.proportions, p)).collect();
        let points = Soles::new(&motion.proportions);
        let soles = [0, 1].map(|side| worlds.iter().map(|w| points.of(w, side)).collect());
        Self { worlds, soles, rate_hz: motion.rate_hz }
    }

    fn frames(&self, secs: f32) -> usize {
        ((secs * self.rate_hz).round() as usize).max(1)
    }

    /// Frames from one computed smoothed value to the next.
    fn stride(&self) -> usize {
        ((self.rate_hz / SMOOTH_HZ) as usize).max(1)
    }

    /// The holds, without frames in which the foot is in the air, and without fast frames at their ends, where holding
    /// would stop the foot abruptly.
    fn plausible(&self, stands: &[[bool; 2]]) -> Vec<[bool; 2]> {
        let on_ground = |side: usize, f: usize| self.soles[side][f].lowest() < MAX_HELD_HEIGHT;
        let mut held: Vec<[bool; 2]> =
            (0..stands.len()).map(|f| std::array::from_fn(|side| stands[f][side] && on_ground(side, f))).collect();
        let most = self.frames(MAX_TRIM_SECS);
        for side in 0..2 {
            let is_fast = |f: &usize| self.travel(side, *f).length() * self.rate_hz > MAX_TOUCH_SPEED;
            for hold in runs(&held, side) {
                // A hold at the start or end of the clip has no touch-down or lift-off there.
                let late = if hold.start > 0 { hold.clone().take(most).take_while(is_fast).count() } else { 0 };
                let leaves = hold.end < held.len();
                let early = if leaves { hold.clone().rev().take(most).take_while(is_fast).count() } else { 0 };
                held[hold.start..hold.start + late].iter_mut().for_each(|h| h[side] = false);
                held[hold.end - early..hold.end].iter_mut().for_each(|h| h[side] = false);
            }
        }
        held
    }

    /// Horizontal travel of a foot's pivot since the frame before.
    fn travel(&self, side: usize, frame: usize) -> Vec3 {
        match frame.checked_sub(1) {
            Some(before) => self.soles[side][frame].pivot_travel(&self.soles[side][before]),
            None => Vec3::ZERO,
        }
    }

    /// The motion with these feet held.
    fn corrected(&self, motion: &HumanoidMotion, held: &[[bool; 2]]) -> HumanoidMotion {
        let root = self.root_path(held);
        let feet = [0, 1].map(|side| self.foot_path(side, held, &root));
        let drop = self.drop(&motion.proportions, held, &root, &feet);
        let mut out = motion.clone();
        for (f, pose) in out.poses.iter_mut().enumerate() {
            pose.root += root[f] - Vec3::Y * drop[f];
            let mut world = world_from_local(&motion.proportions, pose);
            for (side, leg) in Limb::LEGS.into_iter().enumerate() {
                let target = self.ankle(side, f) + feet[side][f];
                two_bone_ik(&motion.proportions, pose, &mut world, leg, target);
            }
        }
        out
    }

    fn ankle(&self, side: usize, frame: usize) -> Vec3 {
        self.worlds[frame].positions[Soles::JOINTS[side][0].index()]
    }

    /// The root's share: the slow part of the held feet's slide, summed.
    fn root_path(&self, held: &[[bool; 2]]) -> Vec<Vec3> {
        let mut slides = vec![(Vec3::ZERO, 0.0_f32); held.len()];
        let roll = self.frames(ROLL_SECS) as f32;
        for side in 0..2 {
            for hold in runs(held, side) {
                for f in hold.clone().skip(1) {
                    let weight = ((f - hold.start).min(hold.end - f) as f32 / roll).min(1.0);
                    slides[f].0 -= self.travel(side, f) * weight;
                    slides[f].1 += weight;
                }
            }
        }
        let sigma = ROOT_SIGMA_SECS * self.rate_hz;
        let reach = (3.0 * sigma) as usize;
        let kernel: Vec<f32> = (0..=reach).map(|i| gaussian::weight(i as f32, sigma)).collect();
        let velocity = |f: usize| {
            // The 1 keeps the root's original path where no foot is held for long.
            let (mut sum, mut weights) = (Vec3::ZERO, 1.0);
            for i in f.saturating_sub(reach)..(f + reach + 1).min(held.len()) {
                sum += slides[i].0 * kernel[f.abs_diff(i)];
                weights += slides[i].1 * kernel[f.abs_diff(i)];
            }
            sum / weights
        };
        let mut path = Vec3::ZERO;
        let velocities = interpolated(held.len(), self.stride(), velocity).into_iter();
        velocities
            .map(|velocity| {
                path += velocity;
                path
            })
            .collect()
    }

    /// Displacement of a foot from its position in the motion, including the ground correction.
    fn foot_path(&self, side: usize, held: &[[bool; 2]], root: &[Vec3]) -> Vec<Vec3> {
        let holds = runs(held, side);
        let shares = self.shares(&holds, held.len());
        // Slide relative to the root's path.
        let mut slid = Vec3::ZERO;
        let slides: Vec<Vec3> = (0..held.len())
            .map(|f| {
                let root_step = if f > 0 { root[f] - root[f - 1] } else { Vec3::ZERO };
                slid += (self.travel(side, f) + root_step) * shares[f];
                slid
            })
            .collect();
        let depths: Vec<f32> = self.soles[side].iter().map(|s| (-s.lowest() - TOLERATED_DEPTH).max(0.0)).collect();
        let lift = envelope(&depths, self.frames(ENVELOPE_SECS), self.stride());
        let middles = self.middles(&holds, &slides);
        (0..held.len()).map(|f| root[f] + middles[f] - slides[f] + Vec3::Y * lift[f]).collect()
    }

    /// Share of a foot's slide that is removed: all of it in holds, fading out around them.
    fn shares(&self, holds: &[Range<usize>], frames: usize) -> Vec<f32> {
        let ease = self.frames(EASE_SECS);
        let mut shares = vec![0.0_f32; frames];
        for hold in holds {
            let first = hold.start.saturating_sub(ease);
            for (f, share) in shares.iter_mut().enumerate().take(hold.end + ease).skip(first) {
                let outside = hold.start.saturating_sub(f).max((f + 1).saturating_sub(hold.end));
                *share = share.max(1.0 - outside as f32 / ease as f32);
            }
        }
        shares
    }

    /// Offset from which slides are measured: the mean slide in each hold, the slide itself in a long swing, so that
    /// the foot follows its original path, and smooth transitions in between.
    fn middles(&self, holds: &[Range<usize>], slides: &[Vec3]) -> Vec<Vec3> {
        let (frames, back) = (slides.len(), self.frames(RETURN_SECS));
        let mut keys: Vec<(Range<usize>, Vec3)> = Vec::new();
        let mut swing_start = 0;
        for hold in holds.iter().cloned().chain(std::iter::once(frames + back..frames + back)) {
            let swing_end = hold.start - back.min(hold.start);
            if swing_start < swing_end {
                keys.push((swing_start..swing_end, slides[swing_start]));
            }
            if !hold.is_empty() {
                let sum = slides[hold.clone()].iter().fold(Vec3::ZERO, |sum, s| sum + *s);
                swing_start = hold.end + back;
                keys.push((hold.clone(), sum / hold.len() as f32));
            }
        }
        let mut middles = Vec::with_capacity(frames);
        let mut next = keys.iter().peekable();
        let mut last: Option<&(Range<usize>, Vec3)> = None;
        for f in 0..frames {
            while let Some(key) = next.next_if(|(range, _)| range.start <= f) {
                last = Some(key);
            }
            middles.push(match (last, next.peek()) {
                (Some((range, middle)), None) if f >= range.end => *middle,
                (Some((range, a)), Some((to, b))) if f >= range.end => {
                    let t = (f + 1 - range.end) as f32 / (to.start + 1 - range.end) as f32;
                    *a + (*b - *a) * smooth_step(0.0, 1.0, t)
                }
                (Some((_, middle)), _) | (None, Some((_, middle))) => *middle,
                (None, None) => Vec3::ZERO,
            });
        }
        middles
    }

    /// Distance by which the hips are lowered so that both legs reach the positions of held feet without being
    /// straighter than before.
    fn drop(&self, proportions: &Proportions, held: &[[bool; 2]], root: &[Vec3], feet: &[Vec<Vec3>; 2]) -> Vec<f32> {
        let mut needed = vec![0.0_f32; held.len()];
        for (side, leg) in Limb::LEGS.into_iter().enumerate() {
            let [hip, knee, ankle] = leg.roles();
            let length = proportions.offsets[knee.index()].length() + proportions.offsets[ankle.index()].length();
            for (f, needed) in needed.iter_mut().enumerate().filter(|(f, _)| held[*f][side]) {
                let hip = self.worlds[f].positions[hip.index()];
                let was = self.ankle(side, f) - hip;
                let reach = was.length().max(length * (1.0 - SOFT_SHARE));
                let wanted = was + feet[side][f] - root[f];
                let across = wanted.x * wanted.x + wanted.z * wanted.z;
                let below = (reach * reach - across).max(0.0).sqrt();
                *needed = needed.max(-wanted.y - below).min(MAX_DROP);
            }
        }
        envelope(&needed, self.frames(ENVELOPE_SECS), self.stride())
    }
}

/// A smooth upper envelope of the values, computed at every `stride`-th of them.
fn envelope(values: &[f32], reach: usize, stride: usize) -> Vec<f32> {
    // The wider maximum keeps the interpolated values above the values, too.
    let peaks = peaks(values, reach + stride - 1);
    let share = |distance: usize| smooth_step(0.0, 1.0, 1.0 - distance as f32 / (reach + 1) as f32);
    let kernel: Vec<f32> = (0..=reach).map(share).collect();
    interpolated(values.len(), stride, |f| {
        let (mut sum, mut weights) = (0.0, 0.0);
        let around = f.saturating_sub(reach)..(f + reach + 1).min(peaks.len());
        for (i, peak) in around.clone().zip(&peaks[around]) {
            let weight = kernel[f.abs_diff(i)];
            sum += weight * peak;
            weights += weight;
        }
        sum / weights
    })
}

/// Maximum of the values within `reach` of each index; at least 0.
fn peaks(values: &[f32], reach: usize) -> Vec<f32> {
    // Indices of the values that may still become the maximum: indices ascend, values descend.
    let mut candidates: VecDeque<usize> = VecDeque::new();
    let mut added = 0;
    let of = |f: usize| {
        let end = (f + reach + 1).min(values.len());
        for i in added..end {
            while candidates.back().is_some_and(|last| values[*last] <= values[i]) {
                candidates.pop_back();
            }
            candidates.push_back(i);
        }
        added = end;
        while candidates.front().is_some_and(|first| first + reach < f) {
            candidates.pop_front();
        }
        candidates.front().map_or(0.0, |first| values[*first].max(0.0))
    };
    (0..values.len()).map(of).collect()
}

/// `count` values: every `stride`-th is computed, and those between are interpolated linearly.
fn interpolated<T>(count: usize, stride: usize, value: impl Fn(usize) -> T) -> Vec<T>
where
    T: Copy + Add<Output = T> + Sub<Output = T> + Mul<f32, Output = T>,
{
    let mut values = Vec::with_capacity(count);
    if count == 0 {
        return values;
    }
    let mut from = value(0);
    for begin in (0..count).step_by(stride) {
        values.push(from);
        let end = (begin + stride).min(count - 1);
        if end > begin {
            let to = value(end);
            let step = (to - from) * (1.0 / (end - begin) as f32);
            let between = 1..stride.min(count - begin);
            values.extend(between.map(|i| from + step * i as f32));
            from = to;
        }
    }
    values
}

/// Maximal runs of frames in which a foot is held.
fn runs(held: &[[bool; 2]], side: usize) -> Vec<Range<usize>> {
    runs_where(held.len(), |frame| held[frame][side])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixtures::{NEUTRAL, walk};
    use crate::metrics::foot_skate;
    use crate::transfer::footplant::tests::crouch;
    use crate::transfer::ground_clearance;
    use proptest::prelude::*;

    /// A crouching figure whose pose is changed in each frame.
    fn crouching(frames: usize, change: impl Fn(&mut crate::humanoid::Pose, f32)) -> HumanoidMotion {
        let poses = (0..frames)
            .map(|f| {
                let mut pose = crouch();
                change(&mut pose, f as f32 / 60.0);
                pose
            })
            .collect();
        HumanoidMotion { proportions: Proportions::default(), rate_hz: 60.0, poses }
    }

    fn skate(motion: &HumanoidMotion) -> f32 {
        foot_skate(motion, &contact::label(motion))
    }

    proptest! {
        #[test]
        fn a_body_that_glides_on_both_feet_stays(speed in -1.2f32..1.2) {
            let mut motion = crouching(120, |pose, t| pose.root.x += speed * t);
            let held = plant_feet(&mut motion, &[[true; 2]; 120]);
            prop_assert!(held.iter().all(|h| *h == [true; 2]));
            prop_assert!(skate(&motion) < 1e-3);
            let travelled = motion.poses[119].root - motion.poses[0].root;
            prop_assert!(travelled.length() < 0.2, "{travelled}");
        }

        #[test]
        fn an_envelope_is_nowhere_below(values in prop::collection::vec(0.0f32..1.0, 0..40), reach in 1usize..8) {
            for stride in [1, 2, 5] {
                let envelope = envelope(&values, reach, stride);
                prop_assert_eq!(envelope.len(), values.len());
                for (e, v) in envelope.iter().zip(&values) {
                    prop_assert!(e + 1e-5 >= *v);
                }
            }
        }

        #[test]
        fn peaks_are_the_greatest_values_around(values in prop::collection::vec(-1.0f32..1.0, 0..40), reach in 0usize..8) {
            let around = |f: usize| &values[f.saturating_sub(reach)..(f + reach + 1).min(values.len())];
            let greatest: Vec<f32> = (0..values.len()).map(|f| around(f).iter().copied().fold(0.0, f32::max)).collect();
            prop_assert_eq!(peaks(&values, reach), greatest);
        }

        #[test]
        fn soles_come_up_to_the_ground(depth in 0.0f32..0.12) {
            let mut motion = crouching(30, |pose, t| if t > 0.2 { pose.root.y -= depth });
            plant_feet(&mut motion, &[[false; 2]; 30]);
            for pose in &motion.poses {
                prop_assert!(ground_clearance(&motion.proportions, pose) > -TOLERATED_DEPTH - 1e-3);
            }
        }
    }

    #[test]
    fn a_walk_that_glides_too_far_is_held_back_without_jerks() {
        let truth = walk(&NEUTRAL, 240, 0.0);
        let stands: Vec<[bool; 2]> = truth.contact.iter().map(|c| c.map(|c| c == 1)).collect();
        let mut motion = HumanoidMotion { proportions: Proportions::default(), rate_hz: 60.0, poses: truth.poses };
        for (f, pose) in motion.poses.iter_mut().enumerate() {
            pose.root.z += 0.2 * f as f32 / 60.0;
        }
        let glides = motion.clone();
        plant_feet(&mut motion, &stands);
        assert!(skate(&glides) > 0.15 && skate(&motion) < 0.01, "{} {}", skate(&glides), skate(&motion));
        let acceleration = |m: &HumanoidMotion| crate::metrics::mean_acceleration(m);
        assert!(acceleration(&motion) < 1.1 * acceleration(&glides));
    }

    #[test]
    fn feet_that_neither_stand_nor_sink_are_unchanged() {
        let flight = crouching(60, |pose, t| {
            pose.root.y += 0.2;
            pose.root.z += 2.0 * t;
        });
        let mut motion = flight.clone();
        // Feet at this height are not held, whatever the labels are.
        let held = plant_feet(&mut motion, &[[true; 2]; 60]);
        assert!(held.iter().all(|h| *h == [false; 2]));
        for (a, b) in motion.poses.iter().zip(&flight.poses) {
            assert!((a.root - b.root).length() < 1e-6);
            assert!(a.rotations.iter().zip(&b.rotations).all(|(a, b)| a.dot(*b) > 1.0 - 1e-5));
        }
    }

    #[test]
    fn a_foot_that_lands_fast_is_held_once_it_has_slowed_down() {
        // From 4 m/s to rest within the first 0.15 s.
        let mut motion = crouching(60, |pose, t| {
            let left = (0.15 - t).max(0.0);
            pose.root.z -= 4.0 * left * left / 0.3;
        });
        let mut stands = [[true; 2]; 60];
        stands[0] = [false; 2];
        let held = plant_feet(&mut motion, &stands);
        assert!(!held[2][0] && held[9][0], "{held:?}");
    }

    /// A body that rocks, dips into the ground and slides on both feet for some seconds, at a frame rate.
    fn rocking(rate_hz: f32, secs: f32) -> HumanoidMotion {
        let mut motion = crouching((secs * rate_hz) as usize, |_, _| ());
        motion.rate_hz = rate_hz;
        for (f, pose) in motion.poses.iter_mut().enumerate() {
            let t = f as f32 / rate_hz;
            pose.root.z += 0.3 * t;
            pose.root.y -= 0.02 * (1.0 - crate::math::float_funcs::cos(6.0 * t));
        }
        motion
    }

    #[test]
    fn fast_files_are_planted_like_others() {
        let planted = |rate_hz: f32| {
            let mut motion = rocking(rate_hz, 2.0);
            let stands = vec![[true; 2]; motion.poses.len()];
            plant_feet(&mut motion, &stands);
            motion.poses
        };
        let (usual, fast) = (planted(240.0), planted(1920.0));
        for (f, pose) in usual.iter().enumerate() {
            let off = (pose.root - fast[8 * f].root).length();
            assert!(off < 5e-3, "{off} m at frame {f}");
        }
    }

    #[test]
    fn fast_files_need_no_more_smoothed_values_than_others() {
        let square = |f: usize| (f * f) as f32;
        for (rate_hz, stride) in [(60.0, 1), (240.0, 1), (10_000.0, 41)] {
            let steps = Steps { worlds: Vec::new(), soles: [Vec::new(), Vec::new()], rate_hz };
            assert_eq!(steps.stride(), stride);
            let found = std::cell::Cell::new(0);
            let values = interpolated(1000, stride, |f| {
                found.set(found.get() + 1);
                square(f)
            });
            assert_eq!(values.len(), 1000);
            assert!(found.get() <= 1000 / stride + 2, "{} at {rate_hz} Hz", found.get());
            for (f, value) in values.iter().enumerate().step_by(stride) {
                assert_eq!(*value, square(f));
            }
        }
    }

    #[test]
    fn a_clip_without_frames_has_no_feet() {
        assert!(plant_feet(&mut crouching(0, |_, _| ()), &[]).is_empty());
    }
}
