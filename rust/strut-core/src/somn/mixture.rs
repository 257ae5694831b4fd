//! The mixture: linear maps from style to pose, each with its region of styles (`docs/methods/somn.md` §3).

use super::pose_space::{DIMS, Row};
use crate::math::float_funcs::double;
use std::f64::consts::TAU;

/// Largest number of axes of a style.
pub const MAX_AXES: usize = 3;

/// A style: one number per axis; unused axes are 0.
pub type Style = [f64; MAX_AXES];

/// Least variance of the styles of a component's region, in squared standard deviations of all styles.
pub(super) const LEAST_SPREAD: f64 = 0.02;
/// Least share of a component.
const LEAST_WEIGHT: f64 = 1e-6;
/// Responsibilities below this are ignored.
pub(super) const LEAST_RESPONSIBILITY: f64 = 1e-6;
/// Number of rounds that fit the regions to the learnt maps, the initial variance of these rounds, and the least variance.
pub(super) const SETTLING_ROUNDS: usize = 6;
pub(super) const FIRST_VARIANCE: f64 = 0.02;
const LEAST_VARIANCE: f64 = 1e-5;

/// A linear map and the region of styles where it is valid; styles are in standard deviations from their mean.
#[derive(Clone, Debug, PartialEq)]
pub struct Component {
    /// The pose's slope along each axis: `W`.
    pub slopes: [Row; MAX_AXES],
    /// The pose at the mean style: `μ`.
    pub mean: Row,
    /// Share of all poses that belong to it: `a`.
    pub weight: f64,
    /// Mean of the styles of its region: `m`.
    pub centre: Style,
    /// Their covariance: `S`.
    pub spread: [Style; MAX_AXES],
}

impl Component {
    /// Whether the covariance of its styles is valid.
    pub fn knows_a_region(&self, axes: usize) -> bool {
        Gate::new(self, axes.min(MAX_AXES), 0.0).is_some()
    }

    /// Predicts the pose of a style: `Z v`.
    pub(super) fn predict(&self, u: &Style, axes: usize, out: &mut Row) {
        *out = self.mean;
        for (slope, u) in self.slopes[..axes].iter().zip(u) {
            out.iter_mut().zip(slope).for_each(|(x, w)| *x += u * w);
        }
    }

    /// Makes a step of normalised stochastic ascent on the likelihood of a pose, given `x − Z v`:
    /// `Z += rate (x − Z v) vᵀ / vᵀv`. The paper's Eq. 8 has the opposite sign and diverges.
    pub(super) fn learn(&mut self, residual: &Row, u: &Style, axes: usize, rate: f64) {
        let rate = rate / (1.0 + u[..axes].iter().map(|u| u * u).sum::<f64>());
        self.mean.iter_mut().zip(residual).for_each(|(m, e)| *m += rate * e);
        for (slope, u) in self.slopes[..axes].iter_mut().zip(u) {
            slope.iter_mut().zip(residual).for_each(|(w, e)| *w += rate * u * e);
        }
    }
}

/// Squared distance of two poses, or of a difference from zero.
pub(super) fn squared_distance(a: &Row, b: &Row) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum()
}

/// Normalises logarithms of weights to weights that sum to 1; returns the logarithm of their sum.
pub(super) fn softmax(log_weights: &mut [f64]) -> f64 {
    let greatest = log_weights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let mut sum = 0.0;
    for w in log_weights.iter_mut() {
        *w = double::exp(*w - greatest);
        sum += *w;
    }
    for w in log_weights.iter_mut() {
        *w /= sum;
    }
    greatest + double::ln(sum)
}

/// Keeps shares positive and their sum at 1.
pub(super) fn normalise_weights(components: &mut [Component]) {
    for c in components.iter_mut() {
        c.weight = c.weight.max(LEAST_WEIGHT);
    }
    let sum: f64 = components.iter().map(|c| c.weight).sum();
    for c in components.iter_mut() {
        c.weight /= sum;
    }
}

/// A component's region of styles, prepared for evaluation: `g(u) = a N(u; m, S)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gate {
    centre: Style,
    /// The lower Cholesky factor of the covariance, with the inverse of its diagonal.
    factor: [Style; MAX_AXES],
    axes: usize,
    log_scale: f64,
}

impl Gate {
    /// Creates the gate, with a variance added to the component's own; `None` if the covariance is not positive definite.
    pub(super) fn new(component: &Component, axes: usize, more: f64) -> Option<Self> {
        let mut factor = [[0.0; MAX_AXES]; MAX_AXES];
        let mut log_scale = double::ln(component.weight) - 0.5 * axes as f64 * double::ln(TAU);
        for i in 0..axes {
            for j in 0..=i {
                let covariance = component.spread[i][j] + if i == j { more } else { 0.0 };
                let rest = covariance - (0..j).map(|k| factor[i][k] * factor[j][k]).sum::<f64>();
                factor[i][j] = if i == j { rest.sqrt() } else { rest * factor[j][j] };
            }
            let diagonal = factor[i][i];
            if !(diagonal > 0.0 && diagonal.is_finite()) {
                return None;
            }
            log_scale -= double::ln(diagonal);
            factor[i][i] = 1.0 / diagonal;
        }
        log_scale.is_finite().then_some(Self { centre: component.centre, factor, axes, log_scale })
    }

