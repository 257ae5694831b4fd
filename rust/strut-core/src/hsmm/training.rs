//! Training of a model on recorded walks (`docs/methods/hsmm.md` §5 and §6).

use super::adaptation::adapt;
use super::features::{Track, reference};
use super::model::{Observation, SIDES, StyleMeans, WalkModel};
use super::refinement::refine;
use super::statistics::{Sample, SharedVariances, Statistics, mean_variances};
use crate::humanoid::{JOINTS, Proportions};
use crate::incremental::IncrementalJob;
use crate::kinematics::rotation_row::{ROTATION_DIMS, RotationRow};
use crate::math::Quat;
use crate::parallel::ParallelMap;
use std::convert::Infallible;
use thiserror::Error;

/// Rounds of alignment and estimation.
const ROUNDS: usize = 15;
/// Least variance of an observation, as a share of its variance over all frames.
const LEAST_VARIANCE_SHARE: f64 = 0.01;
/// Least number of steps of either foot from which a style's own variances are reliable.
const ENOUGH_STEPS: usize = 20;

/// A clip of walking in a style.
#[derive(Clone, Copy, Debug)]
pub struct LabelledClip<'a> {
    /// Name of the style.
    pub style: &'a str,
    /// The clip.
    pub track: &'a Track,
}

/// Training options.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// Whether means are refined so that trajectories are nearest to the recorded ones. Without, they are the means of the
    /// frames: better for recognising styles, but joints move less.
    pub refined: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self { refined: true }
    }
}

/// Error of clips that give no model.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum TrainError {
    /// No clip has a step.
    #[error("no clip contains a step: alternating strikes of both feet, 0.2 to 1.5 s apart, were expected")]
    NoStep,
    /// The clips of a style have no step.
    #[error(
        "the clips of style '{0}' contain no step: alternating strikes of both feet, 0.2 to 1.5 s apart, were expected"
    )]
    NoStepInStyle(String),
    /// The clips have no step of the left foot, or none of the right one. A style may have steps of one foot only if other
    /// styles have steps of the other foot: its difference from them is assumed to be the same for both feet.
    #[error("the clips contain steps of one foot only; steps of both feet were expected")]
    OneSided,
}

/// Trains a model on clips, one style for every name, in the order of the names' first use: [`Trainer`] without a pause.
///
/// # Errors
/// See [`TrainError`].
pub fn train(
    proportions: &Proportions,
    clips: &[LabelledClip<'_>],
    options: Options,
    executor: &impl ParallelMap,
) -> Result<WalkModel, TrainError> {
    let Ok(model) = Trainer::new(proportions, clips, options, executor)?.finish(executor);
    Ok(model)
}

/// Progress of a [`Trainer`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TrainProgress {
    /// Units of work done.
    pub done: usize,
    /// Total units of work: two per style, and one for all styles together.
    pub total: usize,
}

/// Training in steps; between them the caller may do other work or stop it. The model does not depend on the number of styles
/// per step.
#[derive(Debug)]
pub struct Trainer {
    proportions: Proportions,
    options: Options,
    reference: [Quat; JOINTS],
    styles: Vec<String>,
    samples: Vec<Sample>,
    floor: Observation,
    /// The variances of every style that has been trained separately.
    own: Vec<SharedVariances>,
    /// The means of all styles together, and the shared variances; set when all styles have been trained separately.
    pooled: Option<(StyleMeans, SharedVariances)>,
    /// The means of every finished style.
    means: Vec<StyleMeans>,
}

impl Trainer {
    /// Prepares training on these clips.
    ///
    /// # Errors
    /// See [`TrainError`].
    pub fn new(
        proportions: &Proportions,
        clips: &[LabelledClip<'_>],
        options: Options,
        executor: &impl ParallelMap,
    ) -> Result<Self, TrainError> {
        let mut styles: Vec<String> = Vec::new();
        for clip in clips {
            if styles.iter().all(|style| style != clip.style) {
                styles.push(clip.style.to_owned());
            }
        }
        if styles.is_empty() {
            return Err(TrainError::NoStep);
        }
        let tracks: Vec<&Track> = clips.iter().map(|clip| clip.track).collect();
        let reference = reference(&tracks);
        let samples: Vec<Sample> = executor.map(clips.len(), &|i| {
            let style = styles.iter().position(|style| style == clips[i].style).unwrap_or_default();
            Sample::new(style, tracks[i], &reference)
        });
        let sides: Vec<[usize; SIDES]> = (0..styles.len()).map(|style| steps_by_side(&samples, style)).collect();
        if let Some(style) = sides.iter().position(|sides| *sides == [0, 0]) {
            let name = styles[style].clone();
            return Err(if styles.len() == 1 { TrainError::NoStep } else { TrainError::NoStepInStyle(name) });
        }
        if (0..SIDES).any(|side| sides.iter().all(|of_style| of_style[side] == 0)) {
            return Err(TrainError::OneSided);
        }
        let floor = least_variances(&samples);
        let (own, pooled, means) = (Vec::new(), None, Vec::new());
        Ok(Self { proportions: *proportions, options, reference, styles, samples, floor, own, pooled, means })
    }

    /// The samples of a style.
    fn of_style(&self, style: usize) -> Vec<&Sample> {
        self.samples.iter().filter(|s| s.style == style).collect()
    }
}

impl IncrementalJob for Trainer {
    type Progress = TrainProgress;
    type Output = WalkModel;
    type Error = Infallible;

