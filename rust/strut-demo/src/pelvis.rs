//! Motion of the pelvis above the feet, and the legs between them.

use crate::action::Mechanics;
use crate::feet::FootPose;
use crate::forms::Swing;
use crate::normative::{PELVIS_ROLL, PELVIS_YAW};
use crate::path::Side;
use crate::periodic::PeriodicCurve;
use crate::smoothing::gaussian_smoothed;
use crate::style::Style;
use crate::upper_body::Support;
use std::f32::consts::TAU;
use strut_core::humanoid::{Proportions, Role};
use strut_core::math::float_funcs::{cos, sin};
use strut_core::math::interpolation::smooth_step;
use strut_core::math::{Quat, Vec3};

/// Largest extension of a leg as a share of its length: a knee flexion of about 4°, so that the knee does not lock.
const LONGEST_REACH: f32 = 0.9995;

/// Acceleration of free fall, m/s².
pub(crate) const GRAVITY: f32 = 9.81;
/// Share of free-fall acceleration at the top of a runner's sinusoidal bounce.
const SMOOTH_FLIGHT: f32 = 0.85;

/// Width, in standard deviations of the smoothing, by which the limit is extended in time.
const LIMIT_WIDENING: f32 = 0.88;

/// Softness of the limit of the pelvis' height by the reach of the legs, metres.
const LIMIT_SOFTNESS: f32 = 0.0011;
/// Distance by which the body is lowered half way between two gaits, metres.
const TRANSITION_DIP: f32 = 0.045;
/// Softness of the limit that keeps a swinging leg from straightening fully, metres.
const SWING_SOFTNESS: f32 = 0.016;

/// Smaller of two values with the corner rounded; where they are equal it is half of `softness` below them.
pub(crate) fn soft_min(a: f32, b: f32, softness: f32) -> f32 {
    let excess = a - b;
    a - 0.5 * (excess + (excess * excess + softness * softness).sqrt())
}

/// Curves of the pelvis and of the supporting knee in a style.
#[derive(Clone, Debug)]
pub(crate) struct PelvisCurves {
    pub(crate) yaw: PeriodicCurve,
    pub(crate) roll: PeriodicCurve,
    knee: PeriodicCurve,
}

impl PelvisCurves {
    pub(crate) fn new(style: &Style, mechanics: &Mechanics) -> Self {
        let least = mechanics.stance_knee[0].1;
        let knots: Vec<(f32, f32)> = mechanics
            .stance_knee
            .iter()
            .map(|&(phase, flexion)| {
                let phase = if phase <= mechanics.duty {
                    phase * style.duty / mechanics.duty
                } else {
                    1.0 - (1.0 - phase) * (1.0 - style.duty) / (1.0 - mechanics.duty)
                };
                let wave = if flexion > least { (flexion - least) * style.knee_give } else { flexion - least };
                (phase, least + wave + style.crouch)
            })
            .collect();
        Self {
            yaw: PeriodicCurve::through(PELVIS_YAW, 0.03),
            roll: PeriodicCurve::through(PELVIS_ROLL, 0.025),
            knee: PeriodicCurve::through(&knots, 0.025),
        }
    }
}

/// Heights of the pelvis that follow from the legs at a frame, metres.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Heights {
    /// Height at which the supporting knee has its planned flexion.
    pub(crate) supported: f32,
    /// Greatest height at which both legs reach their feet.
    pub(crate) limit: f32,
}

impl Heights {
    /// Interpolates to other heights, `t` in [0, 1]. The limit does not exceed those of both.
    pub(crate) fn mix(self, o: Self, t: f32) -> Self {
        let supported = self.supported + (o.supported - self.supported) * t - 4.0 * TRANSITION_DIP * t * (1.0 - t);
        let (nearer, share) = if t < 0.5 { (self.limit, t) } else { (o.limit, 1.0 - t) };
        let limit = nearer + (self.limit.min(o.limit) - nearer) * smooth_step(0.0, 0.25, share);
        Self { supported, limit }
    }
}

/// Heights of the pelvis over a motion: the supported height, below the limit, and smooth. The limit is extended in
/// time before the smoothing, so that the smoothed height does not exceed it. `sigma` in frames.
pub(crate) fn smooth_heights(heights: &[Heights], sigma: f32) -> Vec<f32> {
    let radius = (LIMIT_WIDENING * sigma) as usize;
    let limited: Vec<f32> = heights
        .iter()
        .enumerate()
        .map(|(i, h)| {
            let around = &heights[i.saturating_sub(radius)..(i + radius + 1).min(heights.len())];
            let limit = around.iter().map(|h| h.limit).fold(f32::INFINITY, f32::min);
            soft_min(h.supported, limit, LIMIT_SOFTNESS)
        })
        .collect();
    let last = limited.len() as isize - 1;
    gaussian_smoothed(limited.len(), sigma, |i| limited[i.clamp(0, last) as usize])
}

/// Legs of a body: lengths, and positions of the hips in the pelvis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Legs {
    standing: f32,
    thigh: f32,
    shin: f32,
    left_hip: Vec3,
    right_hip: Vec3,
}

impl Legs {
    pub(crate) fn of(proportions: &Proportions) -> Self {
        let at = |r: Role| proportions.offsets[r.index()];
        Self {
            standing: at(Role::Hips).y,
            thigh: at(Role::LeftLowerLeg).length(),
            shin: at(Role::LeftFoot).length(),
            left_hip: at(Role::LeftUpperLeg),
            right_hip: at(Role::RightUpperLeg),
        }
    }

    pub(crate) fn hip(&self, side: Side) -> Vec3 {
        match side {
            Side::Left => self.left_hip,
            Side::Right => self.right_hip,
        }
    }

