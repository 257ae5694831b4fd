//! Features that registration compares: style-normalised features of every frame (`docs/methods/mar.md` §4).
//!
//! Joint positions and velocities in the heading frame, speed and turn rate, each z-scored within its style, so that
//! postures of a whole clip, such as a bent back or a raised arm, do not dominate the timing. Then events: foot
//! contacts and, in clips that are registered as a whole, the moments at which hands, feet, head and hips are fastest.
//! A projection on the principal axes over the action's clips makes distances cheap to compute.

use super::example::Example;
use super::rest::EFFECTORS;
use crate::humanoid::{JOINTS, Role};
use crate::math::gaussian::smoothed;
use crate::math::{Vec3, sort_by_number};
use crate::parallel::ParallelMap;
use crate::pose_vector::{HEADING_RATE, VELOCITY_X, VELOCITY_Z};
use std::f32::consts::TAU;
use std::ops::Range;

/// In most actions the legs indicate the phase best.
const LEG_WEIGHT: f32 = 3.0;
const VELOCITY_WEIGHT: f32 = 0.5;
/// Speed and turn rate differ between styles for reasons other than timing.
const TRAVEL_WEIGHT: f32 = 0.2;
const CONTACT_WEIGHT: f32 = 1.5;
/// Contact bits are smoothed, so that a label that changes a frame early costs little.
const CONTACT_SIGMA_SECS: f32 = 0.035;
/// Speed is smoothed like contacts. Its maxima are events if they exceed this share of the effector's greatest speed,
/// which counts as at least the floor, m/s, and if they exceed the speed two widths before and after by the factor of
/// prominence: steady motion has no fastest moment.
const EVENT_SHARE: f32 = 0.5;
const EVENT_SPEED_FLOOR: f32 = 0.2;
const EVENT_PROMINENCE: f32 = 1.05;
/// An event is a Gaussian of this width, with this height where the effector is fastest. Events and skips reduce the
/// timing error: 222 → 176 ms for bowing, 55 → 50 ms for jumping, punching and kicking.
const EVENT_SIGMA_SECS: f32 = 0.1;
const EVENT_WEIGHT: f32 = 3.0;
/// Floors of the deviations, so that z-scores do not amplify the noise of joints that hardly move: metres, m/s, m/s, rad/s.
const POSITION_FLOOR: f32 = 0.01;
const VELOCITY_FLOOR: f32 = 0.1;
const SPEED_FLOOR: f32 = 0.1;
const TURNING_FLOOR: f32 = 0.3;
/// In waving or bowing the body stands, and its sway contains no information: higher floors for whole clips, metres and
/// m/s, and the legs have the weight of the arms. Leave-one-out error of waving: 2.81 → 2.16 cm.
const WHOLE_CLIP_POSITION_FLOOR: f32 = 0.05;
const WHOLE_CLIP_VELOCITY_FLOOR: f32 = 0.5;

const VELOCITIES: usize = 3 * JOINTS;
const SPEED: usize = 6 * JOINTS;
const TURNING: usize = SPEED + 1;
const CONTACTS: usize = TURNING + 1;
const EVENTS: usize = CONTACTS + 2;
const RAW: usize = EVENTS + EFFECTORS.len();

/// Dimensions of the projected features; they contain more than 97 % of the variance of walking.
pub(super) const DIMS: usize = 32;
/// Greatest number of frames from which the principal axes are computed.
const PCA_FRAMES: usize = 6000;
/// Number of subspace iterations: the captured variance converges long before the individual axes.
const PCA_ITERATIONS: usize = 12;

/// Features of one frame.
pub(super) type Feature = [f32; DIMS];
type RawFeature = [f32; RAW];

/// Squared distance of two features.
pub(super) fn squared_distance(a: &Feature, b: &Feature) -> f32 {
    let mut lanes = [0.0_f32; 8];
    for (x, y) in a.chunks_exact(8).zip(b.chunks_exact(8)) {
        for (lane, (x, y)) in lanes.iter_mut().zip(x.iter().zip(y)) {
            *lane += (x - y) * (x - y);
        }
    }
    let [a, b, c, d, e, f, g, h] = lanes;
    ((a + e) + (b + f)) + ((c + g) + (d + h))
}

/// Features of every frame of every example. A style's means and deviations are computed from the frames of `compared`:
/// frames in which a clip stands still at its ends would shift them.
pub(super) fn of_examples(
    examples: &[&Example],
    compared: &[Range<usize>],
    styles: usize,
    rate_hz: f32,
    cyclic: bool,
    executor: &impl ParallelMap,
) -> Vec<Vec<Feature>> {
    let mut raw = executor.map(examples.len(), &|i| {
        let mut raw = raw_features(examples[i], rate_hz);
        if !cyclic {
            add_events(&mut raw, rate_hz);
        }
        raw
    });
    for style in 0..styles {
        normalise(examples, compared, &mut raw, style as u16, cyclic);
    }
    let axes = principal_axes(&raw);
    executor.map(raw.len(), &|i| raw[i].iter().map(|r| project(&axes, r)).collect())
}