    /// Processes as many styles as the executor runs in parallel.
    fn step(&mut self, executor: &impl ParallelMap) -> Result<Option<TrainProgress>, Infallible> {
        let (count, styles) = (self.styles.len(), executor.batch_size());
        if self.own.len() < count {
            let first = self.own.len();
            let own = executor.map(styles.min(count - first), &|i| train_alone(&self.of_style(first + i), &self.floor));
            self.own.extend(own);
        } else if let Some((pooled, shared)) = &self.pooled {
            let first = self.means.len();
            if first == count {
                return Ok(None);
            }
            let means = executor.map(styles.min(count - first), &|i| {
                let samples = self.of_style(first + i);
                let adapted = adapt(&samples, pooled, shared);
                if self.options.refined { refine(&samples, &adapted, shared) } else { adapted }
            });
            self.means.extend(means);
        } else {
            let fewest = |style: usize| steps_by_side(&self.samples, style).into_iter().min().unwrap_or(0);
            let greatest = (0..count).map(fewest).max().unwrap_or(0);
            let least = if greatest >= ENOUGH_STEPS { ENOUGH_STEPS } else { greatest.min(1) };
            let shared =
                mean_variances((0..count).filter(|&style| fewest(style) >= least).map(|style| &self.own[style]));
            let by_style: Vec<Vec<&Sample>> = (0..count).map(|style| self.of_style(style)).collect();
            let means = train_means(&by_style, &shared);
            self.pooled = Some((means, shared));
        }
        let done = self.own.len() + usize::from(self.pooled.is_some()) + self.means.len();
        Ok(Some(TrainProgress { done, total: 2 * count + 1 }))
    }

    fn conclude(self, executor: &impl ParallelMap) -> Result<WalkModel, Infallible> {
        let range = range_of(&self.samples);
        let Self { proportions, reference, styles, means, .. } = self;
        let shared = self.pooled.map_or_else(|| mean_variances(std::iter::empty()), |(_, shared)| shared);
        let SharedVariances { variances, duration_variances } = shared;
        let model = WalkModel { proportions, reference, variances, duration_variances, range, styles, means };
        Ok(model.with_walked_lengths(executor))
    }
}

/// Numbers of a style's steps of the left foot and of the right foot.
fn steps_by_side(samples: &[Sample], style: usize) -> [usize; SIDES] {
    let mut sides = [0; SIDES];
    let of_style = samples.iter().filter(|s| s.style == style);
    of_style.flat_map(|s| &s.steps).for_each(|step| sides[step.side as usize] += 1);
    sides
}

/// Least variances, as shares of the variances over all frames.
fn least_variances(samples: &[Sample]) -> Observation {
    let count = samples.iter().map(|s| s.observations.len()).sum::<usize>().max(1) as f64;
    let all = || samples.iter().flat_map(|s| &s.observations);
    std::array::from_fn(|part| {
        std::array::from_fn(|d| {
            let mean = all().map(|o| o[part][d]).sum::<f64>() / count;
            let variance = all().map(|o| (o[part][d] - mean) * (o[part][d] - mean)).sum::<f64>() / count;
            // Keeps the variance of a joint that never moves above zero.
            (LEAST_VARIANCE_SHARE * variance).max(1e-9)
        })
    })
}

/// Trains on one style's steps; only its variances are used.
fn train_alone(samples: &[&Sample], floor: &Observation) -> SharedVariances {
    let first = Statistics::aligned(samples, None);
    let mut means = first.means();
    let mut shared = first.variances(&means, floor);
    for _ in 0..ROUNDS {
        let sums = Statistics::aligned(samples, Some((&means, &shared)));
        means = sums.means();
        shared = sums.variances(&means, floor);
    }
    shared
}

/// Trains the means and durations of all styles' steps together with fixed variances. Every style is modelled as a pose
/// offset to all its states (adaptive training, §6a), so that the differences of styles do not blur the states.
fn train_means(styles: &[Vec<&Sample>], shared: &SharedVariances) -> StyleMeans {
    let mut means = Statistics::aligned(&styles.concat(), None).means();
    let mut added = vec![[0.0; ROTATION_DIMS]; styles.len()];
    for _ in 0..ROUNDS {
        let mut all = Statistics::zero();
        for (samples, added) in styles.iter().zip(&mut added) {
            let mut sums = Statistics::aligned(samples, Some((&means.with_pose(added), shared)));
            *added = sums.pose_beside(&means, shared);
            sums.take_pose(added);
            all.merge(&sums);
        }
        means = all.means();
    }
    means
}

/// Least and greatest values over all steps.
fn range_of(samples: &[Sample]) -> [RotationRow; 2] {
    let rows = || samples.iter().flat_map(|s| s.steps.iter().flat_map(|step| &s.rows[step.frames.clone()]));
    [f64::min as fn(f64, f64) -> f64, f64::max]
        .map(|extreme| std::array::from_fn(|d| rows().map(|row| row[d]).reduce(extreme).unwrap_or_default()))
}
