//! A script performed in a style: puts feet, pelvis, legs and upper body together, frame by frame.

use crate::feet::{Feet, FootPose};
use crate::noise::{Channel, Noise};
use crate::path::{Path, Side, stretch};
use crate::pelvis::{GRAVITY, Heights, Legs, PelvisCurves, smooth_heights};
use crate::script::Script;
use crate::style::Style;
use crate::upper_body::{Gait, Support, Turn, UpperBody};
use std::f32::consts::TAU;
use strut_core::humanoid::{HumanoidMotion, Pose, Proportions, Role};
use strut_core::math::float_funcs::{sin, wrap_angle};
use strut_core::math::{Quat, Vec3};

/// A take in one style.
#[derive(Clone, Debug, PartialEq)]
pub struct Performance {
    /// The motion.
    pub motion: HumanoidMotion,
    /// For each frame the phase of the script in strides, strictly increasing from 0 to below the script's
    /// length. Frames of equal phase are counterparts in all styles.
    pub phase: Vec<f32>,
    /// For each frame whether the left and the right foot is planted.
    pub planted: Vec<[bool; 2]>,
}

/// Performed before the beginning, so that the springs of the arms have settled.
const WARM_UP_STRIDES: f32 = 1.5;
/// Standard deviation in seconds of the smoothing of the pelvis' height.
const HEIGHT_SMOOTHING_SECS: f32 = 0.0243;
/// Phases by which the chest and the head see a turn ahead (Imai et al. 2001, "Interaction of the
/// body, head, and eyes during walking and turning": the head turns before the body).
const CHEST_LEADS: f32 = 0.10;
const HEAD_LEADS: f32 = 0.28;
/// Share of the lean that would balance the centripetal acceleration of a curve.
const LEAN_SHARE: f32 = 0.6;

/// The frame of a performance as far as it does not depend on the height of the pelvis.
struct Plan {
    support: Support,
    pelvis: Vec3,
    feet: [FootPose; 2],
}

/// Performs `script` in `style` at a rate on a body.
///
/// The motion begins in the origin, walking towards +Z, with a heel strike of the left foot, and ends one frame
/// or less before the same pose of the next repetition. The same arguments give the same bits.
pub fn perform(script: &Script, style: &Style, proportions: &Proportions, rate_hz: f32) -> Performance {
    let style = &script.action.style(style);
    let noise = Noise::new(script.seed, script.strides());
    let path = Path::plan(script, style);
    let feet = Feet::new(proportions, script, style, &path, noise);
    let curves = PelvisCurves::new(style, script.action.mechanics());
    let legs = Legs::of(proportions);

    let (phases, begin, end) = phases_of_frames(script, style, noise, rate_hz);
    let plans: Vec<Plan> = phases
        .iter()
        .map(|&phase| {
            let (support, pelvis) = plan_pelvis(script, style, &path, &curves, noise, phase);
            Plan { support, pelvis, feet: Side::BOTH.map(|side| feet.at(side, phase)) }
        })
        .collect();
    let heights: Vec<Heights> =
        plans.iter().map(|p| legs.heights(&curves, style, &p.support, p.pelvis, &p.feet)).collect();
    let heights = smooth_heights(&heights, HEIGHT_SMOOTHING_SECS * rate_hz);

    let gait = Gait::new(style, noise);
    let mut upper_body = UpperBody::new(style);
    let mut poses = Vec::with_capacity(phases.len());
    for (plan, height) in plans.iter().zip(heights) {
        let mut pose = Pose { root: Vec3::new(plan.pelvis.x, height, plan.pelvis.z), ..Pose::default() };
        pose.rotations[Role::Hips.index()] = plan.support.pelvis;
        upper_body.pose(&gait.posture(&plan.support), plan.support.turn, plan.support.pelvis, 1.0 / rate_hz, &mut pose);
        for (side, foot) in Side::BOTH.into_iter().zip(&plan.feet) {
            place_leg(&legs, side, foot, plan.support.turn.yaw, &mut pose);
        }
        poses.push(pose);
    }

    Performance {
        motion: HumanoidMotion { proportions: *proportions, rate_hz, poses: poses[begin..end].to_vec() },
        phase: phases[begin..end].to_vec(),
        planted: plans[begin..end].iter().map(|p| [p.feet[0].planted, p.feet[1].planted]).collect(),
    }
}

