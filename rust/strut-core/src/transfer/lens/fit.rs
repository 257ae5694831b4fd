//! Line fitted to one degree of freedom (Eq. 2), with its own settings.

use super::error::{LensError, among};
use super::{Lens, QueryChange, WeightedNeighbour};
use crate::catalogue::{ExampleRows, Rows};
use crate::math::float_funcs::{cos, ln};
use crate::math::lanes::{Lane, WIDTH};
use crate::math::random::SplitMix64;
use crate::pose_vector::{DOFS, PoseRow};
use crate::search::Neighbour;
use crate::transfer::bias::{Bias, deviation};
use crate::transfer::options::{MAX_K, Options};
use crate::transfer::regression::{Gathered, InputMoments, LaneMoments, Regressors, Samples, interpolate};
use std::f32::consts::TAU;

/// Examples to which a line is fitted, and parameters of the fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FitSettings {
    /// Index of the degree of freedom among [`DOFS`].
    pub dof: usize,
    /// K, 1 to [`MAX_K`].
    pub k: usize,
    /// λ ≥ 0.
    pub lambda: f32,
    /// Standard deviation ν of noise that is added to the targets, in the unit of the degree of freedom. The noise
    /// depends on the row only: every fit has the same.
    pub noise: f32,
    /// Whether the weight of neighbours decreases with their distance, as with [`Options::coherence`]; otherwise it is
    /// 1 as in the paper.
    pub taper: bool,
}

impl FitSettings {
    pub(super) fn validate(&self) -> Result<(), LensError> {
        among("degree of freedom", self.dof, DOFS)?;
        let number = |what, value: f32, expected, fits| {
            if fits { Ok(()) } else { Err(LensError::OutOfRange { what, value, expected }) }
        };
        number("K", self.k as f32, "1 to 1000", (1..=MAX_K).contains(&self.k))?;
        number("λ", self.lambda, "0 or more", self.lambda.is_finite() && self.lambda >= 0.0)?;
        number("the noise", self.noise, "0 or more", self.noise.is_finite() && self.noise >= 0.0)
    }

    /// Lane of the degree of freedom, and its index in the lane.
    fn lane(&self) -> (usize, usize) {
        (self.dof / WIDTH, self.dof % WIDTH)
    }
}

/// A fitted line and its examples. Rotations are in radians, lengths in metres, rates per second.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// Class of the examples.
    pub class: usize,
    /// The neighbours, nearest first.
    pub rows: Vec<usize>,
    /// xₜ of each.
    pub x: Vec<f32>,
    /// xₜ₋₁ of each.
    pub x_previous: Vec<f32>,
    /// yₜ of each.
    pub y: Vec<f32>,
    /// yₜ₋₁ of each.
    pub y_previous: Vec<f32>,
    /// v, their weights.
    pub weights: Vec<f32>,
    /// β for xₜ₋₁, yₜ₋₁ and xₜ: a, b and c.
    pub beta: [f32; 3],
    /// The same three regressors of the query.
    pub query: [f32; 3],
    /// Weighted means of xₜ₋₁, yₜ₋₁, xₜ and yₜ.
    pub means: [f32; 4],
    /// Standard deviation σ of the neighbours' xₜ, with the floors of the bias.
    pub deviation: f32,
    /// σ of the degree of freedom over all rows, which scales the ridge.
    pub global_deviation: f32,
    /// Δx of Eq. 6; ρΔx is in `predicted`.
    pub bias: f32,
    /// yₜ of Eq. 7.
    pub predicted: f32,
}

impl Lens {
    /// Fits the line of one degree of freedom in the heaviest class, for the style of the greatest weight.
    ///
    /// # Errors
    /// If a setting is out of range.
    pub fn fit(&self, settings: &FitSettings) -> Result<Fit, LensError> {
        settings.validate()?;
        let class = self.heaviest_class().unwrap_or(0);
        let style = self.greatest_style();
        let neighbours =
            self.neighbours(class, settings.k, self.model().index().window_length(), &QueryChange::default())?;
        let examples = self.examples(settings, style, &neighbours, &self.now);
        let (lane, at) = settings.lane();
        let beta = examples.lane.fit(settings.lambda * examples.weight_sum, self.model().catalogue().sigma());
        let previous_output = self.outputs_before[style].unwrap_or(examples.start);
        let u = Regressors { previous_input: &self.previous, input: &self.now, previous_output: &previous_output };
        let of = |v: Lane| v.to_array()[at];
        let column = |gathered: &Gathered, side: usize| gathered.lane(lane).iter().map(|pair| of(pair[side])).collect();
        let d = settings.dof;
        let moments = &examples.moments;
        let sigma = self.model().catalogue().sigma();
        Ok(Fit {
            class,
            rows: neighbours.iter().map(|n| n.row).collect(),
            x: column(&examples.inputs, 1),
            x_previous: column(&examples.inputs, 0),
            y: column(&examples.targets, 1),
            y_previous: column(&examples.targets, 0),
            weights: examples.weights,
            beta: [beta.previous_input, beta.previous_output, beta.input].map(of),
            query: [self.previous[d], previous_output[d], self.now[d]],
            means: [
                moments.mean_previous[d],
                of(examples.lane.mean_before),
                moments.statistics.mean[d],
                of(examples.lane.mean_target),
            ],
            deviation: deviation(&moments.statistics, sigma, d),
            global_deviation: sigma[d],
            bias: examples.bias.input[d],
            predicted: of(examples.lane.predict(beta, u, &examples.bias)),
        })
    }