    /// Gates of all components; `None` if a covariance is invalid.
    pub fn all(components: &[Component], axes: usize) -> Option<Vec<Self>> {
        components.iter().map(|component| Self::new(component, axes, 0.0)).collect()
    }

    /// `log g(u)`.
    pub(super) fn log(&self, u: &Style) -> f64 {
        let mut solved = [0.0; MAX_AXES];
        for i in 0..self.axes {
            let known: f64 = (0..i).map(|k| self.factor[i][k] * solved[k]).sum();
            solved[i] = (u[i] - self.centre[i] - known) * self.factor[i][i];
        }
        self.log_scale - 0.5 * solved.iter().map(|s| s * s).sum::<f64>()
    }
}

/// Poses with their styles.
#[derive(Clone, Debug, Default)]
pub(super) struct Samples {
    pub(super) rows: Vec<Row>,
    pub(super) styles: Vec<Style>,
    pub(super) axes: usize,
}

/// Log-density of a pose and its style; writes the components' responsibilities.
pub(super) fn posteriors(
    (components, gates): (&[Component], &[Gate]),
    variance: f64,
    x: &Row,
    u: &Style,
    responsibilities: &mut [f64],
) -> f64 {
    let mut predicted = [0.0; DIMS];
    for ((r, component), gate) in responsibilities.iter_mut().zip(components).zip(gates) {
        component.predict(u, gate.axes, &mut predicted);
        *r = gate.log(u) - squared_distance(x, &predicted) / (2.0 * variance);
    }
    softmax(responsibilities) - 0.5 * DIMS as f64 * double::ln(TAU * variance)
}

/// Log-density of a pose given its style.
pub fn log_likelihood(mixture: (&[Component], &[Gate]), variance: f64, x: &Row, u: &Style) -> f64 {
    let mut shares = vec![0.0; mixture.0.len()];
    let joint = posteriors(mixture, variance, x, u, &mut shares);
    let mut gates: Vec<f64> = mixture.1.iter().map(|gate| gate.log(u)).collect();
    joint - softmax(&mut gates)
}

/// Runs one round: computes the responsibilities by the present maps, and from them the shares, the regions and the variance,
/// which is returned. `visit` receives every sample's responsibilities.
pub(super) fn settle(
    samples: &Samples,
    components: &mut [Component],
    variance: f64,
    mut visit: impl FnMut(usize, &[f64]),
) -> f64 {
    let axes = samples.axes;
    let Some(gates) = Gate::all(components, axes) else { return variance };
    let count = components.len();
    let mut sums = vec![Moments::default(); count];
    let mut responsibilities = vec![0.0; count];
    let mut predicted = [0.0; DIMS];
    let mut squares = 0.0;
    for (i, (x, u)) in samples.rows.iter().zip(&samples.styles).enumerate() {
        posteriors((components, &gates), variance, x, u, &mut responsibilities);
        for ((r, sums), component) in responsibilities.iter().zip(&mut sums).zip(&*components) {
            if *r > LEAST_RESPONSIBILITY {
                component.predict(u, axes, &mut predicted);
                squares += r * squared_distance(x, &predicted);
                sums.add(*r, u);
            }
        }
        visit(i, &responsibilities);
    }
    for (component, sums) in components.iter_mut().zip(&sums) {
        sums.give(component, samples.rows.len(), axes);
    }
    normalise_weights(components);
    (squares / (samples.rows.len() * DIMS) as f64).max(LEAST_VARIANCE)
}

/// Weighted sums of styles.
#[derive(Clone, Debug, Default)]
struct Moments {
    weight: f64,
    first: Style,
    second: [Style; MAX_AXES],
}

impl Moments {
    fn add(&mut self, weight: f64, u: &Style) {
        self.weight += weight;
        for i in 0..MAX_AXES {
            self.first[i] += weight * u[i];
            for j in 0..=i {
                self.second[i][j] += weight * u[i] * u[j];
            }
        }
    }

    /// Sets a component's share, mean and covariance; a component without poses keeps its region.
    fn give(&self, component: &mut Component, samples: usize, axes: usize) {
        component.weight = self.weight / samples as f64;
        if self.weight <= LEAST_RESPONSIBILITY {
            return;
        }
        component.centre = self.first.map(|sum| sum / self.weight);
        for i in 0..axes {
            for j in 0..=i {
                let covariance = self.second[i][j] / self.weight - component.centre[i] * component.centre[j];
                let least = if i == j { LEAST_SPREAD } else { 0.0 };
                (component.spread[i][j], component.spread[j][i]) = (covariance + least, covariance + least);
            }
        }
    }
}