fn raw_features(example: &Example, rate_hz: f32) -> Vec<RawFeature> {
    let cloud = &example.point_cloud;
    let last = cloud.len().saturating_sub(1);
    let contacts: [Vec<f32>; 2] = [0, 1].map(|side| {
        let bits: Vec<f32> = example.contact.iter().map(|c| f32::from(u8::from(c[side]))).collect();
        smoothed(&bits, CONTACT_SIGMA_SECS * rate_hz)
    });
    (0..cloud.len())
        .map(|f| {
            let mut raw = [0.0; RAW];
            let (before, after) = (f.saturating_sub(1), (f + 1).min(last));
            let per_second = rate_hz / (after - before).max(1) as f32;
            for j in 0..JOINTS {
                let velocity = (cloud[after][j] - cloud[before][j]) * per_second;
                raw[3 * j..3 * j + 3].copy_from_slice(&cloud[f][j].to_array());
                raw[VELOCITIES + 3 * j..VELOCITIES + 3 * j + 3].copy_from_slice(&velocity.to_array());
            }
            let row = &example.pose[f];
            raw[SPEED] = (row[VELOCITY_X] * row[VELOCITY_X] + row[VELOCITY_Z] * row[VELOCITY_Z]).sqrt();
            raw[TURNING] = row[HEADING_RATE];
            for (side, track) in contacts.iter().enumerate() {
                raw[CONTACTS + side] = CONTACT_WEIGHT * track[f];
            }
            raw
        })
        .collect()
}

/// Adds the events of a clip from its velocities, in metres per second.
fn add_events(raw: &mut [RawFeature], rate_hz: f32) {
    for (e, role) in EFFECTORS.iter().enumerate() {
        let velocity = VELOCITIES + 3 * role.index();
        let speed: Vec<f32> = raw.iter().map(|r| Vec3::from_slice(&r[velocity..]).length()).collect();
        for (row, event) in raw.iter_mut().zip(speed_maxima(&speed, rate_hz)) {
            row[EVENTS + e] = EVENT_WEIGHT * event;
        }
    }
}

/// A Gaussian at every pronounced maximum of a speed in m/s, of height 1 at the greatest.
fn speed_maxima(speed: &[f32], rate_hz: f32) -> Vec<f32> {
    let speed = smoothed(speed, CONTACT_SIGMA_SECS * rate_hz);
    let greatest = speed.iter().copied().fold(EVENT_SPEED_FLOOR, f32::max);
    let sigma = EVENT_SIGMA_SECS * rate_hz;
    // Smoothing reduces an isolated peak by this factor.
    let height = sigma * TAU.sqrt();
    let mut peaks = vec![0.0; speed.len()];
    let around = (2.0 * sigma) as usize;
    for f in 1..speed.len().saturating_sub(1) {
        let (s, before, after) = (speed[f], speed[f.saturating_sub(around)], speed[(f + around).min(speed.len() - 1)]);
        let pronounced = s > EVENT_SHARE * greatest && s > EVENT_PROMINENCE * before.max(after);
        if s > speed[f - 1] && s >= speed[f + 1] && pronounced {
            peaks[f] = height * s / greatest;
        }
    }
    smoothed(&peaks, sigma)
}

/// Replaces every feature except the events by its weighted z-score within the style.
fn normalise(examples: &[&Example], compared: &[Range<usize>], raw: &mut [Vec<RawFeature>], style: u16, cyclic: bool) {
    let of_style: Vec<usize> = (0..examples.len()).filter(|&i| examples[i].style == style).collect();
    let count = of_style.iter().map(|&i| compared[i].len()).sum::<usize>();
    if count == 0 {
        return;
    }
    for d in 0..CONTACTS {
        let mean_of = |g: &dyn Fn(f64) -> f64| {
            of_style.iter().flat_map(|&i| &raw[i][compared[i].clone()]).map(|r| g(f64::from(r[d]))).sum::<f64>()
                / count as f64
        };
        let mean = mean_of(&|v| v);
        let deviation = mean_of(&|v| (v - mean) * (v - mean)).sqrt() as f32;
        let (floor, weight) = floor_and_weight(d, cyclic);
        let (mean, scale) = (mean as f32, weight / deviation.max(floor));
        for &i in &of_style {
            for row in &mut raw[i] {
                row[d] = (row[d] - mean) * scale;
            }
        }
    }
}

