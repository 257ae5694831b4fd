//! Online learning, one pose at a time, of a self-organising mixture network (Yin, Allinson, "Self-organizing mixture
//! networks for probability density estimation", 2001), with the signs and the gate of `docs/methods/somn.md` §4 and §5.

use super::mixture::{
    Component, LEAST_RESPONSIBILITY, LEAST_SPREAD, MAX_AXES, Samples, normalise_weights, softmax, squared_distance,
};
use super::pose_space::{DIMS, Row};
use crate::math::float_funcs::double;
use crate::math::random::SplitMix64;

/// Width of the neighbourhood from first to last, as a share of the poses' standard deviation.
const WIDTHS: [f64; 2] = [0.5, 0.08];
/// Learning rate from first to last.
const RATES: [f64; 2] = [0.6, 0.01];
/// Learning rate of the shares, relative to that of the rest.
const WEIGHT_RATE: f64 = 0.2;
/// Initial components lie this far from the mean pose towards a random pose.
const FIRST_SHARE: f64 = 0.1;

/// One update of the network.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Update {
    /// Index of the pose among the training poses.
    pub sample: usize,
    /// Width of the neighbourhood σ, radians: poses this far from a component's prediction still belong to it.
    pub width: f64,
    /// Learning rate δ.
    pub rate: f64,
    /// Prediction error of the poses of this pass so far, each before its update: root mean square over the numbers of a row,
    /// radians. It is not finite if learning diverges.
    pub error: f64,
}

/// The network during learning.
#[derive(Clone, Debug)]
pub(super) struct Somn {
    pub(super) components: Vec<Component>,
    /// 1 for ascent on the likelihood, -1 for the signs as printed in the paper.
    sign: f64,
    random: SplitMix64,
    order: Vec<usize>,
    deviation: f64,
    /// Number of poses seen, and their total number over all passes.
    seen: usize,
    total: usize,
    /// Residuals of the last pose from all components, and its responsibilities.
    residuals: Vec<Row>,
    responsibilities: Vec<f64>,
    /// Sum of the squared errors of this pass.
    squares: f64,
}

impl Somn {
    /// Creates the network before the first of a number of passes.
    pub(super) fn new(samples: &Samples, components: usize, passes: usize, seed: u64, as_printed: bool) -> Self {
        let mut random = SplitMix64::new(seed);
        let mut order: Vec<usize> = (0..samples.rows.len()).collect();
        random.shuffle(&mut order);
        let mean = mean_of(&samples.rows);
        let deviation = (samples.rows.iter().map(|x| squared_distance(x, &mean)).sum::<f64>()
            / samples.rows.len() as f64)
            .sqrt()
            // If all poses are alike, their mean is learnt, without a division by zero.
            .max(1e-6);
        let begin = |i: &usize| {
            let x = &samples.rows[*i];
            Component {
                slopes: [[0.0; DIMS]; MAX_AXES],
                mean: std::array::from_fn(|d| mean[d] + FIRST_SHARE * (x[d] - mean[d])),
                weight: 1.0 / components as f64,
                centre: samples.styles[*i],
                spread: std::array::from_fn(|i| std::array::from_fn(|j| f64::from(u8::from(i == j)))),
            }
        };
        let components: Vec<Component> = order.iter().cycle().take(components).map(begin).collect();
        let total = passes * samples.rows.len();
        Self {
            residuals: vec![[0.0; DIMS]; components.len()],
            responsibilities: vec![0.0; components.len()],
            components,
            sign: if as_printed { -1.0 } else { 1.0 },
            random,
            order,
            deviation,
            seen: 0,
            total,
            squares: 0.0,
        }
    }

    /// Number of updates so far.
    pub(super) fn seen(&self) -> usize {
        self.seen
    }

    /// Responsibilities of the last pose; they sum to 1, or are 0 before the first.
    pub(super) fn responsibilities(&self) -> &[f64] {
        &self.responsibilities
    }

    /// Runs one pass over all poses in random order, or the rest of a pass in progress; returns the mean squared prediction
    /// error of the poses before the update.
    pub(super) fn pass(&mut self, samples: &Samples) -> f64 {
        while self.update(samples).is_some() && !self.is_between_passes() {}
        self.squares / samples.rows.len() as f64
    }

    /// Whether no pass is in progress.
    pub(super) fn is_between_passes(&self) -> bool {
        self.seen.is_multiple_of(self.order.len())
    }

    /// Learns from the next pose in this pass's order. `None` after the last pass, and once learning has diverged.
    pub(super) fn update(&mut self, samples: &Samples) -> Option<Update> {
        if self.seen == self.total || !self.squares.is_finite() {
            return None;
        }
        let count = self.order.len();
        if self.is_between_passes() {
            self.random.shuffle(&mut self.order);
            self.squares = 0.0;
        }
        let axes = samples.axes;
        let sample = self.order[self.seen % count];
        let (x, u) = (&samples.rows[sample], &samples.styles[sample]);
        let share = self.seen as f64 / self.total as f64;
        let [width, rate] = [WIDTHS, RATES].map(|[first, last]| first * double::pow(last / first, share));
        let width = width * self.deviation;
        let variance = width * width;
        self.seen += 1;
        let Self { components, residuals, responsibilities, .. } = self;
        for ((component, residual), r) in components.iter().zip(&mut *residuals).zip(&mut *responsibilities) {
            component.predict(u, axes, residual);
            residual.iter_mut().zip(x).for_each(|(e, x)| *e = x - *e);
            *r = log_gate(component, u, axes) - squared_distance(residual, &[0.0; DIMS]) / (2.0 * variance);
        }
        softmax(responsibilities);
        for ((component, residual), r) in components.iter_mut().zip(&*residuals).zip(&*responsibilities) {
            component.weight += self.sign * WEIGHT_RATE * rate * (r - component.weight);
            if *r > LEAST_RESPONSIBILITY {
                self.squares += r * squared_distance(residual, &[0.0; DIMS]);
                component.learn(residual, u, axes, self.sign * rate * r);
                move_gate(component, u, axes, rate * r);
            }
        }
        normalise_weights(components);
        let seen = (self.seen - 1) % count + 1;
        Some(Update { sample, width, rate, error: (self.squares / (seen * DIMS) as f64).sqrt() })
    }
}

/// `log g(u)` up to a constant, by variances only, which is enough while the components still move.
fn log_gate(component: &Component, u: &[f64; MAX_AXES], axes: usize) -> f64 {
    let axis = |j: usize| {
        let (e, variance) = (u[j] - component.centre[j], component.spread[j][j]);
        e * e / variance + double::ln(variance)
    };
    double::ln(component.weight) - 0.5 * (0..axes).map(axis).sum::<f64>()
}

fn move_gate(component: &mut Component, u: &[f64; MAX_AXES], axes: usize, rate: f64) {
    for (j, u) in u[..axes].iter().enumerate() {
        let e = u - component.centre[j];
        component.centre[j] += rate * e;
        let variance = &mut component.spread[j][j];
        *variance = (*variance + rate * (e * e - *variance)).max(LEAST_SPREAD);
    }
}

/// The mean of poses; there is at least one.
pub(super) fn mean_of(rows: &[Row]) -> Row {
    let mut mean = [0.0; DIMS];
    for row in rows {
        mean.iter_mut().zip(row).for_each(|(m, x)| *m += x);
    }
    mean.map(|sum| sum / rows.len() as f64)
}
