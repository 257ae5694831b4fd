//! Synthesis of a pose from a style (`docs/methods/somn.md` §7).

use super::flight::Flight;
use super::frame::Frame;
use super::mixture::{Gate, Style, softmax};
use super::model::KeyStyleModel;
use super::pose_space::{DIMS, Row};
use super::recorded_styles::RecordedStyles;
use crate::humanoid::Pose;
use std::sync::Arc;
use thiserror::Error;

/// Largest distance of a style from the recorded ones, in standard deviations: poses beyond it soon become implausible.
const FARTHEST_FROM_RECORDED: f64 = 0.5;

/// Weighting of the components. Numbers outside [`TEMPERATURE`] and [`BLUR`] are clamped.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mode {
    /// Only the most likely component: Algorithm 1 of the paper, with the regions of styles instead of the components'
    /// shares, with which one component would be used for all styles. Poses jump where regions meet.
    Hard,
    /// All components, by their likelihood to the power of 1 / `temperature`.
    Smooth {
        /// 1 is the mixture as learnt; 2 is half as steep.
        temperature: f64,
        /// Blur of the regions, in standard deviations of the style; 0 leaves them as learnt.
        blur: f64,
    },
}

/// Range of [`Mode::Smooth`]'s temperature, and of its blur.
pub const TEMPERATURE: [f64; 2] = [0.1, 100.0];
/// See [`TEMPERATURE`].
pub const BLUR: [f64; 2] = [0.0, 10.0];

/// A number of a [`Mode`] that is out of range.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error("the {what} is {found}; a number from {least} to {greatest} was expected")]
pub struct ModeError {
    what: &'static str,
    found: f64,
    least: f64,
    greatest: f64,
}

impl Mode {
    /// [`Mode::Smooth`] within [`TEMPERATURE`] and [`BLUR`].
    ///
    /// # Errors
    /// See [`ModeError`].
    pub fn smooth(temperature: f64, blur: f64) -> Result<Self, ModeError> {
        for (what, found, [least, greatest]) in [("temperature", temperature, TEMPERATURE), ("blur", blur, BLUR)] {
            if !(least..=greatest).contains(&found) {
                return Err(ModeError { what, found, least, greatest });
            }
        }
        Ok(Self::Smooth { temperature, blur })
    }

    /// Mode for motions by keys, which pass between regions at the speed of real motion: with more blur they would appear to
    /// float.
    pub const KEYED: Self = Self::Smooth { temperature: 2.0, blur: 0.0 };
}

impl Default for Mode {
    /// Mode for a style that is dragged. Blur halves the abruptness of pose changes at the same error; temperature alone
    /// leaves narrow regions narrow.
    fn default() -> Self {
        Self::Smooth { temperature: 2.0, blur: 0.3 }
    }
}

/// Synthesis of poses from a model, without allocation.
#[derive(Clone, Debug)]
pub struct Synthesis {
    model: Arc<KeyStyleModel>,
    recorded: RecordedStyles,
    flight: Option<Flight>,
    gates: Vec<Gate>,
    /// The gates blurred by this amount.
    blurred: (f64, Vec<Gate>),
    weights: Vec<f64>,
}

impl Synthesis {
    /// Synthesis from a model; if a component's covariance is not positive definite, there are no components.
    pub fn new(model: Arc<KeyStyleModel>) -> Self {
        let gates = Gate::all(&model.components, model.axis_count()).unwrap_or_default();
        let weights = vec![0.0; gates.len()];
        Self {
            recorded: RecordedStyles::new(&model.styles),
            flight: Flight::of(&model),
            model,
            blurred: (0.0, gates.clone()),
            gates,
            weights,
        }
    }

    /// The model.
    pub fn model(&self) -> &Arc<KeyStyleModel> {
        &self.model
    }

    /// Returns the pose of a style in the axes' units, as a row.
    pub fn row(&mut self, style: &Style, mode: Mode) -> Row {
        let u = self.model.standardised(style);
        self.weigh(&u, mode);
        let (mut row, mut predicted) = ([0.0; DIMS], [0.0; DIMS]);
        for (component, weight) in self.model.components.iter().zip(&self.weights) {
            if *weight > 0.0 {
                component.predict(&u, self.model.axis_count(), &mut predicted);
                row.iter_mut().zip(&predicted).for_each(|(x, p)| *x += weight * p);
            }
        }
        row
    }

    /// Returns the pose of a style, above the origin and facing +Z.
    pub fn pose(&mut self, style: &Style, mode: Mode) -> Pose {
        let row = self.row(style, mode);
        self.pose_of(&row)
    }

