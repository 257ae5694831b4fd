//! Measures of a gait: joint angles over the cycle as gait laboratories report them.

use crate::feet::FootGeometry;
use crate::normative::Band;
use crate::path::Side;
use std::f32::consts::PI;
use strut_core::humanoid::{HumanoidMotion, Role};
use strut_core::kinematics::{WorldPose, world_from_local};
use strut_core::math::Vec3;
use strut_core::math::float_funcs::{atan2, wrap_angle};

/// Samples of a cycle, from one strike of a foot to the sample before the next.
pub const CYCLE_SAMPLES: usize = 100;

/// The sagittal angles of a leg over one cycle, degrees: [hip, knee, ankle].
///
/// Hip: the thigh relative to the vertical, flexion positive (Winter 1991, for an upright trunk); knee: flexion; ankle:
/// the sole relative to the shin, 0 at a right angle, dorsiflexion positive.
pub type Cycle = [[f32; CYCLE_SAMPLES]; 3];

/// Half the time over which the direction of walking is measured, about a step, seconds.
const DIRECTION_SECS: f32 = 0.5;
/// Shortest and longest valid stride, seconds.
const STRIDE_SECS: [f32; 2] = [0.5, 1.8];
/// Turn rate above which a stride is not straight, degrees per second.
const STRAIGHT: f32 = 15.0;

const LEGS: [[Role; 4]; 2] = [
    [Role::LeftUpperLeg, Role::LeftLowerLeg, Role::LeftFoot, Role::LeftToes],
    [Role::RightUpperLeg, Role::RightLowerLeg, Role::RightFoot, Role::RightToes],
];

/// Every straight stride of both legs in a recorded or synthesised walk. A foot strikes where its ankle is furthest
/// ahead of the pelvis (Zeni, Richards & Higginson 2008).
pub fn cycles(motion: &HumanoidMotion) -> Vec<Cycle> {
    let worlds: Vec<WorldPose> = motion.poses.iter().map(|p| world_from_local(&motion.proportions, p)).collect();
    let forward = directions(motion);
    let mut cycles = Vec::new();
    for leg in LEGS {
        let ahead = |f: usize| (worlds[f].positions[leg[2].index()] - motion.poses[f].root).dot(forward[f]);
        let strikes = peaks(motion.poses.len(), (0.3 * motion.rate_hz) as usize, ahead);
        let angles: Vec<[f32; 3]> = worlds.iter().zip(&forward).map(|(w, &d)| leg_angles(w, leg, d)).collect();
        for pair in strikes.windows(2) {
            let secs = (pair[1] - pair[0]) as f32 / motion.rate_hz;
            let turned = angle_between(forward[pair[0]], forward[pair[1]]);
            if (STRIDE_SECS[0]..STRIDE_SECS[1]).contains(&secs) && turned < STRAIGHT.to_radians() * secs {
                cycles.push(sampled(&angles, pair[0] as f32, pair[1] as f32));
            }
        }
    }
    cycles
}

/// Every stride of both legs between given heel strikes. `strikes` are fractional frames of the left and the right foot.
pub fn cycles_between(motion: &HumanoidMotion, strikes: &[Vec<f32>; 2]) -> Vec<Cycle> {
    let worlds: Vec<WorldPose> = motion.poses.iter().map(|p| world_from_local(&motion.proportions, p)).collect();
    let forward = directions(motion);
    let mut cycles = Vec::new();
    for (leg, strikes) in LEGS.into_iter().zip(strikes) {
        let angles: Vec<[f32; 3]> = worlds.iter().zip(&forward).map(|(w, &d)| leg_angles(w, leg, d)).collect();
        cycles.extend(strikes.windows(2).map(|pair| sampled(&angles, pair[0], pair[1])));
    }
    cycles
}

/// Fractional frames at which the left and the right foot strike in a performance with these phases.
pub fn strikes(phases: &[f32]) -> [Vec<f32>; 2] {
    Side::BOTH.map(|side| {
        let since = |phase: f32| phase - side.strike_phase();
        let crossed = |w: &[f32]| since(w[0]).floor() < since(w[1]).floor();
        let frame = |i: usize, w: &[f32]| i as f32 + (since(w[1]).floor() - since(w[0])) / (w[1] - w[0]);
        phases.windows(2).enumerate().filter(|(_, w)| crossed(w)).map(|(i, w)| frame(i, w)).collect()
    })
}

