//! The runtime form of a walk model: synthesis parameters in single precision, padded to whole SIMD lanes.

use super::durations::{Durations, limited, shortest_and_longest, stretched};
use crate::hsmm::model::{Observation, SIDES, STATES, Side, Stream, StyleMeans, WalkModel};
use crate::hsmm::statistics::states;
use crate::humanoid::{JOINTS, Pose, Proportions, Role};
use crate::kinematics::rotation_row::{ROTATION_DIMS, RotationRow};
use crate::kinematics::world_from_local;
use crate::math::lanes::WIDTH;
use crate::math::{Quat, Vec3};
use std::ops::RangeInclusive;

/// Distance of the ankles behind the mean of the joints in a standing pose, metres.
const ANKLE_BEHIND: f32 = 0.03;

/// Least variance of a velocity or an acceleration, as a share of the greatest variance of its pose: below it the system of
/// trajectory generation is singular in single precision. Trained models stay above 3e-4.
const LEAST_DELTA_SHARE: f64 = 1e-5;

/// Joints of each leg.
const LEGS: [RangeInclusive<usize>; SIDES] =
    [Role::LeftUpperLeg as usize..=Role::LeftToes as usize, Role::RightUpperLeg as usize..=Role::RightToes as usize];

pub(super) const PADDED: usize = ROTATION_DIMS.next_multiple_of(WIDTH);

/// A row padded to whole lanes.
pub(super) type Padded = [f32; PADDED];
/// Means of a state: pose, velocity and acceleration per frame.
pub(super) type StateMeans = [Padded; 3];

/// A style's precomputed synthesis parameters.
#[derive(Clone, Debug)]
pub(super) struct RuntimeStyle {
    pub(super) means: [[StateMeans; STATES]; SIDES],
    pub(super) durations: [Durations; SIDES],
    /// Length of a step, metres.
    pub(super) step_length: f32,
    step_length_bends: [f32; 2],
    /// The pose that walking swings about and stops in: each leg as it passes below the body, everything else midway between
    /// the two.
    pub(super) standing: Padded,
}

impl RuntimeStyle {
    fn new(model: &WalkModel, means: &StyleMeans) -> Self {
        let below: [RotationRow; SIDES] = std::array::from_fn(|leg| below_the_body(model, means, leg));
        let standing = |d: usize| match LEGS.iter().position(|leg| leg.contains(&(d / 3))) {
            Some(leg) => below[leg][d],
            None => 0.5 * (below[0][d] + below[1][d]),
        };
        Self {
            means: means.means.each_ref().map(|side| side.each_ref().map(padded)),
            durations: means.durations.map(|side| side.map(|d| d as f32)),
            step_length: means.step_length as f32,
            step_length_bends: means.step_length_bends.map(|bend| bend as f32),
            standing: std::array::from_fn(|d| if d < ROTATION_DIMS { standing(d) as f32 } else { 0.0 }),
        }
    }

    /// Correction of the step length that is proportional to the style's weight, metres: 0 for weights from 0 to 1.
    pub(super) fn bend(&self, weight: f32) -> f32 {
        let beyond = weight - weight.clamp(0.0, 1.0);
        beyond * self.step_length_bends[usize::from(beyond > 0.0)]
    }
}

/// The runtime form of a [`WalkModel`]; walkers share it.
#[derive(Debug)]
pub struct RuntimeWalkModel {
    pub(super) proportions: Proportions,
    pub(super) reference: [Quat; JOINTS],
    pub(super) inverse_variances: [[StateMeans; STATES]; SIDES],
    pub(super) duration_variances: [Durations; SIDES],
    /// Frames of the shortest and of the longest style's step.
    pub(super) step_frames: [[f32; 2]; SIDES],
    pub(super) range: Vec<[f32; 2]>,
    /// Whether the step lengths of all styles are known.
    pub(super) has_step_lengths: bool,
    pub(super) average: RuntimeStyle,
    pub(super) styles: Vec<RuntimeStyle>,
}

impl RuntimeWalkModel {
    /// Converts a model.
    pub fn new(model: &WalkModel) -> Self {
        let least: RotationRow = std::array::from_fn(|d| least_delta_variance(model, d));
        let inverse = |of: &Observation| {
            let [poses, deltas @ ..] = *of;
            let [velocities, accelerations] = deltas.map(|row| std::array::from_fn(|d| f64::max(row[d], least[d])));
            // Padding, and degrees of freedom without variance, get weight 1.
            padded(&[poses, velocities, accelerations]).map(|row| row.map(|v| if v > 0.0 { 1.0 / v } else { 1.0 }))
        };
        let [low, high] = &model.range;
        let styles: Vec<RuntimeStyle> = model.means.iter().map(|means| RuntimeStyle::new(model, means)).collect();
        Self {
            proportions: model.proportions,
            reference: model.reference,
            inverse_variances: model.variances.each_ref().map(|side| side.each_ref().map(inverse)),
            duration_variances: model.duration_variances.map(|side| side.map(|v| v as f32)),
            range: low.iter().zip(high).map(|(l, h)| [*l as f32, *h as f32]).collect(),
            has_step_lengths: model.means.iter().all(|means| means.step_length > 0.0),
            average: RuntimeStyle::new(model, &model.average()),
            step_frames: std::array::from_fn(|side| shortest_and_longest(styles.iter().map(|v| &v.durations[side]))),
            styles,
        }
    }

