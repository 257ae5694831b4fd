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
/// Rounds of expectation and maximisation.
const ROUNDS: usize = 30;
/// Frames for each component, fewest and most components unless a number is asked for.
const FRAMES_EACH: usize = 40;
const COMPONENTS: [usize; 2] = [4, 16];
/// Fewest frames that a component can be learnt from, and most components of all.
const FEWEST_FRAMES_EACH: usize = 12;
/// Fewest frames that a component must be left with to stay.
const LEAST_FRAMES: f64 = 1.0;
/// Most components of a model.
pub const MAX_COMPONENTS: usize = 64;
/// Ridge of [`Learning::Em`], unless another is asked for. On held-out poses of a punch, a walk, waving and a dance, as they are
/// shown, it errs by 5.48°, 2.64°, 11.69° and 19.74°; 0.05 by 5.51°, 2.87°, 11.68° and 19.77°; 0.001 by 5.50°, 2.59°, 11.75° and
/// 20.05°.
pub const EM_RIDGE: f64 = 0.01;
/// Seed of training, unless another is asked for. Errors on held-out poses of four seeds differ by 0.01° (walk) to 1.3° (dance), and
/// none is better everywhere.
pub const SEED: u64 = 0;
/// Least standard deviation of a style, absolutely and as a share of its mean: below, it is rounding.
const LEAST_DEVIATION: f64 = 1e-4;
/// Share of the recorded styles that count as without support.
const UNSUPPORTED: f64 = 0.01;

/// How the maps are learnt.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Learning {
    /// By one pose after another: a self-organising mixture network.
    #[default]
    Som,
    /// The same with the signs of maps and shares that the paper prints (its Eq. 7 and 8): it diverges, and is here to be seen.
    AsPrinted,
    /// By expectation and maximisation over all poses at once.
    Em {
        /// Ridge of the regressions, per sample: 0.01 to 0.3.
        ridge: f64,
    },
}

/// How a model is trained.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Options {
    /// Number of components; a fortieth of the frames, but 4 to 16, unless said otherwise. Each gets twelve frames at least.
    pub components: Option<usize>,
    /// Random seed.
    pub seed: u64,
    /// How the maps are learnt.
    pub learning: Learning,
}

/// Why recordings give no model.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum TrainError {
    /// None, or too many.
    #[error("{0} style variables were given; 1 to {MAX_AXES} were expected")]
    Axes(usize),
    /// One twice.
    #[error("the style variable '{0}' was given twice")]
    SameAxis(String),
    /// Too short.
    #[error(
        "the clips have {found} frames together at 30 frames per second; at least {expected} were expected to learn from"
    )]
    TooFewFrames {
        /// Frames that there are.
        found: usize,
        /// Frames that are needed.
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
    /// A style variable without a value, by a division by zero for example.
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

/// How far a [`Trainer`] has come.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrainProgress {
    /// Passes that are done.
    pub done: usize,
    /// All passes.
    pub total: usize,
    /// Prediction error in the last pass: root mean square over the numbers of a row, radians.
    pub error: f64,
}

/// The training algorithm and its state.
#[derive(Clone, Debug)]
enum Learner {
    Som(Somn),
    Em(EmTrainer),
    /// The maps are learnt, their regions are settled.
    Settling(Vec<Component>),
}

/// Training in passes, between which whoever runs it may do other things, or give it up.
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

/// A model of these recordings: [`Trainer`] without a pause.
///
/// # Errors
/// See [`TrainError`].
pub fn train(recordings: &[&Recording], axes: &[Measure], options: Options) -> Result<KeyStyleModel, TrainError> {
    let Ok(model) = Trainer::new(recordings, axes, options)?.finish(&Sequential);
    Ok(model)
}

impl Trainer {
    /// Training on these recordings, which are of one body: the first one's.
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

    /// Training anew on what a model was trained on. The model keeps poses in single precision, so that the outcome differs
    /// from the model by as little.
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

    /// Goes on by one update of the network, a part of a pass. None once no pass is left, once learning has diverged, and
    /// where something else than a network is trained.
    pub fn update(&mut self) -> Option<Update> {
        let Learner::Som(network) = &mut self.learner else { return None };
        let update = network.update(&self.samples)?;
        if network.is_between_passes() {
            self.done += 1;
            self.error = update.error;
        }
        Some(update)
    }

    /// Number of updates so far, of so many in all.
    pub fn updates(&self) -> [usize; 2] {
        let total = self.passes * self.samples.rows.len();
        match &self.learner {
            Learner::Som(network) => [network.seen(), total],
            Learner::Em(_) | Learner::Settling(_) => [total; 2],
        }
    }

    /// The components as they are while they learn.
    pub fn components(&self) -> &[Component] {
        match &self.learner {
            Learner::Som(network) => &network.components,
            Learner::Em(em) => &em.components,
            Learner::Settling(components) => components,
        }
    }

    /// How much of the last update's pose is whose, one number a component; 0 before the first update, none without one.
    pub fn responsibilities(&self) -> &[f64] {
        match &self.learner {
            Learner::Som(network) => network.responsibilities(),
            Learner::Em(_) | Learner::Settling(_) => &[],
        }
    }

    /// The model that the components make as they are, as if all passes were done.
    pub fn so_far(&self) -> KeyStyleModel {
        let Ok(model) = Self { done: self.done.max(self.passes), ..self.clone() }.finish(&Sequential);
        model
    }
}

impl IncrementalJob for Trainer {
    type Progress = TrainProgress;
    type Output = KeyStyleModel;
    type Error = Infallible;

    /// Goes on by a pass.
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
            // A component that no pose is left to knows nothing, and would speak for all styles far from the others'.
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

/// The styles of all frames, in the axes' units.
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

/// Brings styles to mean 0 and deviation 1; what these were.
fn standardise(styles: &mut [Style], axes: &[Measure]) -> Result<(Style, Style), TrainError> {
    let count = styles.len() as f64;
    let (mut means, mut deviations) = ([0.0; MAX_AXES], [1.0; MAX_AXES]);
    for (j, axis) in axes.iter().enumerate() {
        let mean = styles.iter().map(|u| u[j]).sum::<f64>() / count;
        let deviation = (styles.iter().map(|u| (u[j] - mean) * (u[j] - mean)).sum::<f64>() / count).sqrt();
        // Not "less": a deviation that overflows is none either.
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
