//! Performs a script in a style: combines feet, pelvis, legs and upper body, frame by frame.

use crate::action::Action;
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
use strut_core::math::interpolation::smooth_step;
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

/// Strides performed before the start, so that the springs of the arms settle.
const WARM_UP_STRIDES: f32 = 1.5;
/// Standard deviation of the smoothing of the pelvis' height, seconds.
const HEIGHT_SMOOTHING_SECS: f32 = 0.0243;
/// Phases by which the chest and the head anticipate a turn (Imai et al. 2001, "Interaction of the body, head, and eyes
/// during walking and turning": the head turns before the body).
const CHEST_LEADS: f32 = 0.10;
const HEAD_LEADS: f32 = 0.28;
/// Share of the lean that would balance the centripetal acceleration of a curve.
const LEAN_SHARE: f32 = 0.6;

/// The part of a performance's frame that does not depend on the height of the pelvis.
struct Plan {
    support: Support,
    pelvis: Vec3,
    feet: [FootPose; 2],
}

/// Performs `script` in `style` at a frame rate on a body.
///
/// The motion starts at the origin, walking towards +Z, with a heel strike of the left foot. It ends at most one frame
/// before the same pose of the next repetition. The same arguments give the same bits.
pub fn perform(script: &Script, style: &Style, proportions: &Proportions, rate_hz: f32) -> Performance {
    perform_gaits(script, [script.action; 2], style, |_| 0.0, proportions, rate_hz)
}

/// A script that starts with one action and changes to another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transition {
    /// Script, with the initial action.
    pub script: Script,
    /// Final action.
    pub to: Action,
    /// Phases between which the action changes.
    pub over: [f32; 2],
}

/// Performs a transition as [`perform`] does a script. The plans of both actions are blended, not their poses: feet
/// stay planted in place, and each stance has its own share of either action.
pub fn perform_transition(transition: &Transition, style: &Style, body: &Proportions, rate_hz: f32) -> Performance {
    let Transition { script, to, over: [begin, end] } = transition;
    perform_gaits(script, [script.action, *to], style, |phase| smooth_step(*begin, *end, phase), body, rate_hz)
}

/// A script that changes to another action and returns, so that it can be looped.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Excursion {
    /// Script, with the initial and final action.
    pub script: Script,
    /// The action in between.
    pub to: Action,
    /// Phases between which the first action changes to the second.
    pub over: [f32; 2],
    /// Phases between which the second changes back to the first.
    pub back: [f32; 2],
}

/// Performs an excursion as [`perform_transition`] does a transition.
pub fn perform_excursion(excursion: &Excursion, style: &Style, body: &Proportions, rate_hz: f32) -> Performance {
    let Excursion { script, to, over, back } = excursion;
    let weight = |phase| smooth_step(over[0], over[1], phase) - smooth_step(back[0], back[1], phase);
    perform_gaits(script, [script.action, *to], style, weight, body, rate_hz)
}

