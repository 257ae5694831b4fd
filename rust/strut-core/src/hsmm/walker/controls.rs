//! User controls of a [`Walker`].

use super::Walker;
use super::planner::{Start, Tempo, Transition, Weights};
use super::runtime_model::RuntimeWalkModel;
use crate::hsmm::RATE_HZ;
use crate::hsmm::model::SIDES;
use thiserror::Error;

/// Greatest turn per step, radians: the foot rotates on the ground by the same angle.
pub const MAX_TURN: f32 = 0.18;
/// Least and greatest duration of a step, frames.
pub const STEP_FRAMES: [f32; 2] = [8.0, 45.0];
/// Least and greatest length of a step, as shares of the style's.
pub const STRIDE: [f32; 2] = [0.6, 1.3];
/// Greatest absolute weight of a style.
pub const MAX_WEIGHT: f32 = 5.0;

/// Greatest number of planned changes of style.
pub const MAX_TRANSITIONS: usize = 1000;

/// Error of style weights.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum WeightsError {
    /// The number of weights differs from that of the styles.
    #[error("{found} weights were given for {styles} styles")]
    Count {
        /// Number of weights given.
        found: usize,
        /// Number of styles of the model.
        styles: usize,
    },
    /// A weight is NaN or out of range.
    #[error("a weight is {0}; a number between -{MAX_WEIGHT} and {MAX_WEIGHT} was expected")]
    Range(f32),
    /// [`MAX_TRANSITIONS`] changes are planned already.
    #[error("{MAX_TRANSITIONS} style changes are already planned; no more are supported")]
    Transitions,
}

impl Walker {
    /// Sets the styles of both feet's steps from the next frame on; the remainder of the weights to a sum of 1 belongs to the
    /// average. Planned transitions are discarded.
    ///
    /// # Errors
    /// See [`WeightsError`]; the weights are then unchanged.
    pub fn set_styles(&mut self, weights: &[f32]) -> Result<(), WeightsError> {
        self.set_sides([weights; SIDES])
    }

    /// [`Walker::set_styles`] with separate weights for the steps of the left and of the right foot.
    ///
    /// # Errors
    /// See [`WeightsError`]; the weights are then unchanged.
    pub fn set_sides(&mut self, weights: [&[f32]; SIDES]) -> Result<(), WeightsError> {
        weights.iter().try_for_each(|w| self.runtime.check(w))?;
        for (own, new) in self.planner.weights.0.iter_mut().zip(weights) {
            own.copy_from_slice(new);
        }
        self.planner.transitions.clear();
        self.planner.forget();
        Ok(())
    }

    /// Plans a change of styles from a future step on, over `between` steps; 0 is an abrupt change. The weights are those of
    /// the steps of the left foot and of the right.
    ///
    /// # Errors
    /// See [`WeightsError`]; nothing changes then.
    pub fn plan_transition(&mut self, step: u64, between: u32, weights: [&[f32]; SIDES]) -> Result<(), WeightsError> {
        weights.iter().try_for_each(|w| self.runtime.check(w))?;
        if self.planner.transitions.len() >= MAX_TRANSITIONS {
            return Err(WeightsError::Transitions);
        }
        let to = Weights(weights.map(<[f32]>::to_vec));
        let transitions = &mut self.planner.transitions;
        let at = transitions.partition_point(|t| t.first <= step);
        transitions.insert(at, Transition { first: step, steps: between, to });
        self.planner.forget();
        Ok(())
    }

    /// Sets the steps per minute, clamped to [`STEP_FRAMES`]; `None` uses the style's cadence. Setting the present cadence
    /// again keeps its beat.
    pub fn set_cadence(&mut self, steps_per_minute: Option<f32>) {
        let frames = steps_per_minute.and_then(frames_of);
        if frames != self.planner.tempo.map(|tempo| tempo.frames) {
            self.planner.tempo = frames.map(|frames| Tempo { frames, beat: None });
            self.planner.forget();
        }
    }

    /// [`Walker::set_cadence`] with steps that end on a beat: one beat is `secs` after the last frame, or before it if
    /// negative. Until they reach the beat, steps are at most 15% longer or shorter.
    pub fn set_beat(&mut self, steps_per_minute: f32, secs: f32) {
        let last = self.frame.saturating_sub(1) as f64;
        let beat = Some(last + f64::from(secs * RATE_HZ)).filter(|beat| beat.is_finite());
        self.planner.tempo = frames_of(steps_per_minute).map(|frames| Tempo { frames, beat });
        self.planner.forget();
    }

    /// Sets the seed of random variation of the state durations; `None` gives every step of a style the same durations.
    pub fn set_variation(&mut self, seed: Option<u32>) {
        self.planner.seed = seed;
        self.planner.forget();
    }

    /// Sets the turn per step, radians to the left; at most [`MAX_TURN`] either way.
    pub fn set_turn(&mut self, turn: f32) {
        self.turn = if turn.is_finite() { turn.clamp(-MAX_TURN, MAX_TURN) } else { 0.0 };
    }

    /// Sets the length of steps as a share of the style's, clamped to [`STRIDE`]; the swing of the legs is scaled about as
    /// much.
    pub fn set_stride(&mut self, share: f32) {
        self.planner.stride = if share.is_finite() { share.clamp(STRIDE[0], STRIDE[1]) } else { 1.0 };
        self.planner.forget();
    }

    /// Starts or stops walking from the next frame on. Either takes two steps, in which the swing of the joints about their
    /// standing pose grows or fades. There are no recordings of starting or stopping to learn from.
    pub fn set_walking(&mut self, walks: bool) {
        let (step, state) = (self.position.step, self.position.state);
        let to = f32::from(u8::from(walks));
        let start = &mut self.planner.start;
        if to != start.to {
            *start = Start { first: step, from: start.share(step, state), to };
            self.planner.forget();
        }
    }

    /// Sets whether joints and the durations of steps and states are limited to the range of the recorded walks, and step
    /// lengths are corrected to those of the mixture of styles; on by default.
    pub fn set_limits(&mut self, limits: bool) {
        self.planner.limits = limits;
        self.planner.forget();
    }
}

impl RuntimeWalkModel {
    /// Checks the weights of the model's styles.
    pub(in crate::hsmm) fn check(&self, weights: &[f32]) -> Result<(), WeightsError> {
        let styles = self.styles.len();
        if weights.len() != styles {
            return Err(WeightsError::Count { found: weights.len(), styles });
        }
        let bad = weights.iter().find(|w| w.is_nan() || w.abs() > MAX_WEIGHT);
        bad.map_or(Ok(()), |w| Err(WeightsError::Range(*w)))
    }
}

/// Converts a cadence to frames per step.
fn frames_of(steps_per_minute: f32) -> Option<f32> {
    let can_be = steps_per_minute.is_finite() && steps_per_minute > 0.0;
    can_be.then(|| (60.0 * RATE_HZ / steps_per_minute).clamp(STEP_FRAMES[0], STEP_FRAMES[1]))
}