/// The phase of every frame, warm-up and end included, and the range of the script itself.
fn phases_of_frames(script: &Script, style: &Style, noise: Noise, rate_hz: f32) -> (Vec<f32>, usize, usize) {
    let dt = 1.0 / rate_hz;
    // Stride times of adults vary by 1 to 2 % (Winter 1991).
    let strides_per_sec = |phase: f32| {
        let irregular = 1.0 + 0.04 * style.irregularity * noise.smooth(Channel::Tempo, phase);
        style.cadence / 120.0 * stretch(script.speed(phase)) * irregular
    };
    let next = |phase: f32, dt: f32| {
        let middle = phase + 0.5 * dt * strides_per_sec(phase);
        phase + dt * strides_per_sec(middle)
    };
    let mut phases = vec![0.0];
    while phases[phases.len() - 1] > -WARM_UP_STRIDES {
        phases.push(next(phases[phases.len() - 1], -dt));
    }
    phases.reverse();
    let begin = phases.len() - 1;
    let length = script.strides() as f32;
    let mut end = phases.len();
    let smoothing_tail = 16;
    while phases.len() < end + smoothing_tail {
        let phase = next(phases[phases.len() - 1], dt);
        phases.push(phase);
        if phase < length {
            end = phases.len();
        }
    }
    (phases, begin, end)
}

/// Rotation of the pelvis and its position on the ground plan.
fn plan_pelvis(
    script: &Script,
    style: &Style,
    path: &Path,
    curves: &PelvisCurves,
    noise: Noise,
    phase: f32,
) -> (Support, Vec3) {
    let heading = path.heading(phase);
    let stretch = stretch(script.speed(phase));
    let tempo = style.cadence / 120.0 * stretch;
    let speed = path.stride_length(phase) * tempo;
    let turn_per_sec = script.turn_rate(phase) * tempo;
    let lean = -LEAN_SHARE * speed * turn_per_sec / GRAVITY;

    let pelvis_yaw = stretch * style.pelvis_yaw.to_radians() * curves.yaw.at(phase);
    let pelvis_roll = stretch * style.pelvis_roll.to_radians() * curves.roll.at(phase);
    let turn = Turn { yaw: heading + pelvis_yaw, pitch: style.pelvis_tilt.to_radians(), roll: pelvis_roll + lean };
    let support = Support {
        phase,
        strides: script.strides(),
        heading,
        chest_lead: 0.6 * (path.heading(phase + CHEST_LEADS) - heading),
        head_lead: 0.8 * (path.heading(phase + HEAD_LEADS) - heading),
        lean,
        stretch,
        turn,
        pelvis: turn.quat(),
    };
    // Over the left foot a quarter stride after its strike; slowest before mid stance, twice a stride.
    let sway =
        style.sway * (sin(TAU * (phase - 0.04)) + 0.25 * style.irregularity * noise.smooth(Channel::Sway, phase));
    let inwards = -lean * 0.9;
    let surge = style.surge * sin(2.0 * TAU * (phase + 0.053));
    let pelvis = path.position(phase) + Quat::from_rotation_y(heading) * Vec3::new(sway + inwards, 0.0, surge);
    (support, pelvis)
}

/// Solves a leg from the pelvis in `pose`, turned by `pelvis_yaw`, to its foot. The knee points between the two.
pub(crate) fn place_leg(legs: &Legs, side: Side, foot: &FootPose, pelvis_yaw: f32, pose: &mut Pose) {
    let pelvis = pose.rotations[Role::Hips.index()];
    let hip = pose.root + pelvis * legs.hip(side);
    let knee_heading = foot.heading + 0.35 * wrap_angle(pelvis_yaw - foot.heading);
    let ahead = Quat::from_rotation_y(knee_heading) * Vec3::Z;
    let line = foot.ankle - hip;
    // Square to the leg, so that the knee of a raised one points up.
    let pole = Vec3::Y * line.dot(ahead) - ahead * line.y;
    let [thigh, shin] = legs.solve(hip, foot, pole);
    let roles = match side {
        Side::Left => [Role::LeftUpperLeg, Role::LeftLowerLeg, Role::LeftFoot, Role::LeftToes],
        Side::Right => [Role::RightUpperLeg, Role::RightLowerLeg, Role::RightFoot, Role::RightToes],
    };
    let rotations = [pelvis.inv_mul(thigh), thigh.inv_mul(shin), shin.inv_mul(foot.foot), foot.toes];
    for (role, q) in roles.into_iter().zip(rotations) {
        pose.rotations[role.index()] = q;
    }
}