fn perform_gaits(
    script: &Script,
    actions: [Action; 2],
    style: &Style,
    weight: impl Fn(f32) -> f32,
    proportions: &Proportions,
    rate_hz: f32,
) -> Performance {
    let styles = actions.map(|action| action.style(style));
    let gaits = [(actions[0], &styles[0]), (actions[1], &styles[1])];
    let noise = Noise::new(script.seed, script.strides());
    let mixed = |phase: f32, of: fn(&Style) -> f32| {
        let [first, second] = [of(&styles[0]), of(&styles[1])];
        first + (second - first) * weight(phase)
    };
    let path = Path::plan(script, |phase| mixed(phase, |s| s.step_length));
    let feet = Feet::new(proportions, script, gaits, &path, noise, &weight);
    let curves = gaits.map(|(action, style)| PelvisCurves::new(style, action.mechanics()));
    let legs = Legs::of(proportions);

    let (phases, begin, end) = phases_of_frames(script, |phase| mixed(phase, |s| s.cadence), style, noise, rate_hz);
    let plans: Vec<Plan> = phases
        .iter()
        .map(|&phase| {
            let plan = |i: usize| plan_pelvis(script, &styles[i], &path, &curves[i], noise, phase);
            let (mut support, mut pelvis) = plan(0);
            let share = weight(phase);
            if share > 0.0 {
                let (other, place) = plan(1);
                pelvis = pelvis.lerp(place, share);
                support.turn = support.turn.mix(other.turn, share);
                support.pelvis = support.turn.quat();
            }
            Plan { support, pelvis, feet: Side::BOTH.map(|side| feet.at(side, phase)) }
        })
        .collect();
    let heights: Vec<Heights> = plans
        .iter()
        .map(|p| {
            let of = |i: usize| legs.heights(&curves[i], &styles[i], &p.support, p.pelvis, &p.feet);
            let share = weight(p.support.phase);
            if share > 0.0 { of(0).mix(of(1), share) } else { of(0) }
        })
        .collect();
    let heights = smooth_heights(&heights, HEIGHT_SMOOTHING_SECS * rate_hz);

    let upper = gaits.map(|(_, style)| Gait::new(style, noise));
    let mut upper_body = UpperBody::new(&styles[0], 1.0);
    let mut poses = Vec::with_capacity(phases.len());
    for (plan, height) in plans.iter().zip(heights) {
        let support = &plan.support;
        let mut pose = Pose { root: Vec3::new(plan.pelvis.x, height, plan.pelvis.z), ..Pose::default() };
        pose.rotations[Role::Hips.index()] = support.pelvis;
        let mut posture = upper[0].posture(support);
        let share = weight(support.phase);
        if share > 0.0 {
            posture = posture.mix(&upper[1].posture(support), share);
        }
        upper_body.pose(&posture, support.turn, support.pelvis, 1.0 / rate_hz, &mut pose);
        for (side, foot) in Side::BOTH.into_iter().zip(&plan.feet) {
            place_leg(&legs, side, foot, support.turn.yaw, &mut pose);
        }
        poses.push(pose);
    }

    Performance {
        motion: HumanoidMotion { proportions: *proportions, rate_hz, poses: poses[begin..end].to_vec() },
        phase: phases[begin..end].to_vec(),
        planted: plans[begin..end].iter().map(|p| [p.feet[0].planted, p.feet[1].planted]).collect(),
    }
}

/// Phase of every frame, including warm-up and end, and the range of the script itself.
fn phases_of_frames(
    script: &Script,
    cadence: impl Fn(f32) -> f32,
    style: &Style,
    noise: Noise,
    rate_hz: f32,
) -> (Vec<f32>, usize, usize) {
    let dt = 1.0 / rate_hz;
    // Stride times of adults vary by 1 to 2 % (Winter 1991).
    let strides_per_sec = |phase: f32| {
        let irregular = 1.0 + 0.04 * style.irregularity * noise.smooth(Channel::Tempo, phase);
        cadence(phase) / 120.0 * stretch(script.speed(phase)) * irregular
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

/// Rotation and horizontal position of the pelvis.
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
    // The pelvis is over the left foot a quarter stride after its strike, and slowest before mid stance, twice per stride.
    let sway =
        style.sway * (sin(TAU * (phase - 0.04)) + 0.25 * style.irregularity * noise.smooth(Channel::Sway, phase));
    let inwards = -lean * 0.9;
    let surge = style.surge * sin(2.0 * TAU * (phase + 0.053));
    let pelvis = path.position(phase) + Quat::from_rotation_y(heading) * Vec3::new(sway + inwards, 0.0, surge);
    (support, pelvis)
}

/// Solves a leg from the pelvis in `pose`, turned by `pelvis_yaw`, to its foot. The knee points between the two directions.
pub(crate) fn place_leg(legs: &Legs, side: Side, foot: &FootPose, pelvis_yaw: f32, pose: &mut Pose) {
    let pelvis = pose.rotations[Role::Hips.index()];
    let hip = pose.root + pelvis * legs.hip(side);
    let knee_heading = foot.heading + 0.35 * wrap_angle(pelvis_yaw - foot.heading);
    let ahead = Quat::from_rotation_y(knee_heading) * Vec3::Z;
    let line = foot.ankle - hip;
    // Perpendicular to the leg, so that the knee of a raised leg points up.
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
