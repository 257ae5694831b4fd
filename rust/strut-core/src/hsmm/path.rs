//! Trajectory of one degree of freedom with adjustable weights of the static, Δ and Δ² statistics (`docs/methods/hsmm.md`
//! §8).

use super::curve::{CurvePoint, STEPS_BEFORE, mixed_sides};
use super::mlpg::{Banded, FrameState, Term};
use super::model::{SIDES, STATES, Side, Stream, WalkModel};
use super::walker::{RuntimeWalkModel, WeightsError, counted_end, least_delta_variance, side_of};
use crate::humanoid::Role;
use thiserror::Error;

/// Steps that follow the displayed pair, so that the end, which has no deltas, is not displayed.
const STEPS_AFTER: u64 = 4;
/// Least and greatest factor of a variance.
pub const VARIANCE_FACTOR: [f64; 2] = [0.001, 1000.0];
/// Greatest absolute value of ρ of the durations, 1 / frames.
pub const MAX_RHO: f32 = 10.0;

/// Error of a trajectory's parameters.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum PathError {
    /// A weight is invalid.
    #[error(transparent)]
    Weights(#[from] WeightsError),
    /// The axis is out of range; a joint has three.
    #[error("there is no axis {0}; 0 to 2 were expected")]
    Axis(usize),
    /// A factor of a variance is NaN or out of range.
    #[error(
        "a factor of a variance is {0}; a number from {least} to {greatest} was expected",
        least = VARIANCE_FACTOR[0],
        greatest = VARIANCE_FACTOR[1]
    )]
    Variance(f64),
    /// A ρ is NaN or out of range.
    #[error("ρ is {0}; a number between -{MAX_RHO} and {MAX_RHO} was expected")]
    Rho(f32),
}

/// Adjustable parameters of a trajectory.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathOptions {
    /// Factors of the variances of poses, velocities and accelerations, σ², σ′² and σ″²: [`VARIANCE_FACTOR`].
    pub variance: [f64; 3],
    /// ρ of the durations of left steps and of right ones, d = d̄ + ρν with ν the variance: within [`MAX_RHO`].
    pub rho: [f32; SIDES],
}

impl Default for PathOptions {
    fn default() -> Self {
        Self { variance: [1.0; 3], rho: [0.0; SIDES] }
    }
}

/// The trajectory of one degree of freedom over a left step and a right one: the most likely one of a walk of whole steps, in
/// double precision, without the limits of joints. A [`super::Walker`] approximates it with [`super::HORIZON`] frames of
/// look-ahead.
#[derive(Clone, Debug, PartialEq)]
pub struct JointPath {
    /// One point per frame; the deviations are scaled by the options.
    pub points: Vec<CurvePoint>,
    /// Unrounded durations of the states of a left step and of a right one, frames.
    pub durations: [[f32; STATES]; SIDES],
}

impl JointPath {
    /// Computes the trajectory about an axis of the joint's own frame, 0 to 2, for one mixture of styles in left steps and
    /// one in right steps, with one weight per style.
    ///
    /// # Errors
    /// See [`PathError`].
    pub fn new(
        model: &WalkModel,
        runtime: &RuntimeWalkModel,
        weights: [&[f32]; SIDES],
        (joint, axis): (Role, usize),
        options: PathOptions,
    ) -> Result<Self, PathError> {
        weights.iter().try_for_each(|weights| runtime.check(weights))?;
        if axis > 2 {
            return Err(PathError::Axis(axis));
        }
        let [least, greatest] = VARIANCE_FACTOR;
        if let Some(bad) = options.variance.into_iter().find(|factor| !(least..=greatest).contains(factor)) {
            return Err(PathError::Variance(bad));
        }
        if let Some(bad) = options.rho.into_iter().find(|rho| !(-MAX_RHO..=MAX_RHO).contains(rho)) {
            return Err(PathError::Rho(bad));
        }

        let d = 3 * joint.index() + axis;
        let mixed = mixed_sides(model, &model.average(), weights);
        let least_delta = least_delta_variance(model, d);
        let variance = |side: usize, state: usize, part: Stream| {
            let least = if part == Stream::Static { 0.0 } else { least_delta };
            let own = model.variances[side][state][part as usize][d].max(least);
            // A degree of freedom without variance gets variance 1.
            options.variance[part as usize] * if own > 0.0 { own } else { 1.0 }
        };
        let term = |side: usize, state: usize, part: Stream| Term {
            mean: mixed[side].means[side][state][part as usize][d],
            weight: 1.0 / variance(side, state, part),
        };

        let durations = [Side::Left, Side::Right]
            .map(|side| runtime.stretched_durations(weights[side as usize], side, options.rho[side as usize]));
        let (states, pair) = states_of_steps(&durations);
        let mut system = Banded::default();
        let trajectory = system.through(&states, term);
        let points = pair.map(|t| {
            let (side, state) = states[t];
            CurvePoint {
                angle: trajectory[t] as f32,
                mean: term(side, state, Stream::Static).mean as f32,
                deviation: variance(side, state, Stream::Static).sqrt() as f32,
                side: [Side::Left, Side::Right][side],
                state,
            }
        });
        Ok(Self { points: points.collect(), durations })
    }
}

/// The states of the frames of all steps, and the frames of the displayed pair.
fn states_of_steps(durations: &[[f32; STATES]; SIDES]) -> (Vec<FrameState>, std::ops::Range<usize>) {
    let shown = STEPS_BEFORE..STEPS_BEFORE + SIDES as u64;
    let (mut states, mut pair) = (Vec::new(), 0..0);
    let mut reckoned = 0.0;
    for step in 0..shown.end + STEPS_AFTER {
        if step == shown.start {
            pair = states.len()..states.len();
        }
        let side = side_of(step) as usize;
        for (state, duration) in durations[side].iter().enumerate() {
            reckoned += f64::from(*duration);
            let end = counted_end(states.len() as u64, reckoned);
            states.resize(end as usize, (side, state));
        }
        if step + 1 == shown.end {
            pair.end = states.len();
        }
    }
    (states, pair)
}