    /// Style of the greatest weight.
    pub fn greatest_style(&self) -> usize {
        let blend = self.stylizer.inside().blend;
        let weight = |style: &usize| blend.weight(crate::transfer::BodyPart::Legs, *style);
        let styles = 0..self.outputs_before.len();
        styles.max_by(|a, b| weight(a).total_cmp(&weight(b)).then(b.cmp(a))).unwrap_or(0)
    }

    /// Examples of a fit at an input xₜ.
    pub(super) fn examples(
        &self,
        settings: &FitSettings,
        style: usize,
        neighbours: &[WeightedNeighbour],
        input: &PoseRow,
    ) -> LaneExamples {
        let model = self.model();
        let Options { kappa, rho, .. } = *self.stylizer.options();
        let found: Vec<Neighbour> =
            neighbours.iter().map(|n| Neighbour { distance: n.square, row: n.row as u32 }).collect();
        let mut weights = Vec::new();
        if settings.taper {
            crate::transfer::coherence::taper(&found, &mut weights);
        } else {
            weights.resize(found.len(), 1.0);
        }
        let table = &*model.target_table(style);
        let targets_with_noise =
            NoisyRows { rows: ExampleRows::Targets(table), dof: settings.dof, deviation: settings.noise };
        let (mut inputs, mut targets) = (Gathered::default(), Gathered::default());
        inputs.fill(&ExampleRows::Inputs(model.rows()), &found, &weights);
        targets.fill(&targets_with_noise, &found, &weights);
        let moments = InputMoments::new(&inputs, &weights);
        let bias = Bias::new(input, &moments.statistics, model.catalogue().sigma(), kappa, rho);
        let samples = Samples { inputs: &inputs, targets: &targets, weights: &weights };
        LaneExamples {
            lane: LaneMoments::new(settings.lane().0, &moments, samples),
            start: bias.put_on(interpolate(|row| table.pose(row - 1), &found)),
            weight_sum: weights.iter().sum(),
            moments,
            bias,
            inputs,
            targets,
            weights,
        }
    }
}

/// Data from which one lane is fitted.
pub(super) struct LaneExamples {
    pub(super) inputs: Gathered,
    pub(super) targets: Gathered,
    pub(super) weights: Vec<f32>,
    pub(super) weight_sum: f32,
    pub(super) moments: InputMoments,
    pub(super) bias: Bias,
    pub(super) lane: LaneMoments,
    /// yₜ₋₁ of a style in its first frame.
    pub(super) start: PoseRow,
}

/// Rows with noise added to one degree of freedom.
struct NoisyRows<'a> {
    rows: ExampleRows<'a>,
    dof: usize,
    deviation: f32,
}

impl Rows for NoisyRows<'_> {
    fn lane(&self, row: usize, l: usize) -> Lane {
        let lane = self.rows.lane(row, l);
        if self.deviation == 0.0 || l != self.dof / WIDTH {
            return lane;
        }
        let mut values = lane.to_array();
        values[self.dof % WIDTH] += self.deviation * standard_normal(row as u64);
        Lane::of(&values, 0)
    }
}

/// Sample of the standard normal distribution for a seed (Box and Muller).
fn standard_normal(seed: u64) -> f32 {
    let mut random = SplitMix64::new(seed);
    // 24 bits, above 0.
    let mut uniform = || ((random.next_u64() >> 40) as f32 + 0.5) / (1 << 24) as f32;
    let (radius, turn) = (uniform(), uniform());
    (-2.0 * ln(radius)).sqrt() * cos(TAU * turn)
}