    /// Converts a row to a pose above the origin, with its lowest foot on the floor or at its height in flight.
    pub fn pose_of(&self, row: &Row) -> Pose {
        let mut pose = self.model.space.pose(row);
        pose.root.y += self.flight_of(row, &pose);
        pose
    }

    /// Height of the lowest foot above the ground in a row, metres, by the row's pose on the floor: 0 if a foot is planted,
    /// or if the recordings have no flight phases.
    pub(super) fn flight_of(&self, row: &Row, standing: &Pose) -> f32 {
        self.flight.map_or(0.0, |flight| flight.height(row, standing))
    }

    /// Mean angle between the joints of the recorded poses and of the poses synthesised from their styles, degrees; NaN
    /// without recordings.
    pub fn recorded_error(&mut self, mode: Mode) -> f64 {
        let model = Arc::clone(&self.model);
        let frames = model.styles.len().min(model.rows.len());
        let error = |frame: usize| {
            let row = self.row(&model.in_units(&model.styles[frame]), mode);
            model.space.mean_angle(&row, &model.recorded_row(frame))
        };
        (0..frames).map(error).sum::<f64>() / frames as f64
    }

    /// Weights of the components in the last row.
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// Support of a style by the recorded ones: the greatest log-likelihood of any component. Below
    /// [`KeyStyleModel::least_support`] the pose is a guess.
    pub fn support(&self, style: &Style) -> f64 {
        greatest(&self.gates, &self.model.standardised(style))
    }

    /// Returns the recorded frame whose style is nearest; `None` without recordings.
    pub fn nearest(&self, style: &Style) -> Option<usize> {
        self.recorded.nearest(&self.model.standardised(style)).map(|(_, frame)| frame)
    }

    /// Returns the style itself or, if it is more than half a standard deviation from all recorded ones, the style at that
    /// distance on the line to the nearest of them.
    pub fn within_reach(&self, style: &Style) -> Style {
        let u = self.model.standardised(style);
        let is_beyond = |square: f64| square.sqrt() > FARTHEST_FROM_RECORDED;
        // Usually the bound is enough, which costs less than the nearest style.
        let nearest =
            self.recorded.bound(&u).filter(|square| is_beyond(*square)).and_then(|_| self.recorded.nearest(&u));
        let Some((square, frame)) = nearest.filter(|(square, _)| is_beyond(*square)) else {
            return self.model.in_units(&u);
        };
        let (nearest, distance) = (self.model.styles[frame], square.sqrt());
        let share = FARTHEST_FROM_RECORDED / distance;
        self.model.in_units(&std::array::from_fn(|j| nearest[j] + share * (u[j] - nearest[j])))
    }

    /// Values of the axes' measures for a pose that faces +Z; 0 beyond the axes, NaN if a measure needs more than a pose.
    pub fn measured(&self, pose: &Pose) -> Style {
        let frame = Frame::new(&self.model.space.proportions, pose, f32::NAN);
        std::array::from_fn(|j| self.model.axes.get(j).map_or(0.0, |axis| axis.measure(&frame)))
    }

    fn weigh(&mut self, u: &Style, mode: Mode) {
        match mode {
            Mode::Hard => {
                let winner = winner(&self.gates, u);
                self.weights.iter_mut().enumerate().for_each(|(i, w)| *w = f64::from(u8::from(i == winner)));
            }
            Mode::Smooth { temperature, blur } => {
                // Clamps to the ranges; NaN becomes the minimum.
                let [temperature, blur] = [(temperature, TEMPERATURE), (blur, BLUR)]
                    .map(|(of, [least, greatest])| of.max(least).min(greatest));
                self.blur(blur);
                self.weights.iter_mut().zip(&self.blurred.1).for_each(|(w, gate)| *w = gate.log(u) / temperature);
                softmax(&mut self.weights);
            }
        }
    }

    /// Computes the blurred regions.
    fn blur(&mut self, blur: f64) {
        if self.blurred.0 == blur {
            return;
        }
        self.blurred.0 = blur;
        let axes = self.model.axis_count();
        for (gate, component) in self.blurred.1.iter_mut().zip(&self.model.components) {
            if let Some(blurred) = Gate::new(component, axes, blur * blur) {
                *gate = blurred;
            }
        }
    }
}

/// The most likely component for a standardised style.
fn winner(gates: &[Gate], u: &Style) -> usize {
    let likelihoods = gates.iter().map(|gate| gate.log(u)).enumerate();
    likelihoods.reduce(|a, b| if b.1 > a.1 { b } else { a }).map_or(0, |(i, _)| i)
}

/// The greatest log-likelihood of a standardised style.
pub(super) fn greatest(gates: &[Gate], u: &Style) -> f64 {
    gates.iter().map(|gate| gate.log(u)).fold(f64::NEG_INFINITY, f64::max)
}
