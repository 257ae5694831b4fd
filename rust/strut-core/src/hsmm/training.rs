//! From recorded walks to a model (specification, §5 and §6).

use super::adaptation::adapt;
use super::alignment::{States, equal_split};
use super::features::{Track, observations, reference};
use super::model::{
    DIMS, Observation, Part, PerState, Row, SIDES, STATES, StyleMeans, WalkModel, numbers, numbers_mut,
};
use super::refinement::refine;
use super::steps::{Step, steps_of};
use crate::humanoid::{JOINTS, Proportions};
use crate::math::Quat;
use crate::parallel::{ParallelMap, Sequential};
use thiserror::Error;

/// Rounds of alignment and estimation.
const ROUNDS: usize = 15;
/// Least variance of an observation, as a share of the variance over all frames, and of a duration, frames².
const LEAST_VARIANCE_SHARE: f64 = 0.01;
const LEAST_DURATION_VARIANCE: f64 = 0.25;
/// Steps of either foot from which on a style has variances of its own to speak of.
const ENOUGH_STEPS: usize = 20;

/// A clip of walking in a style.
#[derive(Clone, Copy, Debug)]
pub struct Training<'a> {
    /// Name of the style.
    pub style: &'a str,
    /// The clip.
    pub track: &'a Track,
}

/// How a model is trained.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// Whether means are refined until trajectories are nearest to the recorded ones. Without, they are those of the frames:
    /// better to recognise styles by, and joints move less.
    pub refined: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self { refined: true }
    }
}

/// Why clips give no model.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum TrainError {
    /// No clip has a step.
    #[error("no clip holds a step: two strikes of either foot in turn, 0.2 to 1.5 s apart, were expected")]
    NoStep,
    /// A style's clips have no step.
    #[error(
        "the clips of style '{0}' hold no step: two strikes of either foot in turn, 0.2 to 1.5 s apart, were expected"
    )]
    NoStepInStyle(String),
    /// No step is that of the left foot, or of the right one. A style may have steps of one foot only, if others have those
    /// of the other: it is taken to differ from them in either foot's steps alike.
    #[error("the clips hold steps of one foot only")]
    OneSided,
}

/// A clip as the model sees it.
#[derive(Debug)]
pub(super) struct Sample {
    pub(super) style: usize,
    pub(super) rows: Vec<Row>,
    pub(super) observations: Vec<Observation>,
    pub(super) steps: Vec<Step>,
}

impl Sample {
    /// A clip of a style of this number.
    pub(super) fn new(style: usize, track: &Track, reference: &[Quat; JOINTS]) -> Self {
        let rows = track.rows(reference);
        Self { style, observations: observations(&rows), rows, steps: steps_of(track) }
    }
}

/// What all styles share.
#[derive(Clone, Debug)]
pub(super) struct Shared {
    pub(super) variances: Box<PerState<Observation>>,
    pub(super) duration_variances: PerState<f64>,
}

/// A model of these clips, one style for every name, in the order of the names' first use: [`Trainer`] without a pause.
///
/// # Errors
/// See [`TrainError`].
pub fn train(
    proportions: &Proportions,
    clips: &[Training<'_>],
    options: Options,
    executor: &impl ParallelMap,
) -> Result<WalkModel, TrainError> {
    let mut trainer = Trainer::new(proportions, clips, options, executor)?;
    while trainer.step(usize::MAX, executor).is_some() {}
    Ok(trainer.finish())
}

/// How far a [`Trainer`] has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TrainProgress {
    /// Pieces of work that are done.
    pub done: usize,
    /// All pieces of work; a style makes two, all styles together one.
    pub total: usize,
}

/// Training in steps: between two of them whoever runs it may do other things, or give it up. The model does not depend on
/// how many styles a step takes.
#[derive(Debug)]
pub struct Trainer {
    proportions: Proportions,
    options: Options,
    reference: [Quat; JOINTS],
    styles: Vec<String>,
    samples: Vec<Sample>,
    floor: Observation,
    /// The variances of every style that has been trained alone.
    own: Vec<Shared>,
    /// The means of what styles have in common, and what they share; once all have been trained alone.
    pooled: Option<(StyleMeans, Shared)>,
    /// The means of every style that is done.
    means: Vec<StyleMeans>,
}

