//! Gaussian processes: Ikemoto, Arikan, Forsyth, "Generalizing Motion Edits with Gaussian Processes", 2009.
//!
//! From kinematic features of the input (pose and velocity, by their principal components) a process predicts the
//! difference between target and input, and the log duration. If each frame is predicted separately, the difference
//! flickers where training frames with similar features differ. Therefore a second process also uses the last
//! difference as input. It is trained on the first process's predictions in place of the true last differences, and so
//! on errors similar to its own, from which it recovers instead of drifting.

use super::gaussian_process::{Basis, Kernel, Process, farthest_points};
use super::pairs::Pairs;
use super::principal::Principal;
use std::sync::Arc;
use strut_core::math::float_funcs::exp;
use strut_core::pose_vector::{DOFS, PoseRow};
use strut_core::transfer::{PredictedFrame, Predictor, PredictorInput};

/// Number of components of pose and velocity.
const COMPONENTS: usize = 20;
/// Number of components of the last difference.
const DIFFERENCE_COMPONENTS: usize = 8;
/// Number of features of the second process.
const WIDTH: usize = COMPONENTS + DIFFERENCE_COMPONENTS;
/// Number of outputs: differences of all degrees of freedom, and the log duration.
const OUTPUTS: usize = DOFS + 1;
/// Variance of the velocity features as a share of the pose features'.
const VELOCITY_SHARE: f64 = 0.2;
/// Variance of the last difference's features as a share of the input's.
const DIFFERENCE_SHARE: f64 = 0.25;
/// Greatest number of training rows: at 60 Hz neighbours in time are nearly equal.
const MAX_ROWS: usize = 6000;
/// Greatest number of inducing points.
const POINTS: usize = 256;
/// ℓ in standard deviations of the features taken together, and σ².
const KERNEL: Kernel = Kernel { length: 1.0, noise: 0.2 };

/// Data shared by the processes of all target styles: features of the input, and the first process's basis.
#[derive(Clone, Debug)]
pub(super) struct Features {
    principal: Principal,
    /// Factor of the velocities before the components are computed.
    velocity_scale: f64,
    /// Factor of the components, by which their total variance becomes 1.
    scale: f64,
    rate_hz: f64,
    /// Training rows; each has two rows before it.
    rows: Vec<usize>,
    /// Their features, [`COMPONENTS`] numbers each.
    inputs: Vec<f64>,
    /// Indices into `rows` of the inducing points.
    points: Vec<usize>,
    basis: Option<Basis>,
}

impl Features {
    /// Features of the inputs of some pairs; they do not depend on the targets.
    pub(super) fn new(pairs: &Pairs<'_>) -> Self {
        let rows = || pairs.segments.iter().flat_map(|s| s.start + 2..s.end);
        let rows: Vec<usize> = rows().step_by(rows().count().div_ceil(MAX_ROWS).max(1)).collect();
        let rate_hz = f64::from(pairs.catalogue.rate_hz);
        let mut features = Self {
            principal: Principal::new(&[], 2 * DOFS, 0),
            velocity_scale: 1.0,
            scale: 1.0,
            rate_hz,
            rows,
            inputs: Vec::new(),
            points: Vec::new(),
            basis: None,
        };
        let pose = &pairs.inputs;
        let mut kinematics: Vec<f64> =
            features.rows.iter().flat_map(|&t| features.kinematics(&pose[t], &pose[t - 1])).collect();
        let [of_pose, of_velocity] = variances(&kinematics);
        if of_velocity > 0.0 {
            features.velocity_scale = (VELOCITY_SHARE * of_pose / of_velocity).sqrt();
        }
        for frame in kinematics.chunks_exact_mut(2 * DOFS) {
            frame[DOFS..].iter_mut().for_each(|v| *v *= features.velocity_scale);
        }
        features.principal = Principal::new(&kinematics, 2 * DOFS, COMPONENTS);
        let variance: f64 = features.principal.variance().iter().sum();
        if variance > 0.0 {
            features.scale = 1.0 / variance.sqrt();
        }
        features.inputs = features.rows.iter().flat_map(|&t| features.of(&pose[t], &pose[t - 1])).collect();
        features.points = farthest_points(&features.inputs, COMPONENTS, POINTS);
        let points = features.points.iter().flat_map(|&i| features.input(i).iter().copied()).collect();
        features.basis = Basis::new(KERNEL, COMPONENTS, &features.inputs, points);
        features
    }

    /// Pose and scaled velocity.
    fn kinematics(&self, input: &PoseRow, previous: &PoseRow) -> [f64; 2 * DOFS] {
        std::array::from_fn(|i| {
            if i < DOFS {
                f64::from(input[i])
            } else {
                let d = i - DOFS;
                self.velocity_scale * self.rate_hz * (f64::from(input[d]) - f64::from(previous[d]))
            }
        })
    }

    /// Features of xₜ and xₜ₋₁.
    fn of(&self, input: &PoseRow, previous: &PoseRow) -> [f64; COMPONENTS] {
        let mut out = [0.0; COMPONENTS];
        self.principal.project(&self.kinematics(input, previous), &mut out);
        out.map(|v| self.scale * v)
    }

