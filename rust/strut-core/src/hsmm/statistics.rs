//! Sufficient statistics of aligned steps, from which means and variances are computed (§5).

use super::alignment::{States, equal_split};
use super::features::{Track, observations};
use super::model::{Observation, PerState, SIDES, STATES, Stream, StyleMeans, flattened, flattened_mut};
use super::steps::{Step, steps_of};
use crate::humanoid::JOINTS;
use crate::kinematics::rotation_row::{ROTATION_DIMS, RotationRow};
use crate::math::Quat;

/// Least variance of a duration, frames².
const LEAST_DURATION_VARIANCE: f64 = 0.25;

/// A clip prepared for training.
#[derive(Debug)]
pub struct Sample {
    /// Index of the style.
    pub style: usize,
    /// Degrees of freedom of every frame.
    pub rows: Vec<RotationRow>,
    /// Degrees of freedom, Δ and Δ² of every frame.
    pub observations: Vec<Observation>,
    /// Steps of the walk.
    pub steps: Vec<Step>,
}

impl Sample {
    /// Creates the sample of a clip of style number `style`.
    pub fn new(style: usize, track: &Track, reference: &[Quat; JOINTS]) -> Self {
        let rows = track.rows(reference);
        Self { style, observations: observations(&rows), rows, steps: steps_of(track) }
    }
}

/// Variances common to all styles.
#[derive(Clone, Debug)]
pub struct SharedVariances {
    /// Variances of every state's observations.
    pub variances: Box<PerState<Observation>>,
    /// Variances of every state's duration, frames².
    pub duration_variances: PerState<f64>,
}

/// Statistics over the frames and durations of aligned steps.
#[derive(Debug)]
pub struct Statistics {
    /// Number of frames in every state.
    pub frames: PerState<f64>,
    /// Sums of the observations.
    pub values: Box<PerState<Observation>>,
    /// Sums of their squares.
    pub squares: Box<PerState<Observation>>,
    /// Number of steps.
    pub steps: [f64; SIDES],
    /// Sums of the durations of every state, frames.
    pub durations: PerState<f64>,
    squared_durations: PerState<f64>,
}

impl Statistics {
    /// Statistics of no step.
    pub fn zero() -> Self {
        let zero = Box::new([[[[0.0; ROTATION_DIMS]; 3]; STATES]; SIDES]);
        Self {
            frames: [[0.0; STATES]; SIDES],
            values: zero.clone(),
            squares: zero,
            steps: [0.0; SIDES],
            durations: [[0.0; STATES]; SIDES],
            squared_durations: [[0.0; STATES]; SIDES],
        }
    }

    /// Adds a step with the durations of its states.
    pub fn add(&mut self, side: usize, step: &[Observation], durations: &[usize; STATES]) {
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

    /// Statistics of steps aligned to their most likely states by a model, or to states of equal length without one.
    pub(super) fn aligned(samples: &[&Sample], model: Option<(&StyleMeans, &SharedVariances)>) -> Self {
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

    /// Adds other statistics.
    pub fn merge(&mut self, other: &Self) {
        let pairs = [
            (self.frames.as_flattened_mut(), other.frames.as_flattened()),
            (flattened_mut(&mut self.values), flattened(&other.values)),
            (flattened_mut(&mut self.squares), flattened(&other.squares)),
            (&mut self.steps[..], &other.steps[..]),
            (self.durations.as_flattened_mut(), other.durations.as_flattened()),
            (self.squared_durations.as_flattened_mut(), other.squared_durations.as_flattened()),
        ];
        for (sums, others) in pairs {
            sums.iter_mut().zip(others).for_each(|(sum, other)| *sum += other);
        }
    }

    /// The pose offset to the means of all states that maximises the likelihood of the frames.
    pub(super) fn pose_beside(&self, means: &StyleMeans, shared: &SharedVariances) -> RotationRow {
        let pose = Stream::Static as usize;
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

    /// Subtracts a pose offset from the frames' sums; the sums of squares are unchanged.
    pub(super) fn take_pose(&mut self, added: &RotationRow) {
        for (side, state) in states() {
            let frames = self.frames[side][state];
            let values = &mut self.values[side][state][Stream::Static as usize];
            values.iter_mut().zip(added).for_each(|(value, added)| *value -= frames * added);
        }
    }

    /// Means of observations and durations.
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
    pub(super) fn variances(&self, means: &StyleMeans, floor: &Observation) -> SharedVariances {
        let mut variances = self.squares.clone();
        for (side, state) in states() {
            let frames = self.frames[side][state].max(1.0);
            let values = variances[side][state].as_flattened_mut().iter_mut();
            let means = means.means[side][state].as_flattened();
            for ((v, mean), floor) in values.zip(means).zip(floor.as_flattened()) {
                *v = (*v / frames - mean * mean).max(*floor);
            }
        }
        SharedVariances { variances, duration_variances: self.duration_variances(means) }
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

/// Mean of the styles' variances. It excludes the variance between styles, with which poses would have too little weight.
pub(super) fn mean_variances<'a>(of: impl Iterator<Item = &'a SharedVariances> + Clone) -> SharedVariances {
    let count = of.clone().count().max(1) as f64;
    let mut mean = SharedVariances {
        variances: Box::new([[[[0.0; ROTATION_DIMS]; 3]; STATES]; SIDES]),
        duration_variances: [[0.0; STATES]; SIDES],
    };
    for shared in of {
        flattened_mut(&mut mean.variances)
            .iter_mut()
            .zip(flattened(&shared.variances))
            .for_each(|(sum, v)| *sum += v / count);
        let sums = mean.duration_variances.as_flattened_mut().iter_mut();
        sums.zip(shared.duration_variances.as_flattened()).for_each(|(sum, v)| *sum += v / count);
    }
    mean
}

/// All states.
pub fn states() -> impl Iterator<Item = (usize, usize)> {
    (0..SIDES).flat_map(|side| (0..STATES).map(move |state| (side, state)))
}

/// The states of both sides, prepared for comparison with frames.
pub fn states_of<'a>(means: &'a StyleMeans, shared: &SharedVariances) -> [States<'a>; SIDES] {
    std::array::from_fn(|side| {
        let (durations, variances) = (means.durations[side], shared.duration_variances[side]);
        States::new(&means.means[side], &shared.variances[side], durations, variances)
    })
}