    /// Bone offsets of the walker.
    pub fn proportions(&self) -> &Proportions {
        &self.proportions
    }

    /// Number of styles.
    pub fn styles(&self) -> usize {
        self.styles.len()
    }

    /// Returns the durations of the states of a foot's step in a mixture of styles, frames, without a set cadence. There is
    /// one weight per style; the remainder to a sum of 1 belongs to the average.
    pub fn durations(&self, weights: &[f32], side: Side) -> [f32; STATES] {
        let mixed = self.mixed(|style| weights.get(style).copied().unwrap_or(0.0));
        self.durations_of(mixed, side as usize, true)
    }

    /// [`RuntimeWalkModel::durations`] changed by `rho` times their variances, within the range of a state's duration.
    pub(in crate::hsmm) fn stretched_durations(&self, weights: &[f32], side: Side, rho: f32) -> [f32; STATES] {
        stretched(&self.durations(weights, side), rho, &self.duration_variances[side as usize])
    }

    /// All styles whose weight is not 0, with their weights; the average last.
    pub(super) fn mixed(
        &self,
        weight: impl Fn(usize) -> f32 + Clone,
    ) -> impl Iterator<Item = (f32, &RuntimeStyle)> + Clone {
        let styles = self.styles.iter().enumerate().map(move |(style, runtime_style)| (weight(style), runtime_style));
        let rest = 1.0 - styles.clone().map(|(weight, _)| weight).sum::<f32>();
        styles.chain([(rest, &self.average)]).filter(|(weight, _)| *weight != 0.0)
    }

    /// Durations of a mixture, limited or not.
    pub(super) fn durations_of<'a>(
        &self,
        mixed: impl Iterator<Item = (f32, &'a RuntimeStyle)> + Clone,
        side: usize,
        limits: bool,
    ) -> Durations {
        let mut durations = [0.0; STATES];
        for (weight, runtime_style) in mixed.clone() {
            durations.iter_mut().zip(runtime_style.durations[side]).for_each(|(sum, d)| *sum += weight * d);
        }
        if !limits {
            return durations;
        }
        let styles = mixed.map(|(_, runtime_style)| &runtime_style.durations[side]);
        limited(&durations, styles, self.step_frames[side], &self.duration_variances[side])
    }
}

/// Least variance of a degree of freedom's velocities and accelerations ([`LEAST_DELTA_SHARE`]).
pub(in crate::hsmm) fn least_delta_variance(model: &WalkModel, d: usize) -> f64 {
    let poses = states().map(|(side, state)| model.variances[side][state][Stream::Static as usize][d]);
    LEAST_DELTA_SHARE * poses.fold(0.0, f64::max)
}

fn padded(of: &Observation) -> StateMeans {
    of.map(|row| std::array::from_fn(|d| row.get(d).map_or(0.0, |v| *v as f32)))
}

/// The pose of a step in which the body is above the supporting leg.
fn below_the_body(model: &WalkModel, means: &StyleMeans, leg: usize) -> RotationRow {
    let states = means.means[1 - leg].each_ref().map(|state| &state[0]);
    let foot = [Role::LeftFoot, Role::RightFoot][leg].index();
    // Distance of the ankle in front of its place in standing, in the pose of each state.
    let ahead = states.map(|row| {
        let pose = Pose { root: Vec3::ZERO, rotations: model.rotations(row) };
        let world = world_from_local(&model.proportions, &pose);
        let centre = world.positions.iter().map(|p| p.z).sum::<f32>() / JOINTS as f32;
        f64::from(world.positions[foot].z - (centre - ANKLE_BEHIND))
    });
    let passes = (1..STATES).find(|&s| ahead[s - 1] > 0.0 && ahead[s] <= 0.0);
    let nearest = (0..STATES).min_by(|a, b| ahead[*a].abs().total_cmp(&ahead[*b].abs())).unwrap_or(0);
    let (before, after) = passes.map_or((nearest, nearest), |s| (s - 1, s));
    let share = if before == after { 0.0 } else { ahead[before] / (ahead[before] - ahead[after]) };
    std::array::from_fn(|d| states[before][d] + share * (states[after][d] - states[before][d]))
}

/// Scales the swing of a state's joints about the standing pose by a share, and that of the legs also by another.
pub(super) fn swing(means: &mut StateMeans, standing: &Padded, share: f32, legs: f32) {
    for d in 0..ROTATION_DIMS {
        let is_leg = LEGS.iter().any(|leg| leg.contains(&(d / 3)));
        let share = if is_leg { share * legs } else { share };
        means[0][d] = standing[d] + share * (means[0][d] - standing[d]);
        means[1][d] *= share;
        means[2][d] *= share;
    }
}
