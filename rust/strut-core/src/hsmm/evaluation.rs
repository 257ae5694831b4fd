//! How well a model says what it has not seen (specification, §12).

use super::features::{Track, observations, row_of};
use super::model::{DIMS, Row, WalkModel};
use super::refinement::{chains, generate};
use super::steps::steps_of;
use super::training::{Sample, Shared, states_of};
use super::walker::{WalkVoices, Walker, WeightsError};
use crate::humanoid::{JOINTS, Pose, Role};
use crate::kinematics::world_from_local;
use crate::math::float_funcs::atan2;
use crate::math::{Quat, Vec3, exp_map};
use std::sync::Arc;

/// Frames of recorded walks beside the model's, whose states last as long as is likeliest for the recording.
#[derive(Clone, Debug, Default)]
pub struct Reconstruction {
    /// Frames compared.
    pub frames: f64,
    /// Mean angle between rotations of the joints, degrees, summed over frames.
    degrees: f64,
    /// Mean distance of the joints with the hips at the origin, centimetres, summed over frames.
    centimetres: f64,
    /// Standard deviations of the degrees of freedom, summed over these and weighed by frames: generated and recorded.
    deviations: [f64; 2],
    /// Distances of the ankles at the strikes, metres, summed over them: generated and recorded.
    stretches: [f64; 2],
}

impl Reconstruction {
    /// Adds a clip by a style of the model.
    pub fn add(&mut self, model: &WalkModel, style: usize, track: &Track) {
        let (shared, sample) = (shared_of(model), sample_of(model, style, track));
        for chain in chains(&sample, &model.means[style], &shared) {
            let generated = generate(&chain.states, &model.means[style], &shared);
            let recorded = &sample.rows[chain.begin..][..generated.len()];
            self.frames += generated.len() as f64;
            let is_strike = |i: usize| chain.states.get(i + 1).is_none_or(|next| next.0 != chain.states[i].0);
            for (i, (a, b)) in generated.iter().zip(recorded).enumerate() {
                let [a, b] = [a, b].map(|row| rotations_of(model, row));
                let angles = a.iter().zip(&b).map(|(a, b)| a.inv_mul(*b).angle().to_degrees());
                self.degrees += f64::from(angles.sum::<f32>()) / JOINTS as f64;
                let [a, b] = [a, b].map(|rotations| {
                    world_from_local(&model.proportions, &Pose { root: Vec3::ZERO, rotations }).positions
                });
                if is_strike(i) {
                    for (sum, positions) in self.stretches.iter_mut().zip([&a, &b]) {
                        *sum += f64::from(
                            (positions[Role::LeftFoot.index()] - positions[Role::RightFoot.index()]).length(),
                        );
                    }
                }
                let distances = a.iter().zip(&b).map(|(a, b)| 100.0 * (*a - *b).length());
                self.centimetres += f64::from(distances.sum::<f32>()) / JOINTS as f64;
            }
            for (sum, rows) in self.deviations.iter_mut().zip([&generated[..], recorded]) {
                *sum += rows.len() as f64 * (0..DIMS).map(|d| deviation(rows, d)).sum::<f64>();
            }
        }
    }

    /// Mean error of rotations, degrees.
    pub fn degrees(&self) -> f64 {
        self.degrees / self.frames
    }

    /// Mean error of positions, centimetres.
    pub fn centimetres(&self) -> f64 {
        self.centimetres / self.frames
    }

    /// How far apart the feet are when one strikes, as a share of how far recorded ones are.
    pub fn step_length(&self) -> f64 {
        self.stretches[0] / self.stretches[1]
    }

    /// How much generated joints move, as a share of how much recorded ones do.
    pub fn amplitude(&self) -> f64 {
        self.deviations[0] / self.deviations[1]
    }
}

/// How a walk measures up, averaged over its steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Manner {
    /// Of a step, seconds.
    pub step_secs: f64,
    /// Metres.
    pub step_length: f64,
    /// Metres per second.
    pub speed: f64,
    /// Of the chest, forward from upright, degrees.
    pub lean: f64,
    /// Of the head, down from level, degrees.
    pub head_pitch: f64,
}

