//! Training of a model on recordings (`docs/methods/somn.md` §5).

use super::em::EmTrainer;
use super::learning::{Somn, Update};
use super::measure::Measure;
use super::mixture::{
    Component, FIRST_VARIANCE, Gate, MAX_AXES, SETTLING_ROUNDS, Samples, Style, normalise_weights, settle,
};
use super::model::{ClipSpan, KeyStyleModel};
use super::pose_space::{DIMS, PoseSpace};
use super::recording::Recording;
use super::synthesis::greatest;
use crate::incremental::IncrementalJob;
use crate::parallel::{ParallelMap, Sequential};
use std::convert::Infallible;
use thiserror::Error;

/// Passes over all poses.
const PASSES: usize = 20;
/// Rounds of expectation maximisation.
const ROUNDS: usize = 30;
/// Default number of components: frames per component, and the least and the greatest number.
const FRAMES_EACH: usize = 40;
const COMPONENTS: [usize; 2] = [4, 16];
/// Fewest frames per component.
const FEWEST_FRAMES_EACH: usize = 12;
/// Fewest frames that must belong to a component for it to be kept.
const LEAST_FRAMES: f64 = 1.0;
/// Most components of a model.
pub const MAX_COMPONENTS: usize = 64;
/// Default ridge of [`Learning::Em`]. On held-out poses of a punch, a walk, waving and a dance, as they are shown, its errors
/// are 5.48°, 2.64°, 11.69° and 19.74°; those of 0.05 are 5.51°, 2.87°, 11.68° and 19.77°, those of 0.001 are 5.50°, 2.59°,
/// 11.75° and 20.05°.
pub const EM_RIDGE: f64 = 0.01;
/// Default seed. Errors on held-out poses of four seeds differ by 0.01° (walk) to 1.3° (dance), and none is better
/// everywhere.
pub const SEED: u64 = 0;
/// Least standard deviation of a style, absolute and as a share of its mean: smaller ones are rounding errors.
const LEAST_DEVIATION: f64 = 1e-4;
/// Share of the recorded styles that are considered unsupported.
const UNSUPPORTED: f64 = 0.01;

/// Learning algorithm of the maps.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Learning {
    /// One pose at a time: a self-organising mixture network.
    #[default]
    Som,
    /// The same with the signs of maps and shares that the paper prints (its Eq. 7 and 8): it diverges, and is kept for
    /// demonstration.
    AsPrinted,
    /// Expectation maximisation over all poses at once.
    Em {
        /// Ridge of the regressions, per sample: 0.01 to 0.3.
        ridge: f64,
    },
}

/// Training options.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Options {
    /// Number of components; by default a fortieth of the frames, within 4 to 16. Each has at least twelve frames.
    pub components: Option<usize>,
    /// Random seed.
    pub seed: u64,
    /// Learning algorithm of the maps.
    pub learning: Learning,
}

/// Error of recordings that give no model.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum TrainError {
    /// No style variable, or too many.
    #[error("{0} style variables were given; 1 to {MAX_AXES} were expected")]
    Axes(usize),
    /// A style variable occurs twice.
    #[error("the style variable '{0}' was given twice")]
    SameAxis(String),
    /// The recordings are too short.
    #[error(
        "the clips have {found} frames together at 30 frames per second; at least {expected} were expected to learn from"
    )]
    TooFewFrames {
        /// Number of frames.
        found: usize,
        /// Number of frames needed.
        expected: usize,
    },
    /// A style variable that does not vary.
    #[error(
        "the style variable '{axis}' is {value:.1} {unit} in every frame; one that changes in these clips was expected"
    )]
    Constant {
        /// The variable.
        axis: String,
        /// Its value.
        value: f64,
        /// Its unit.
        unit: String,
    },
    /// A style variable without a value, for example after a division by zero.
    #[error("the style variable '{axis}' has no value in frame {frame} of '{clip}'")]
    NoValue {
        /// The variable.
        axis: String,
        /// The recording.
        clip: String,
        /// Its frame; the first is 1.
        frame: usize,
    },
}

/// Progress of a [`Trainer`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrainProgress {
    /// Passes done.
    pub done: usize,
    /// Number of all passes.
    pub total: usize,
    /// Prediction error in the last pass: root mean square over the numbers of a row, radians.
    pub error: f64,
}

/// The training algorithm and its state.
#[derive(Clone, Debug)]
enum Learner {
    Som(Somn),
    Em(EmTrainer),
    /// The maps are learnt, and their regions are being fitted.
    Settling(Vec<Component>),
}

/// Training in passes; between them the caller may do other work or stop it.
#[derive(Clone, Debug)]
pub struct Trainer {
    model: KeyStyleModel,
    samples: Samples,
    learner: Learner,
    /// Passes of the learner.
    passes: usize,
    done: usize,
    error: f64,
}

