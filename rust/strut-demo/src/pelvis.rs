//! How the pelvis travels and turns above the feet, and the legs between them.

use crate::feet::FootPose;
use crate::normative::{NATURAL_DUTY, PELVIS_ROLL, PELVIS_YAW, STANCE_KNEE};
use crate::path::Side;
use crate::periodic::{PeriodicCurve, smooth_step};
use crate::style::Style;
use strut_core::humanoid::{Proportions, Role};
use strut_core::math::float_funcs::cos;
use strut_core::math::{Quat, Vec3};

/// Largest extension of a leg as a share of its length: a knee flexion of about 8°, so that the knee neither
/// locks nor snaps.
const LONGEST_REACH: f32 = 0.9975;

/// Curves of the pelvis and of the supporting knee in a style.
#[derive(Clone, Debug)]
pub(crate) struct PelvisCurves {
    pub(crate) yaw: PeriodicCurve,
    pub(crate) roll: PeriodicCurve,
    knee: PeriodicCurve,
}

impl PelvisCurves {
    pub(crate) fn new(style: &Style) -> Self {
        let knots: Vec<(f32, f32)> = STANCE_KNEE
            .iter()
            .map(|&(phase, flexion)| {
                let phase = if phase <= NATURAL_DUTY {
                    phase * style.duty / NATURAL_DUTY
                } else {
                    1.0 - (1.0 - phase) * (1.0 - style.duty) / (1.0 - NATURAL_DUTY)
                };
                let least = 6.0;
                let wave = if flexion > least { (flexion - least) * style.knee_give } else { flexion - least };
                (phase, least + wave + style.crouch)
            })
            .collect();
        Self {
            yaw: PeriodicCurve::through(PELVIS_YAW, 0.03),
            roll: PeriodicCurve::through(PELVIS_ROLL, 0.025),
            knee: PeriodicCurve::through(&knots, 0.015),
        }
    }
}

/// The legs of a body: lengths and where the hips are in the pelvis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Legs {
    thigh: f32,
    shin: f32,
    left_hip: Vec3,
    right_hip: Vec3,
}

impl Legs {
    pub(crate) fn of(proportions: &Proportions) -> Self {
        let at = |r: Role| proportions.offsets[r.index()];
        Self {
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

    fn longest(&self) -> f32 {
        LONGEST_REACH * (self.thigh + self.shin)
    }

    /// Height of the pelvis at which the distance from hip to ankle is `reach`; `None` if the ankle is
    /// further away than that on the ground plan.
    fn pelvis_height(&self, side: Side, pelvis: Vec3, rotation: Quat, ankle: Vec3, reach: f32) -> Option<f32> {
        let hip = rotation * self.hip(side);
        let (dx, dz) = (pelvis.x + hip.x - ankle.x, pelvis.z + hip.z - ankle.z);
        let rest = reach * reach - dx * dx - dz * dz;
        (rest > 0.0).then(|| ankle.y + rest.sqrt() - hip.y)
    }

    /// Height of the pelvis that gives the supporting leg its knee flexion; while both feet are planted the
    /// weight passes from one leg to the other. `pelvis` is its position on the ground plan.
    pub(crate) fn supported_height(
        &self,
        curves: &PelvisCurves,
        style: &Style,
        pelvis: Vec3,
        rotation: Quat,
        feet: &[FootPose; 2],
    ) -> f32 {
        let mut sum = 0.0;
        let mut limit = f32::INFINITY;
        for (side, foot) in Side::BOTH.into_iter().zip(feet) {
            let double_support = style.duty - 0.5;
            let weight = smooth_step(0.0, double_support, foot.cycle) - smooth_step(0.5, style.duty, foot.cycle);
            let reach = self.reach(curves.knee.at(foot.cycle)).min(self.longest());
            sum += weight * self.pelvis_height(side, pelvis, rotation, foot.ankle, reach).unwrap_or(0.7);
            if let Some(h) = self.pelvis_height(side, pelvis, rotation, foot.ankle, self.longest()) {
                limit = limit.min(h);
            }
        }
        sum.min(limit)
    }

    /// Rotations of thigh and shin in the world that lead from `hip` to `ankle` with the knee in the
    /// direction of `pole`.
    pub(crate) fn solve(&self, hip: Vec3, ankle: Vec3, pole: Vec3) -> [Quat; 2] {
        let full = self.thigh + self.shin;
        let line = ankle - hip;
        let distance = line.length().clamp(0.2 * full, 0.9995 * full);
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