impl Trainer {
    /// Training on these clips.
    ///
    /// # Errors
    /// See [`TrainError`].
    pub fn new(
        proportions: &Proportions,
        clips: &[Training<'_>],
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

    /// Goes on by at most so many styles, and says how far it has come; `None` when nothing is left but to
    /// [`finish`](Trainer::finish).
    pub fn step(&mut self, styles: usize, executor: &impl ParallelMap) -> Option<TrainProgress> {
        let count = self.styles.len();
        if self.own.len() < count {
            let first = self.own.len();
            let own = executor.map(styles.min(count - first), &|i| train_alone(&self.of_style(first + i), &self.floor));
            self.own.extend(own);
        } else if let Some((pooled, shared)) = &self.pooled {
            let first = self.means.len();
            if first == count {
                return None;
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
        Some(TrainProgress { done, total: 2 * count + 1 })
    }

    /// The model. What was not trained yet is.
    pub fn finish(mut self) -> WalkModel {
        while self.step(usize::MAX, &Sequential).is_some() {}
        let range = range_of(&self.samples);
        let Self { proportions, reference, styles, means, .. } = self;
        let shared = self.pooled.map_or_else(|| mean_variances(std::iter::empty()), |(_, shared)| shared);
        let Shared { variances, duration_variances } = shared;
        WalkModel { proportions, reference, variances, duration_variances, range, styles, means }
    }

    /// The samples of a style.
    fn of_style(&self, style: usize) -> Vec<&Sample> {
        self.samples.iter().filter(|s| s.style == style).collect()
    }
}

/// Sums over the frames and durations of aligned steps.
#[derive(Debug)]
pub(super) struct Sums {
    pub(super) frames: PerState<f64>,
    pub(super) values: Box<PerState<Observation>>,
    pub(super) squares: Box<PerState<Observation>>,
    /// Number of steps.
    pub(super) steps: [f64; SIDES],
    pub(super) durations: PerState<f64>,
    squared_durations: PerState<f64>,
}

impl Sums {
    pub(super) fn zero() -> Self {
        let zero = Box::new([[[[0.0; DIMS]; 3]; STATES]; SIDES]);
        Self {
            frames: [[0.0; STATES]; SIDES],
            values: zero.clone(),
            squares: zero,
            steps: [0.0; SIDES],
            durations: [[0.0; STATES]; SIDES],
            squared_durations: [[0.0; STATES]; SIDES],
        }
    }

    pub(super) fn add(&mut self, side: usize, step: &[Observation], durations: &[usize; STATES]) {
        self.steps[side] += 1.0;
        let mut rest = step;
        for (state, &duration) in durations.iter().enumerate() {
            let (frames, after) = rest.split_at(duration);
            rest = after;
            self.frames[side][state] += duration as f64;
            self.durations[side][state] += duration as f64;
            self.squared_durations[side][state] += (duration * duration) as f64;
            let (values, squares) = (&mut self.values[side][state], &mut self.squares[side][state]);
            for frame in frames {
                let sums = values.as_flattened_mut().iter_mut().zip(squares.as_flattened_mut());
                for ((value, square), v) in sums.zip(frame.as_flattened()) {
                    *value += v;
                    *square += v * v;
                }
            }
        }
    }

    /// Of steps whose states are the likeliest by a model, or of equal length without one.
    pub(super) fn aligned(samples: &[&Sample], model: Option<(&StyleMeans, &Shared)>) -> Self {
        let mut sums = Self::zero();
        let states = model.map(|(means, shared)| states_of(means, shared));
        for (sample, step) in samples.iter().flat_map(|s| s.steps.iter().map(move |step| (s, step))) {
            let observations = &sample.observations[step.frames.clone()];
            let durations = match &states {
                None => equal_split(observations.len()),
                Some(states) => states[step.side as usize].align(observations).map(|found| found.0),
            };
            if let Some(durations) = durations {
                sums.add(step.side as usize, observations, &durations);
            }
        }
        sums
    }

    fn merge(&mut self, other: &Self) {
        let pairs = [
            (self.frames.as_flattened_mut(), other.frames.as_flattened()),
            (numbers_mut(&mut self.values), numbers(&other.values)),
            (numbers_mut(&mut self.squares), numbers(&other.squares)),
            (&mut self.steps[..], &other.steps[..]),
            (self.durations.as_flattened_mut(), other.durations.as_flattened()),
            (self.squared_durations.as_flattened_mut(), other.squared_durations.as_flattened()),
        ];
        for (sums, others) in pairs {
            sums.iter_mut().zip(others).for_each(|(sum, other)| *sum += other);
        }
    }

    /// The pose which added to the means of all states makes the frames likeliest.
    fn pose_beside(&self, means: &StyleMeans, shared: &Shared) -> Row {
        let pose = Part::Pose as usize;
        std::array::from_fn(|d| {
            let (mut beside, mut weights) = (0.0, f64::MIN_POSITIVE);
            for (side, state) in states() {
                let (frames, variance) = (self.frames[side][state], shared.variances[side][state][pose][d]);
                beside += (self.values[side][state][pose][d] - frames * means.means[side][state][pose][d]) / variance;
                weights += frames / variance;
            }
            beside / weights
        })
    }

    /// As if the frames were without a pose that is added to all; the squares stay as they are.
    fn take_pose(&mut self, added: &Row) {
        for (side, state) in states() {
            let frames = self.frames[side][state];
            let values = &mut self.values[side][state][Part::Pose as usize];
            values.iter_mut().zip(added).for_each(|(value, added)| *value -= frames * added);
        }
    }

    /// Means of everything.
    pub(super) fn means(&self) -> StyleMeans {
        let mut means = StyleMeans::zero();
        for (side, state) in states() {
            let frames = self.frames[side][state].max(1.0);
            means.means[side][state] = self.values[side][state].map(|row| row.map(|v| v / frames));
            means.durations[side][state] = self.durations[side][state] / self.steps[side].max(1.0);
        }
        means
    }

    /// Variances about the means, at least the `floor`.
    fn variances(&self, means: &StyleMeans, floor: &Observation) -> Shared {
        let mut variances = self.squares.clone();
        for (side, state) in states() {
            let frames = self.frames[side][state].max(1.0);
            let values = variances[side][state].as_flattened_mut().iter_mut();
            let means = means.means[side][state].as_flattened();
            for ((v, mean), floor) in values.zip(means).zip(floor.as_flattened()) {
                *v = (*v / frames - mean * mean).max(*floor);
            }
        }
        Shared { variances, duration_variances: self.duration_variances(means) }
    }

    fn duration_variances(&self, means: &StyleMeans) -> PerState<f64> {
        let mut variances = self.squared_durations;
        for (side, state) in states() {
            let mean = means.durations[side][state];
            let variance = variances[side][state] / self.steps[side].max(1.0) - mean * mean;
            variances[side][state] = variance.max(LEAST_DURATION_VARIANCE);
        }
        variances
    }
}

/// Steps of a style that are those of the left foot and of the right.
fn steps_by_side(samples: &[Sample], style: usize) -> [usize; SIDES] {
    let mut sides = [0; SIDES];
    let of_style = samples.iter().filter(|s| s.style == style);
    of_style.flat_map(|s| &s.steps).for_each(|step| sides[step.side as usize] += 1);
    sides
}

/// All states.
pub(super) fn states() -> impl Iterator<Item = (usize, usize)> {
    (0..SIDES).flat_map(|side| (0..STATES).map(move |state| (side, state)))
}

/// The states of both sides, ready to be compared with frames.
pub(super) fn states_of<'a>(means: &'a StyleMeans, shared: &Shared) -> [States<'a>; SIDES] {
    std::array::from_fn(|side| {
        let (durations, variances) = (means.durations[side], shared.duration_variances[side]);
        States::new(&means.means[side], &shared.variances[side], durations, variances)
    })
}

/// Shares of the variances over all frames.
fn least_variances(samples: &[Sample]) -> Observation {
    let count = samples.iter().map(|s| s.observations.len()).sum::<usize>().max(1) as f64;
    let all = || samples.iter().flat_map(|s| &s.observations);
    std::array::from_fn(|part| {
        std::array::from_fn(|d| {
            let mean = all().map(|o| o[part][d]).sum::<f64>() / count;
            let variance = all().map(|o| (o[part][d] - mean) * (o[part][d] - mean)).sum::<f64>() / count;
            // A joint that never moves would otherwise be certain beyond all numbers.
            (LEAST_VARIANCE_SHARE * variance).max(1e-9)
        })
    })
}

/// A model of one style's steps alone: only its variances are of use.
fn train_alone(samples: &[&Sample], floor: &Observation) -> Shared {
    let first = Sums::aligned(samples, None);
    let mut means = first.means();
    let mut shared = first.variances(&means, floor);
    for _ in 0..ROUNDS {
        let sums = Sums::aligned(samples, Some((&means, &shared)));
        means = sums.means();
        shared = sums.variances(&means, floor);
    }
    shared
}

/// Variances that are shared: with those between styles in them, poses would count for too little.
fn mean_variances<'a>(of: impl Iterator<Item = &'a Shared> + Clone) -> Shared {
    let count = of.clone().count().max(1) as f64;
    let mut mean =
        Shared { variances: Box::new([[[[0.0; DIMS]; 3]; STATES]; SIDES]), duration_variances: [[0.0; STATES]; SIDES] };
    for shared in of {
        numbers_mut(&mut mean.variances)
            .iter_mut()
            .zip(numbers(&shared.variances))
            .for_each(|(sum, v)| *sum += v / count);
        let sums = mean.duration_variances.as_flattened_mut().iter_mut();
        sums.zip(shared.duration_variances.as_flattened()).for_each(|(sum, v)| *sum += v / count);
    }
    mean
}

/// Means and durations of all styles' steps together, by variances that stay. Every style is taken to differ by a pose that is
/// added to all its states (adaptive training, §6a): what is left is alike, and states are not blurred by what is not.
fn train_means(styles: &[Vec<&Sample>], shared: &Shared) -> StyleMeans {
    let mut means = Sums::aligned(&styles.concat(), None).means();
    let mut added = vec![[0.0; DIMS]; styles.len()];
    for _ in 0..ROUNDS {
        let mut all = Sums::zero();
        for (samples, added) in styles.iter().zip(&mut added) {
            let mut sums = Sums::aligned(samples, Some((&means.with_pose(added), shared)));
            *added = sums.pose_beside(&means, shared);
            sums.take_pose(added);
            all.merge(&sums);
        }
        means = all.means();
    }
    means
}

/// Least and greatest values in all steps.
fn range_of(samples: &[Sample]) -> [Row; 2] {
    let rows = || samples.iter().flat_map(|s| s.steps.iter().flat_map(|step| &s.rows[step.frames.clone()]));
    [f64::min as fn(f64, f64) -> f64, f64::max]
        .map(|extreme| std::array::from_fn(|d| rows().map(|row| row[d]).reduce(extreme).unwrap_or_default()))
}
