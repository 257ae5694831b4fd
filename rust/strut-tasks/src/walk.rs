//! Synthesis of walks with a walk model.

use crate::error::{Outcome, TaskError};
use crate::progress::{Counter, OnProgress};
use crate::weights::StyleWeights;
use std::str::FromStr;
use std::sync::Arc;
use strut_core::hsmm::{MAX_TURN, RATE_HZ, RuntimeWalkModel, SIDES, STRIDE, WalkModel, Walker};
use strut_core::humanoid::HumanoidMotion;
use strut_core::math::Vec3;
use strut_formats::quotation;

/// Greatest number of steps of a walk, over three hours.
pub const MAX_STEPS: u64 = 20_000;

/// Steps that stopping takes: two steps to stop and one of standing.
const STOPPING_STEPS: u64 = 3;

/// A change of style: `NAME[=W]@STEP:LENGTH`.
#[derive(Clone, Debug, PartialEq)]
pub struct Transition {
    /// The styles after the change.
    pub styles: StyleWeights,
    /// The step at which the change begins, from 0.
    pub step: u64,
    /// Number of steps that the change takes.
    pub between: u32,
}

impl FromStr for Transition {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let expected =
            || format!("'{}' is not a transition; NAME@STEP:LENGTH was expected, as in old@6:4", quotation(text, 40));
        let (styles, at) = text.rsplit_once('@').ok_or_else(expected)?;
        let (step, between) = at.split_once(':').ok_or_else(expected)?;
        let (step, between) = (step.trim().parse(), between.trim().parse());
        let (Ok(step), Ok(between)) = (step, between) else { return Err(expected()) };
        Ok(Self { styles: styles.parse()?, step, between })
    }
}

/// How to walk.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gait {
    /// Steps per minute; the style's own cadence if `None`.
    pub cadence: Option<f32>,
    /// Step length relative to the style's.
    pub stride: f32,
    /// Turn per step, degrees to the left.
    pub turn: f32,
    /// Whether joint rotations are limited to the range of the recorded walks.
    pub limits: bool,
}

impl Default for Gait {
    fn default() -> Self {
        Self { cadence: None, stride: 1.0, turn: 0.0, limits: true }
    }
}

impl Gait {
    /// Checks the numbers.
    ///
    /// # Errors
    /// A message about the first number that is out of range.
    pub fn check(&self) -> Outcome {
        let limit = MAX_TURN.to_degrees();
        if self.turn.is_nan() || self.turn.abs() > limit {
            let expected = format_args!("-{limit:.0} to {limit:.0} degrees were expected");
            return Err(TaskError::usage(format_args!("the turn is {}; {expected}", self.turn)));
        }
        let [shortest, longest] = STRIDE;
        if !(shortest..=longest).contains(&self.stride) {
            let expected = format_args!("{shortest} to {longest} of the style's was expected");
            return Err(TaskError::usage(format_args!("the stride is {}; {expected}", self.stride)));
        }
        match self.cadence.filter(|c| !(*c > 0.0 && c.is_finite())) {
            Some(cadence) => {
                Err(TaskError::usage(format_args!("the cadence is {cadence}; a positive number was expected")))
            }
            None => Ok(()),
        }
    }

    /// Applies the settings to a walker.
    ///
    /// # Errors
    /// Those of [`Gait::check`].
    pub fn set(&self, walker: &mut Walker) -> Outcome {
        self.check()?;
        walker.set_cadence(self.cadence);
        walker.set_turn(self.turn.to_radians());
        walker.set_stride(self.stride);
        walker.set_limits(self.limits);
        Ok(())
    }
}

/// Parameters of a walk.
#[derive(Clone, Debug)]
pub struct WalkOrder {
    /// The styles at the start.
    pub styles: StyleWeights,
    /// Number of steps, at most [`MAX_STEPS`].
    pub steps: u64,
    /// Changes of style.
    pub transitions: Vec<Transition>,
    /// How to walk.
    pub gait: Gait,
    /// Whether the walk stops at the end, within two more steps, and then stands.
    pub stop: bool,
}

/// A walk, with the foot contacts of each frame.
pub struct Walked {
    /// The motion on the model's body.
    pub motion: HumanoidMotion,
    /// Contacts of the left and the right foot.
    pub planted: Vec<[bool; 2]>,
}

impl WalkOrder {
    /// Synthesises the walk.
    ///
    /// # Errors
    /// If a number is out of range, the model lacks a style, or the caller cancels.
    pub fn walk(
        &self,
        model: &WalkModel,
        runtime: Arc<RuntimeWalkModel>,
        on_progress: &OnProgress<'_>,
    ) -> Outcome<Walked> {
        self.gait.check()?;
        if !(1..=MAX_STEPS).contains(&self.steps) {
            return Err(TaskError::usage(format_args!(
                "there are {} steps; 1 to {MAX_STEPS} were expected",
                self.steps
            )));
        }
        let weights = |styles: &StyleWeights| styles.of_walks(&model.styles).map_err(TaskError::new);
        let mut walker = Walker::new(runtime);
        walker.set_styles(&weights(&self.styles)?).map_err(TaskError::new)?;
        for Transition { styles, step, between } in &self.transitions {
            let weights = weights(styles)?;
            walker.plan_transition(*step, *between, [&weights; SIDES]).map_err(TaskError::new)?;
        }
        self.gait.set(&mut walker)?;
        // Reset, so that the walk begins with these settings.
        walker.reset(Vec3::ZERO, 0.0);
        let last = self.steps + if self.stop { STOPPING_STEPS } else { 0 };
        let counter = Counter::new("walking", last as usize, on_progress);
        let (mut poses, mut planted) = (Vec::new(), Vec::new());
        let mut walk = |walker: &mut Walker, until: u64| -> Outcome {
            while walker.next_step() < until {
                let before = walker.next_step();
                poses.push(*walker.advance());
                planted.push(walker.planted());
                if walker.next_step() > before {
                    counter.step()?;
                }
            }
            Ok(())
        };
        walk(&mut walker, self.steps)?;
        if self.stop {
            walker.set_walking(false);
            walk(&mut walker, last)?;
        }
        Ok(Walked { motion: HumanoidMotion { proportions: model.proportions, rate_hz: RATE_HZ, poses }, planted })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_show_the_beginning_of_what_is_long() {
        for text in ["x".repeat(5000), format!("old@{}:4", "9".repeat(5000)), format!("{0},{0}@6:4", "x".repeat(5000))]
        {
            let refused = text.parse::<Transition>().unwrap_err();
            assert!(refused.chars().count() < 200, "{} characters", refused.chars().count());
        }
    }
}