/// Trains a model on recordings: [`Trainer`] without a pause.
///
/// # Errors
/// See [`TrainError`].
pub fn train(recordings: &[&Recording], axes: &[Measure], options: Options) -> Result<KeyStyleModel, TrainError> {
    let Ok(model) = Trainer::new(recordings, axes, options)?.finish(&Sequential);
    Ok(model)
}

impl Trainer {
    /// Prepares training on these recordings, which must have the same body; that of the first one is used.
    ///
    /// # Errors
    /// See [`TrainError`].
    pub fn new(recordings: &[&Recording], axes: &[Measure], options: Options) -> Result<Self, TrainError> {
        if !(1..=MAX_AXES).contains(&axes.len()) {
            return Err(TrainError::Axes(axes.len()));
        }
        if let Some(axis) = axes.iter().enumerate().find_map(|(i, axis)| axes[..i].contains(axis).then_some(axis)) {
            return Err(TrainError::SameAxis(axis.to_string()));
        }
        let frames: usize = recordings.iter().map(|r| r.poses.len()).sum();
        let fewest = COMPONENTS[0] * FEWEST_FRAMES_EACH;
        let Some(first) = recordings.first().filter(|_| frames >= fewest) else {
            return Err(TrainError::TooFewFrames { found: frames, expected: fewest });
        };
        let mut styles = styles_of(recordings, axes)?;
        let (style_mean, style_deviation) = standardise(&mut styles, axes)?;
        let space = PoseSpace::of_poses(&first.proportions, recordings.iter().flat_map(|r| &r.poses));
        let rows: Vec<_> = recordings.iter().flat_map(|r| &r.poses).map(|pose| space.row(pose)).collect();
        let mut first_frame = 0;
        let clips = recordings.iter().map(|recording| {
            let span = ClipSpan { name: recording.name.clone(), first_frame, frames: recording.poses.len() };
            first_frame += span.frames;
            span
        });
        let model = KeyStyleModel {
            space,
            axes: axes.to_vec(),
            style_mean,
            style_deviation,
            components: Vec::new(),
            variance: FIRST_VARIANCE,
            least_support: f64::NEG_INFINITY,
            travels: recordings.iter().all(|r| r.travels),
            clips: clips.collect(),
            styles: styles.clone(),
            rows: rows.iter().map(|row| row.map(|x| x as f32)).collect(),
        };
        let samples = Samples { rows, styles, axes: axes.len() };
        Ok(Self::on_samples(model, samples, options))
    }

    /// Prepares training on the training data of a model. The model stores poses in single precision, so the result differs
    /// slightly from the model.
    ///
    /// # Errors
    /// If the model has too few frames to learn from.
    pub fn of_model(model: &KeyStyleModel, options: Options) -> Result<Self, TrainError> {
        let (frames, fewest) = (model.rows.len(), COMPONENTS[0] * FEWEST_FRAMES_EACH);
        if frames < fewest {
            return Err(TrainError::TooFewFrames { found: frames, expected: fewest });
        }
        let rows = (0..frames).map(|frame| model.recorded_row(frame)).collect();
        let samples = Samples { rows, styles: model.styles.clone(), axes: model.axis_count() };
        let begun = KeyStyleModel {
            components: Vec::new(),
            variance: FIRST_VARIANCE,
            least_support: f64::NEG_INFINITY,
            ..model.clone()
        };
        Ok(Self::on_samples(begun, samples, options))
    }

    fn on_samples(model: KeyStyleModel, samples: Samples, options: Options) -> Self {
        let frames = samples.rows.len();
        let components = options.components.unwrap_or((frames / FRAMES_EACH).clamp(COMPONENTS[0], COMPONENTS[1]));
        let components = components.clamp(1, (frames / FEWEST_FRAMES_EACH).min(MAX_COMPONENTS));
        let (learner, passes) = match options.learning {
            Learning::Som | Learning::AsPrinted => {
                let as_printed = options.learning == Learning::AsPrinted;
                (Learner::Som(Somn::new(&samples, components, PASSES, options.seed, as_printed)), PASSES)
            }
            Learning::Em { ridge } => (Learner::Em(EmTrainer::new(&samples, components, ridge, options.seed)), ROUNDS),
        };
        Self { model, samples, learner, passes, done: 0, error: f64::NAN }
    }

    /// Makes one update of the network, a part of a pass. `None` once no pass is left, once learning has diverged, and if the
    /// learner is not a network.
    pub fn update(&mut self) -> Option<Update> {
        let Learner::Som(network) = &mut self.learner else { return None };
        let update = network.update(&self.samples)?;
        if network.is_between_passes() {
            self.done += 1;
            self.error = update.error;
        }
        Some(update)
    }