    /// Features of a training row.
    fn input(&self, index: usize) -> &[f64] {
        &self.inputs[index * COMPONENTS..(index + 1) * COMPONENTS]
    }
}

/// Total variance of the poses and of the velocities.
fn variances(kinematics: &[f64]) -> [f64; 2] {
    let n = (kinematics.len() / (2 * DOFS)).max(1) as f64;
    let mut mean = [0.0; 2 * DOFS];
    for frame in kinematics.chunks_exact(2 * DOFS) {
        mean.iter_mut().zip(frame).for_each(|(m, v)| *m += v / n);
    }
    let mut variance = [0.0; 2];
    for frame in kinematics.chunks_exact(2 * DOFS) {
        for (i, (v, m)) in frame.iter().zip(&mean).enumerate() {
            variance[i / DOFS] += (v - m) * (v - m) / n;
        }
    }
    variance
}

/// Gaussian processes of one target style.
#[derive(Clone, Debug)]
pub(super) struct Gp {
    features: Arc<Features>,
    /// Components of the differences y − x.
    differences: Principal,
    /// Factor of those components in the second process's input.
    difference_scale: f64,
    /// Second process; `None` without training rows.
    process: Option<Process>,
    /// Means of the outputs, to which the prediction returns far from the training rows.
    mean: [f64; OUTPUTS],
    frame_secs: f32,
}

impl Gp {
    /// Trains both processes on some pairs, whose features are given.
    pub(super) fn train(pairs: &Pairs<'_>, features: &Arc<Features>) -> Self {
        let difference = |t: usize| difference(&pairs.targets[t], &pairs.inputs[t]);
        let data: Vec<f64> = features.rows.iter().flat_map(|&t| difference(t)).collect();
        let mut outputs: Vec<Vec<f64>> =
            (0..DOFS).map(|d| data.chunks_exact(DOFS).map(|frame| frame[d]).collect()).collect();
        outputs.push(features.rows.iter().map(|&t| pairs.log_duration(t)).collect());
        let mut mean = [0.0; OUTPUTS];
        for (mean, output) in mean.iter_mut().zip(&mut outputs) {
            *mean = output.iter().sum::<f64>() / output.len().max(1) as f64;
            for v in output.iter_mut() {
                *v -= *mean;
            }
        }
        let differences = Principal::new(&data, DOFS, DIFFERENCE_COMPONENTS);
        let variance: f64 = differences.variance().iter().sum();
        let difference_scale = if variance > 0.0 { (DIFFERENCE_SHARE / variance).sqrt() } else { 0.0 };
        let mut gp = Self {
            features: Arc::clone(features),
            differences,
            difference_scale,
            process: None,
            mean,
            frame_secs: 1.0 / pairs.catalogue.rate_hz,
        };
        gp.process = features.basis.as_ref().and_then(|basis| {
            let first = basis.fit(&outputs);
            let pose = &pairs.inputs;
            let last_difference = |t: usize| {
                let mut predicted = [0.0; OUTPUTS];
                first.mean(&features.of(&pose[t - 1], &pose[t - 2]), &mut predicted);
                std::array::from_fn(|d| gp.mean[d] + predicted[d])
            };
            let rows = features.rows.iter().copied().enumerate();
            let inputs: Vec<f64> = rows.flat_map(|(i, t)| gp.input(features.input(i), &last_difference(t))).collect();
            let points = features.points.iter().flat_map(|&i| inputs[i * WIDTH..(i + 1) * WIDTH].iter().copied());
            Some(Basis::new(KERNEL, WIDTH, &inputs, points.collect())?.fit(&outputs))
        });
        gp
    }

    /// Input of the second process.
    fn input(&self, features: &[f64], last_difference: &[f64; DOFS]) -> [f64; WIDTH] {
        let mut out = [0.0; WIDTH];
        out[..COMPONENTS].copy_from_slice(features);
        self.differences.project(last_difference, &mut out[COMPONENTS..]);
        out[COMPONENTS..].iter_mut().for_each(|v| *v *= self.difference_scale);
        out
    }
}

fn difference(output: &PoseRow, input: &PoseRow) -> [f64; DOFS] {
    std::array::from_fn(|d| f64::from(output[d]) - f64::from(input[d]))
}

impl Predictor for Gp {
    fn memory_len(&self) -> usize {
        0
    }

    fn start(&self, _memory: &mut [f64], _past: &[PoseRow]) {}

    fn predict(&self, _memory: &mut [f64], now: PredictorInput<'_>) -> PredictedFrame {
        let features = self.features.of(now.input, now.previous_input);
        let input = self.input(&features, &difference(now.previous_output, now.previous_input));
        let mut predicted = [0.0; OUTPUTS];
        if let Some(process) = &self.process {
            process.mean(&input, &mut predicted);
        }
        let mut output = *now.input;
        for (o, (mean, p)) in output.iter_mut().zip(self.mean.iter().zip(predicted)).take(DOFS) {
            *o += (mean + p) as f32;
        }
        let log_duration = self.mean[DOFS] + predicted[DOFS];
        PredictedFrame { output, step_secs: self.frame_secs * exp(log_duration as f32) }
    }
}