    /// Distance from hip to ankle at a knee flexion in degrees (law of cosines).
    fn reach(&self, knee_degrees: f32) -> f32 {
        let c = cos(knee_degrees.to_radians());
        (self.thigh * self.thigh + self.shin * self.shin + 2.0 * self.thigh * self.shin * c).max(0.0).sqrt()
    }

    /// Height of the pelvis when standing with bent knees.
    pub(crate) fn standing_with(&self, knee_degrees: f32) -> f32 {
        self.standing - (self.thigh + self.shin - self.reach(knee_degrees))
    }

    /// Greatest height of the pelvis, at this horizontal position, at which the leg reaches its ankle.
    pub(crate) fn highest(&self, side: Side, pelvis: Vec3, rotation: Quat, ankle: Vec3) -> f32 {
        self.pelvis_height(side, pelvis, rotation, ankle, self.longest())
    }

    /// Ankle of a leg that is swung from the pelvis.
    pub(crate) fn swung(&self, side: Side, root: Vec3, pelvis: Quat, swing: Swing) -> Vec3 {
        let bone = |degrees: f32| Vec3::new(0.0, -cos(degrees.to_radians()), sin(degrees.to_radians()));
        let leg = bone(swing.hip) * self.thigh + bone(swing.hip - swing.knee) * self.shin;
        root + pelvis * self.hip(side) + Quat::from_rotation_z(side.sign() * swing.out.to_radians()) * leg
    }

    fn longest(&self) -> f32 {
        LONGEST_REACH * (self.thigh + self.shin)
    }

    /// Height of the pelvis at which the distance from hip to ankle is `reach`. If the horizontal distance to the ankle
    /// is greater, it is the height of the ankle.
    fn pelvis_height(&self, side: Side, pelvis: Vec3, rotation: Quat, ankle: Vec3, reach: f32) -> f32 {
        let hip = rotation * self.hip(side);
        let (dx, dz) = (pelvis.x + hip.x - ankle.x, pelvis.z + hip.z - ankle.z);
        ankle.y + (reach * reach - dx * dx - dz * dz).max(0.0).sqrt() - hip.y
    }

    /// Heights of the pelvis: the one that gives the supporting leg its knee flexion, and the greatest one at which
    /// both legs reach their feet. While both feet are planted the weight shifts from one leg to the other; a runner
    /// instead bounces between flight and the bent knee of mid stance. `pelvis` is the horizontal position.
    pub(crate) fn heights(
        &self,
        curves: &PelvisCurves,
        style: &Style,
        support: &Support,
        pelvis: Vec3,
        feet: &[FootPose; 2],
    ) -> Heights {
        let runs = style.duty < 0.5;
        let dip = style.bounce * (1.0 + cos(2.0 * TAU * (support.phase - 0.06)));
        let mut heights = Heights { supported: -dip, limit: f32::INFINITY };
        if runs {
            heights.supported += self.running_height(curves, style, support);
        }
        for (side, foot) in Side::BOTH.into_iter().zip(feet) {
            let height = |reach| self.pelvis_height(side, pelvis, support.pelvis, foot.ankle, reach);
            let mut limit = height(self.longest());
            if !runs {
                let weight = smooth_step(0.0, style.duty - 0.5, foot.cycle) - smooth_step(0.5, style.duty, foot.cycle);
                heights.supported += weight * height(self.reach(curves.knee.at(foot.cycle)));
                // A free foot can deviate, and the height of the supporting leg is already included: only a leg near
                // touch-down or lift-off may need a lower height.
                limit += 0.05 * (2.0 * foot.freedom * foot.freedom + weight * weight * weight * weight);
            }
            heights.limit = heights.limit.min(limit);
        }
        heights
    }

    /// Height of a runner's pelvis. It is lowest in mid stance, where the bent knee determines it. The acceleration at
    /// the top of the bounce is a share of gravity, [`SMOOTH_FLIGHT`].
    fn running_height(&self, curves: &PelvisCurves, style: &Style, support: &Support) -> f32 {
        let mid_stance = 0.5 * style.duty;
        let lowest = self.standing_with(curves.knee.at(mid_stance));
        let steps_per_sec = style.cadence / 60.0 * support.stretch;
        let rate = TAU * steps_per_sec;
        let half_range = SMOOTH_FLIGHT * GRAVITY / (rate * rate);
        lowest + half_range * (1.0 - cos(2.0 * TAU * (support.phase - mid_stance)))
    }

    /// World rotations of thigh and shin that lead from `hip` to the foot's ankle with the knee in the direction of
    /// `pole`. A swinging foot deviates where the leg would have to straighten fully.
    pub(crate) fn solve(&self, hip: Vec3, foot: &FootPose, pole: Vec3) -> [Quat; 2] {
        let full = self.thigh + self.shin;
        let line = foot.ankle - hip;
        let wanted = line.length();
        let given_way = soft_min(wanted, self.longest(), SWING_SOFTNESS);
        let distance = (wanted + foot.freedom * (given_way - wanted)).clamp(0.2 * full, 0.9995 * full);
        let down = line.normalize_or(Vec3::NEG_Y);
        let forward = (pole - down * pole.dot(down)).normalize_or(Vec3::Z);
        let axis = forward.cross(down);
        let along = (self.thigh * self.thigh + distance * distance - self.shin * self.shin) / (2.0 * distance);
        let off = (self.thigh * self.thigh - along * along).max(0.0).sqrt();
        let knee = down * along + forward * off;
        [knee, down * distance - knee].map(|bone| {
            let up = -bone.normalize_or(Vec3::NEG_Y);
            Quat::from_basis(axis, up, axis.cross(up))
        })
    }
}