/// Mean horizontal speed of the point that carries a planted foot, m/s: heel, ball or tip of the toes, whichever is lowest.
pub fn skate(motion: &HumanoidMotion, planted: &[[bool; 2]]) -> f32 {
    let worlds: Vec<WorldPose> = motion.poses.iter().map(|p| world_from_local(&motion.proportions, p)).collect();
    let geometry = FootGeometry::of(&motion.proportions);
    let (mut travel, mut steps) = (0.0, 0_usize);
    for (side, leg) in LEGS.into_iter().enumerate() {
        let sole = |world: &WorldPose| {
            let point = |role: Role, local| world.positions[role.index()] + world.rotations[role.index()] * local;
            let [heel, ball, tip] = geometry.sole();
            [point(leg[2], heel), point(leg[3], ball), point(leg[3], tip)]
        };
        for (pair, planted) in worlds.windows(2).zip(planted.windows(2)) {
            if planted[0][side] && planted[1][side] {
                let (before, after) = (sole(&pair[0]), sole(&pair[1]));
                let height = |&i: &usize| before[i].y.max(after[i].y);
                let carrying = (0..3).min_by(|a, b| height(a).total_cmp(&height(b))).unwrap_or(0);
                travel += (after[carrying] - before[carrying]).with_y(0.0).length();
                steps += 1;
            }
        }
    }
    travel * motion.rate_hz / steps.max(1) as f32
}

/// Mean and standard deviation of an angle (0 hip, 1 knee, 2 ankle) at every sample of the cycle.
pub fn mean_and_sd(cycles: &[Cycle], angle: usize) -> Vec<(f32, f32)> {
    let n = cycles.len().max(1) as f32;
    (0..CYCLE_SAMPLES)
        .map(|i| {
            let mean = cycles.iter().map(|c| c[angle][i]).sum::<f32>() / n;
            let variance = cycles.iter().map(|c| (c[angle][i] - mean) * (c[angle][i] - mean)).sum::<f32>() / n;
            (mean, variance.sqrt())
        })
        .collect()
}

/// Share of the cycle over which a mean curve lies within one standard deviation of a band.
pub fn share_within(band: &Band, curve: &[(f32, f32)]) -> f32 {
    let within = curve.iter().enumerate().filter(|(i, (value, _))| {
        let (mean, sd) = band.at(*i as f32 / curve.len() as f32);
        (value - mean).abs() <= sd
    });
    within.count() as f32 / curve.len().max(1) as f32
}

fn leg_angles(world: &WorldPose, leg: [Role; 4], forward: Vec3) -> [f32; 3] {
    let at = |r: Role| world.positions[r.index()];
    let lean = |bone: Vec3| atan2(bone.dot(forward), -bone.y);
    let thigh = lean(at(leg[1]) - at(leg[0]));
    let shin = lean(at(leg[2]) - at(leg[1]));
    let sole = world.rotations[leg[2].index()] * Vec3::Z;
    let pitch = atan2(sole.y, sole.with_y(0.0).length());
    [thigh, wrap_angle(thigh - shin), wrap_angle(pitch - shin)].map(f32::to_degrees)
}

/// Horizontal direction of travel at every frame.
fn directions(motion: &HumanoidMotion) -> Vec<Vec3> {
    let reach = (DIRECTION_SECS * motion.rate_hz) as usize;
    let last = motion.poses.len().saturating_sub(1);
    (0..motion.poses.len())
        .map(|f| {
            let (from, to) = (f.saturating_sub(reach), (f + reach).min(last));
            (motion.poses[to].root - motion.poses[from].root).with_y(0.0).normalize_or(Vec3::Z)
        })
        .collect()
}

/// Frames at which a value is greatest within `reach` frames on either side.
fn peaks(frames: usize, reach: usize, value: impl Fn(usize) -> f32) -> Vec<usize> {
    let around = |f: usize| (f - reach..=f + reach).map(&value).fold(f32::NEG_INFINITY, f32::max);
    (reach..frames.saturating_sub(reach)).filter(|&f| value(f) >= around(f)).collect()
}

fn angle_between(a: Vec3, b: Vec3) -> f32 {
    atan2(a.cross(b).length(), a.dot(b)).clamp(0.0, PI)
}

fn sampled(angles: &[[f32; 3]], from: f32, to: f32) -> Cycle {
    std::array::from_fn(|angle| {
        std::array::from_fn(|i| {
            let x = from + (to - from) * i as f32 / CYCLE_SAMPLES as f32;
            let f = (x as usize).min(angles.len() - 2);
            let (a, b) = (angles[f][angle], angles[f + 1][angle]);
            a + (b - a) * (x - f as f32)
        })
    })
}