    /// Number of updates so far, and in total.
    pub fn updates(&self) -> [usize; 2] {
        let total = self.passes * self.samples.rows.len();
        match &self.learner {
            Learner::Som(network) => [network.seen(), total],
            Learner::Em(_) | Learner::Settling(_) => [total; 2],
        }
    }

    /// The present components during learning.
    pub fn components(&self) -> &[Component] {
        match &self.learner {
            Learner::Som(network) => &network.components,
            Learner::Em(em) => &em.components,
            Learner::Settling(components) => components,
        }
    }

    /// Responsibilities of the last update's pose, one number per component; 0 before the first update, empty without a
    /// network.
    pub fn responsibilities(&self) -> &[f64] {
        match &self.learner {
            Learner::Som(network) => network.responsibilities(),
            Learner::Em(_) | Learner::Settling(_) => &[],
        }
    }

    /// Returns the model with the present components, as if all passes were done.
    pub fn so_far(&self) -> KeyStyleModel {
        let Ok(model) = Self { done: self.done.max(self.passes), ..self.clone() }.finish(&Sequential);
        model
    }
}

impl IncrementalJob for Trainer {
    type Progress = TrainProgress;
    type Output = KeyStyleModel;
    type Error = Infallible;

    /// Runs one pass.
    fn step(&mut self, _executor: &impl ParallelMap) -> Result<Option<TrainProgress>, Infallible> {
        let total = self.passes + SETTLING_ROUNDS;
        if self.done == total {
            return Ok(None);
        }
        if self.done == self.passes {
            let learnt = match &mut self.learner {
                Learner::Som(network) => std::mem::take(&mut network.components),
                Learner::Em(em) => {
                    self.model.variance = em.variance;
                    std::mem::take(&mut em.components)
                }
                Learner::Settling(components) => std::mem::take(components),
            };
            self.learner = Learner::Settling(learnt);
        }
        let square = match &mut self.learner {
            Learner::Som(network) => network.pass(&self.samples) / DIMS as f64,
            Learner::Em(em) => em.round(&self.samples) / DIMS as f64,
            Learner::Settling(components) => {
                self.model.variance = settle(&self.samples, components, self.model.variance, |_, _| {});
                self.model.variance
            }
        };
        self.done += 1;
        self.error = square.sqrt();
        Ok(Some(TrainProgress { done: self.done, total, error: self.error }))
    }

    fn conclude(mut self, _executor: &impl ParallelMap) -> Result<KeyStyleModel, Infallible> {
        if let Learner::Settling(mut components) = self.learner {
            // A component without poses is meaningless, and would dominate far from the other components' styles.
            components.retain(|c| c.weight * self.samples.rows.len() as f64 >= LEAST_FRAMES);
            normalise_weights(&mut components);
            self.model.components = components;
        }
        let gates = Gate::all(&self.model.components, self.samples.axes).unwrap_or_default();
        let mut support: Vec<f64> = self.samples.styles.iter().map(|u| greatest(&gates, u)).collect();
        support.sort_by(f64::total_cmp);
        self.model.least_support = support[(UNSUPPORTED * support.len() as f64) as usize];
        Ok(self.model)
    }
}

/// Styles of all frames, in the axes' units.
fn styles_of(recordings: &[&Recording], axes: &[Measure]) -> Result<Vec<Style>, TrainError> {
    let mut styles = Vec::new();
    for recording in recordings {
        for (i, frame) in recording.frames.iter().enumerate() {
            let mut style = [0.0; MAX_AXES];
            for (value, axis) in style.iter_mut().zip(axes) {
                *value = axis.measure(frame);
                if !value.is_finite() {
                    let (axis, clip) = (axis.to_string(), recording.name.clone());
                    return Err(TrainError::NoValue { axis, clip, frame: i + 1 });
                }
            }
            styles.push(style);
        }
    }
    Ok(styles)
}

/// Scales styles to mean 0 and deviation 1; returns their original mean and deviation.
fn standardise(styles: &mut [Style], axes: &[Measure]) -> Result<(Style, Style), TrainError> {
    let count = styles.len() as f64;
    let (mut means, mut deviations) = ([0.0; MAX_AXES], [1.0; MAX_AXES]);
    for (j, axis) in axes.iter().enumerate() {
        let mean = styles.iter().map(|u| u[j]).sum::<f64>() / count;
        let deviation = (styles.iter().map(|u| (u[j] - mean) * (u[j] - mean)).sum::<f64>() / count).sqrt();
        // Not "less": a deviation that overflows is invalid, too.
        if !(deviation > LEAST_DEVIATION * (1.0 + mean.abs()) && deviation.is_finite()) {
            let (axis, unit) = (axis.to_string(), axis.unit().to_string());
            return Err(TrainError::Constant { axis, value: mean, unit });
        }
        for u in styles.iter_mut() {
            u[j] = (u[j] - mean) / deviation;
        }
        (means[j], deviations[j]) = (mean, deviation);
    }
    Ok((means, deviations))
}
