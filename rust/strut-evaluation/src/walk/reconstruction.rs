//! Reconstruction error of recorded walks, and recognition of their styles.

use super::generate;
use super::shared_of;
use strut_core::hsmm::Step;
use strut_core::hsmm::Track;
use strut_core::hsmm::WalkModel;
use strut_core::hsmm::parts::chains;
use strut_core::hsmm::parts::{Sample, states_of};
use strut_core::hsmm::{ROTATION_DIMS, RotationRow};
use strut_core::humanoid::{JOINTS, Pose, Role};
use strut_core::kinematics::world_from_local;
use strut_core::math::Vec3;

/// Comparison of recorded walks with the model's trajectories, with states aligned to the recording.
#[derive(Clone, Debug, Default)]
pub struct Reconstruction {
    /// Frames compared.
    pub frames: f64,
    /// Mean angle between rotations of the joints, degrees, summed over frames.
    degrees: f64,
    /// Mean distance of the joints with the hips at the origin, centimetres, summed over frames.
    centimetres: f64,
    /// Standard deviations of the degrees of freedom, summed and weighted by frames: generated and recorded.
    deviations: [f64; 2],
    /// Distances between the ankles at the strikes, metres, summed: generated and recorded.
    stretches: [f64; 2],
}

impl Reconstruction {
    /// Adds a clip of a style of the model.
    pub fn add(&mut self, model: &WalkModel, style: usize, track: &Track) {
        let (shared, sample) = (shared_of(model), Sample::new(style, track, &model.reference));
        for chain in chains(&sample, &model.means[style], &shared) {
            let generated = generate(&chain.states, &model.means[style], &shared);
            let recorded = &sample.rows[chain.begin..][..generated.len()];
            self.frames += generated.len() as f64;
            let is_strike = |i: usize| chain.states.get(i + 1).is_none_or(|next| next.0 != chain.states[i].0);
            for (i, (a, b)) in generated.iter().zip(recorded).enumerate() {
                let [a, b] = [a, b].map(|row| model.rotations(row));
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
                *sum += rows.len() as f64 * (0..ROTATION_DIMS).map(|d| deviation(rows, d)).sum::<f64>();
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

    /// Ratio of the generated to the recorded distance between the feet at strikes.
    pub fn step_length(&self) -> f64 {
        self.stretches[0] / self.stretches[1]
    }

    /// Ratio of the generated to the recorded amplitude of the joints.
    pub fn amplitude(&self) -> f64 {
        self.deviations[0] / self.deviations[1]
    }
}

/// Returns the most likely style of every step of a clip; steps that cannot be aligned are skipped.
pub fn recognise(model: &WalkModel, track: &Track) -> Vec<usize> {
    let (shared, sample) = (shared_of(model), Sample::new(0, track, &model.reference));
    let styles: Vec<_> = model.means.iter().map(|means| states_of(means, &shared)).collect();
    let of_step = |step: &Step| {
        let observations = &sample.observations[step.frames.clone()];
        let likelihood = |style: usize| Some((styles[style][step.side as usize].align(observations)?.1, style));
        (0..styles.len()).filter_map(likelihood).max_by(|a, b| a.0.total_cmp(&b.0)).map(|best| best.1)
    };
    sample.steps.iter().filter_map(of_step).collect()
}

fn deviation(rows: &[RotationRow], d: usize) -> f64 {
    let mean = rows.iter().map(|row| row[d]).sum::<f64>() / rows.len() as f64;
    (rows.iter().map(|row| (row[d] - mean) * (row[d] - mean)).sum::<f64>() / rows.len() as f64).sqrt()
}