fn floor_and_weight(d: usize, cyclic: bool) -> (f32, f32) {
    let leg = (Role::LeftUpperLeg.index()..=Role::RightToes.index()).contains(&(d % VELOCITIES / 3));
    let leg_weight = if leg && cyclic { LEG_WEIGHT } else { 1.0 };
    let (position_floor, velocity_floor) =
        if cyclic { (POSITION_FLOOR, VELOCITY_FLOOR) } else { (WHOLE_CLIP_POSITION_FLOOR, WHOLE_CLIP_VELOCITY_FLOOR) };
    match d {
        SPEED => (SPEED_FLOOR, TRAVEL_WEIGHT),
        TURNING => (TURNING_FLOOR, TRAVEL_WEIGHT),
        d if d >= VELOCITIES => (velocity_floor, VELOCITY_WEIGHT * leg_weight),
        _ => (position_floor, leg_weight),
    }
}

/// Orthonormal axes that approximately span the subspace of greatest variance about zero, by subspace iteration. Any
/// orthonormal axes give valid distances, so the individual axes need not converge.
fn principal_axes(raw: &[Vec<RawFeature>]) -> Vec<RawFeature> {
    let frames = raw.iter().map(Vec::len).sum::<usize>();
    let sample = || raw.iter().flatten().step_by(frames.div_ceil(PCA_FRAMES).max(1));
    let mut covariance = vec![[0.0_f32; RAW]; RAW];
    for row in sample() {
        for (c, &a) in covariance.iter_mut().zip(row) {
            for (c, &b) in c.iter_mut().zip(row) {
                *c += a * b;
            }
        }
    }
    // Start from the coordinate axes of greatest variance.
    let mut order: Vec<usize> = (0..RAW).collect();
    sort_by_number(&mut order, |&d| -covariance[d][d]);
    let mut axes: Vec<RawFeature> = order[..DIMS]
        .iter()
        .map(|&d| {
            let mut axis = [0.0; RAW];
            axis[d] = 1.0;
            axis
        })
        .collect();
    for _ in 0..PCA_ITERATIONS {
        let mut next: Vec<RawFeature> =
            axes.iter().map(|axis| std::array::from_fn(|d| dot(&covariance[d], axis))).collect();
        orthonormalise(&mut next);
        axes = next;
    }
    axes
}

/// Modified Gram–Schmidt orthonormalisation, done twice for accuracy; axes that vanish become zero.
fn orthonormalise(axes: &mut [RawFeature]) {
    for i in 0..axes.len() {
        let (before, rest) = axes.split_at_mut(i);
        let axis = &mut rest[0];
        let size = dot(axis, axis).sqrt();
        for _ in 0..2 {
            for other in before.iter() {
                let along = dot(axis, other);
                for (a, o) in axis.iter_mut().zip(other) {
                    *a -= along * o;
                }
            }
        }
        let rest = dot(axis, axis).sqrt();
        let scale = if rest > 1e-5 * size && rest > 0.0 { 1.0 / rest } else { 0.0 };
        for a in axis.iter_mut() {
            *a *= scale;
        }
    }
}

fn dot(a: &RawFeature, b: &RawFeature) -> f32 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

fn project(axes: &[RawFeature], raw: &RawFeature) -> Feature {
    std::array::from_fn(|i| dot(&axes[i], raw))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::float_funcs::exp;

    #[test]
    fn events_are_where_an_effector_is_fast() {
        let bump =
            |f: usize, at: f32, height: f32| height * exp(-0.5 * ((f as f32 - at) / 6.0) * ((f as f32 - at) / 6.0));
        let speed: Vec<f32> =
            (0..200).map(|f| bump(f, 40.0, 2.0) + bump(f, 100.0, 0.8) + bump(f, 160.0, 1.4)).collect();
        let events = speed_maxima(&speed, 60.0);
        assert!((events[40] - 1.0).abs() < 0.01 && (events[160] - 0.7).abs() < 0.01, "{} {}", events[40], events[160]);
        assert!(events[100] < 1e-3, "less than half as fast is no event: {}", events[100]);
        let sway: Vec<f32> = speed.iter().map(|s| 0.04 * s).collect();
        assert!(speed_maxima(&sway, 60.0).iter().all(|e| *e == 0.0), "nor is hardly moving");
        let steady: Vec<f32> = (0..200).map(|f| 1.0 + 0.01 * (f % 7) as f32).collect();
        assert!(speed_maxima(&steady, 60.0).iter().all(|e| *e == 0.0), "nor is steady motion");
        assert!(speed_maxima(&[], 60.0).is_empty());
    }
}
