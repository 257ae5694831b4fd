//! The model of a set of walk styles: plain data.

use crate::humanoid::{JOINTS, Proportions};
use crate::kinematics::root_path::Support;
use crate::kinematics::rotation_row::{ROTATION_DIMS, RotationRow, rotations_of};
use crate::math::Quat;

/// States of a step, from left to right.
pub const STATES: usize = 5;
/// Steps of the left and of the right foot.
pub const SIDES: usize = 2;

/// A pose, its velocity and its acceleration, per frame.
pub type Observation = [RotationRow; 3];

/// The parts of an [`Observation`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stream {
    /// c.
    Static,
    /// Δc.
    Delta,
    /// Δ²c.
    DeltaDelta,
}

impl Stream {
    /// All parts in order.
    pub const ALL: [Self; 3] = [Self::Static, Self::Delta, Self::DeltaDelta];
}

/// The foot that swings in a step; the other one supports.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Side {
    Left,
    Right,
}

impl Side {
    /// The foot that supports.
    pub fn other(self) -> Self {
        match self {
            Self::Left => Self::Right,
            Self::Right => Self::Left,
        }
    }
}

impl From<Side> for Support {
    /// The foot that does not swing supports (`docs/methods/hsmm.md` §11).
    fn from(swinging: Side) -> Self {
        Self::On(swinging.other() as usize)
    }
}

/// One value for every state of either side.
pub type PerState<T> = [[T; STATES]; SIDES];

/// All numbers of all states as one slice.
pub fn flattened(of: &PerState<Observation>) -> &[f64] {
    of.as_flattened().as_flattened().as_flattened()
}

/// Mutable version of [`flattened`].
pub(super) fn flattened_mut(of: &mut PerState<Observation>) -> &mut [f64] {
    of.as_flattened_mut().as_flattened_mut().as_flattened_mut()
}

/// A style: the means of its states, and their mean durations.
#[derive(Clone, Debug, PartialEq)]
pub struct StyleMeans {
    /// Means of observations.
    pub means: Box<PerState<Observation>>,
    /// Mean durations, frames.
    pub durations: PerState<f64>,
    /// Mean length of a synthesised step, metres; 0 if it was not measured.
    pub step_length: f64,
    /// Correction of the proportional step length per unit of the style's weight below 0, and above 1, metres: 0 if the legs
    /// can swing far enough for the proportional length. It is 0 in mixtures of styles.
    pub step_length_bends: [f64; 2],
}

impl StyleMeans {
    /// A style with zeros only.
    pub(super) fn zero() -> Self {
        Self {
            means: Box::new([[[[0.0; ROTATION_DIMS]; 3]; STATES]; SIDES]),
            durations: [[0.0; STATES]; SIDES],
            step_length: 0.0,
            step_length_bends: [0.0; 2],
        }
    }

    /// Adds a pose to that of every state.
    pub(super) fn with_pose(&self, added: &RotationRow) -> Self {
        let mut means = self.clone();
        for state in means.means.as_flattened_mut() {
            state[Stream::Static as usize].iter_mut().zip(added).for_each(|(mean, added)| *mean += added);
        }
        means
    }

    /// Adds `weight` times another style, without its bends.
    pub(super) fn add(&mut self, weight: f64, other: &Self) {
        flattened_mut(&mut self.means).iter_mut().zip(flattened(&other.means)).for_each(|(a, b)| *a += weight * b);
        let durations = self.durations.as_flattened_mut().iter_mut();
        durations.zip(other.durations.as_flattened()).for_each(|(a, b)| *a += weight * b);
        self.step_length += weight * other.step_length;
    }
}

/// A model of walk styles.
#[derive(Clone, Debug, PartialEq)]
pub struct WalkModel {
    /// The body of the walker.
    pub proportions: Proportions,
    /// The centres of the exponential maps; that of the hips does not contain the heading.
    pub reference: [Quat; JOINTS],
    /// Variances of observations, shared by all styles.
    pub variances: Box<PerState<Observation>>,
    /// Variances of durations, frames².
    pub duration_variances: PerState<f64>,
    /// Least and greatest value of every degree of freedom in the walks that the model was trained on.
    pub range: [RotationRow; 2],
    /// Names of the styles.
    pub styles: Vec<String>,
    /// One for every style.
    pub means: Vec<StyleMeans>,
}

impl WalkModel {
    /// The mean of all styles.
    pub fn average(&self) -> StyleMeans {
        let mut average = StyleMeans::zero();
        for means in &self.means {
            average.add(1.0 / self.means.len() as f64, means);
        }
        average
    }

    /// Converts a pose's degrees of freedom to rotations; that of the hips does not contain the heading.
    pub fn rotations(&self, row: &RotationRow) -> [Quat; JOINTS] {
        rotations_of(&self.reference, row)
    }

    /// Mixes styles by weights, one per style of the model; the remainder to a sum of 1 is the weight of the `average`
    /// (`docs/methods/hsmm.md` §9). A single style of weight 1 is reproduced bit for bit, except for the bends of its length.
    pub fn mix(&self, average: &StyleMeans, weights: &[f64]) -> StyleMeans {
        let mut mixed = StyleMeans::zero();
        let rest = 1.0 - weights.iter().sum::<f64>();
        for (weight, means) in weights.iter().zip(&self.means).chain([(&rest, average)]) {
            if *weight != 0.0 {
                mixed.add(*weight, means);
            }
        }
        mixed
    }
}