impl Manner {
    /// Its numbers, with their names.
    pub fn named(&self) -> [(&'static str, f64); 5] {
        [
            ("step duration", self.step_secs),
            ("step length", self.step_length),
            ("speed", self.speed),
            ("torso lean", self.lean),
            ("head pitch", self.head_pitch),
        ]
    }

    /// Of so many steps in a style.
    ///
    /// # Errors
    /// See [`WeightsError`].
    pub fn of(model: &WalkModel, voices: &Arc<WalkVoices>, weights: &[f32], steps: u64) -> Result<Self, WeightsError> {
        let mut walker = Walker::new(Arc::clone(voices));
        walker.set_styles(weights)?;
        walker.reset(Vec3::ZERO, 0.0);
        let mut poses: Vec<Pose> = Vec::new();
        // The first two belong to the beginning.
        while walker.next_step() < steps + 2 {
            let pose = *walker.advance();
            if walker.step().0 >= 2 {
                poses.push(pose);
            }
        }
        let frames = poses.len() as f64;
        let (first, last) = (poses[0].root, poses[poses.len() - 1].root);
        let way = f64::from((last - first).length()) * frames / (frames - 1.0);
        let secs = frames / f64::from(super::RATE_HZ);
        let pitch = |role: Role, axis: Vec3, level: fn(Vec3) -> f32| {
            let of = |pose: &Pose| level(world_from_local(&model.proportions, pose).rotations[role.index()] * axis);
            f64::from(poses.iter().map(of).sum::<f32>().to_degrees()) / frames
        };
        Ok(Self {
            step_secs: secs / steps as f64,
            step_length: way / steps as f64,
            speed: way / secs,
            lean: pitch(Role::Chest, Vec3::Y, |up| atan2(up.z, up.y)),
            head_pitch: pitch(Role::Head, Vec3::Z, |ahead| atan2(-ahead.y, ahead.z)),
        })
    }
}

/// Greatest acceleration of any joint while a style gives way to another over so many steps in between, as a share of the
/// greatest of that joint while either is walked.
///
/// # Errors
/// See [`WeightsError`].
pub fn transition_peak(
    model: &WalkModel,
    voices: &Arc<WalkVoices>,
    [from, to]: [&[f32]; 2],
    between: u32,
) -> Result<f64, WeightsError> {
    /// Steps of either style that are watched, after as many that are not.
    const STEPS: u64 = 8;
    let mut walker = Walker::new(Arc::clone(voices));
    walker.set_styles(from)?;
    walker.reset(Vec3::ZERO, 0.0);
    let begin = 2 * STEPS;
    let end = begin + u64::from(between) + 1;
    walker.plan_transition(begin, between, to)?;
    let (mut rows, mut numbers) = (Vec::new(), Vec::new());
    while walker.next_step() < end + 2 * STEPS {
        rows.push(row_of(&model.reference, &walker.advance().rotations));
        numbers.push(walker.step().0);
    }
    let peak = |d: usize, steps: std::ops::Range<u64>| {
        let inner = (1..rows.len() - 1).filter(|&t| steps.contains(&numbers[t]));
        inner.map(|t| (rows[t + 1][d] - 2.0 * rows[t][d] + rows[t - 1][d]).abs()).fold(0.0, f64::max)
    };
    let share = |d: usize| {
        let steady = peak(d, STEPS..begin - 1).max(peak(d, end + STEPS..end + 2 * STEPS));
        peak(d, begin - 1..end + 1) / steady.max(f64::MIN_POSITIVE)
    };
    Ok((0..DIMS).map(share).fold(0.0, f64::max))
}

/// For every step of a clip the style that it is likeliest by; steps that no style can be compared with are left out.
pub fn recognise(model: &WalkModel, track: &Track) -> Vec<usize> {
    let (shared, sample) = (shared_of(model), sample_of(model, 0, track));
    let styles: Vec<_> = model.means.iter().map(|means| states_of(means, &shared)).collect();
    let of_step = |step: &super::Step| {
        let observations = &sample.observations[step.frames.clone()];
        let likelihood = |style: usize| Some((styles[style][step.side as usize].align(observations)?.1, style));
        (0..styles.len()).filter_map(likelihood).max_by(|a, b| a.0.total_cmp(&b.0)).map(|best| best.1)
    };
    sample.steps.iter().filter_map(of_step).collect()
}

fn shared_of(model: &WalkModel) -> Shared {
    Shared { variances: model.variances.clone(), duration_variances: model.duration_variances }
}

fn sample_of(model: &WalkModel, style: usize, track: &Track) -> Sample {
    let rows = track.rows(&model.reference);
    Sample { style, observations: observations(&rows), rows, steps: steps_of(track) }
}

fn rotations_of(model: &WalkModel, row: &Row) -> [Quat; JOINTS] {
    let vector = |j: usize| Vec3::new(row[3 * j] as f32, row[3 * j + 1] as f32, row[3 * j + 2] as f32);
    std::array::from_fn(|j| model.reference[j] * exp_map::exp(vector(j)))
}

fn deviation(rows: &[Row], d: usize) -> f64 {
    let mean = rows.iter().map(|row| row[d]).sum::<f64>() / rows.len() as f64;
    (rows.iter().map(|row| (row[d] - mean) * (row[d] - mean)).sum::<f64>() / rows.len() as f64).sqrt()
}
