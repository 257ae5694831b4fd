//! Training by expectation maximisation, the baseline of the SOMN (`docs/methods/somn.md` §5).

use super::learning::mean_of;
use super::mixture::{Component, FIRST_VARIANCE, LEAST_RESPONSIBILITY, MAX_AXES, Samples, settle, squared_distance};
use super::pose_space::{DIMS, Row};
use crate::math::linear::Factors;
use crate::math::random::SplitMix64;

/// Rounds of k-means before the first EM round.
const CLUSTER_ROUNDS: usize = 10;
/// Added to the sum of weights, so that a component without poses still has a map.
const LEAST_SUM: f64 = 1e-6;
/// Largest size of `v = [u; 1]`.
const MAX_INPUTS: usize = MAX_AXES + 1;

/// The mixture during estimation.
#[derive(Clone, Debug)]
pub(super) struct EmTrainer {
    pub(super) components: Vec<Component>,
    pub(super) variance: f64,
    ridge: f64,
}

impl EmTrainer {
    /// Starts from the clusters of poses that k-means finds.
    pub(super) fn new(samples: &Samples, components: usize, ridge: f64, seed: u64) -> Self {
        let clusters = clusters(&samples.rows, components, seed);
        let mut sums = vec![Sums::default(); components];
        for ((x, u), cluster) in samples.rows.iter().zip(&samples.styles).zip(&clusters) {
            sums[*cluster].add(1.0, x, u, samples.axes);
        }
        let begin = Component {
            slopes: [[0.0; DIMS]; MAX_AXES],
            mean: mean_of(&samples.rows),
            weight: 1.0 / components as f64,
            centre: [0.0; MAX_AXES],
            spread: std::array::from_fn(|i| std::array::from_fn(|j| f64::from(u8::from(i == j)))),
        };
        let mut em = Self { components: vec![begin; components], variance: FIRST_VARIANCE, ridge };
        em.maximise(&sums, samples);
        em
    }

    /// Runs one EM round; returns the mean squared prediction error of the poses before the update.
    pub(super) fn round(&mut self, samples: &Samples) -> f64 {
        let mut sums = vec![Sums::default(); self.components.len()];
        self.variance = settle(samples, &mut self.components, self.variance, |i, responsibilities| {
            for (r, sums) in responsibilities.iter().zip(&mut sums) {
                if *r > LEAST_RESPONSIBILITY {
                    sums.add(*r, &samples.rows[i], &samples.styles[i], samples.axes);
                }
            }
        });
        self.maximise(&sums, samples);
        self.variance * DIMS as f64
    }

    /// Weighted ridge regression of every component.
    fn maximise(&mut self, sums: &[Sums], samples: &Samples) {
        let ridge = self.ridge * samples.rows.len() as f64 / self.components.len() as f64;
        for (component, sums) in self.components.iter_mut().zip(sums) {
            sums.regress(component, ridge, samples.axes);
        }
    }
}

/// Weighted sums over poses: `Σ r v vᵀ` and `Σ r v xᵀ`.
#[derive(Clone, Debug)]
struct Sums {
    inputs: [[f64; MAX_INPUTS]; MAX_INPUTS],
    outputs: [Row; MAX_INPUTS],
}

impl Default for Sums {
    fn default() -> Self {
        Self { inputs: [[0.0; MAX_INPUTS]; MAX_INPUTS], outputs: [[0.0; DIMS]; MAX_INPUTS] }
    }
}

/// `[1; u]`.
fn inputs(u: &[f64; MAX_AXES]) -> [f64; MAX_INPUTS] {
    std::array::from_fn(|i| if i == 0 { 1.0 } else { u[i - 1] })
}

impl Sums {
    fn add(&mut self, weight: f64, x: &Row, u: &[f64; MAX_AXES], axes: usize) {
        let v = inputs(u);
        for i in 0..=axes {
            for j in 0..=axes {
                self.inputs[i][j] += weight * v[i] * v[j];
            }
            self.outputs[i].iter_mut().zip(x).for_each(|(sum, x)| *sum += weight * v[i] * x);
        }
    }

    fn regress(&self, component: &mut Component, ridge: f64, axes: usize) {
        let count = axes + 1;
        let mut matrix = [0.0; MAX_INPUTS * MAX_INPUTS];
        for i in 0..count {
            let diagonal = if i == 0 { LEAST_SUM } else { ridge + LEAST_SUM };
            for j in 0..count {
                matrix[i * count + j] = self.inputs[i][j] + if i == j { diagonal } else { 0.0 };
            }
        }
        let Some(factors) = Factors::of(&mut matrix, count) else { return };
        for d in 0..DIMS {
            let mut right: [f64; MAX_INPUTS] = std::array::from_fn(|i| self.outputs[i][d]);
            factors.solve(&mut right);
            component.mean[d] = right[0];
            component.slopes.iter_mut().zip(&right[1..count]).for_each(|(slope, w)| slope[d] = *w);
        }
    }
}

/// The cluster of every pose, by k-means.
fn clusters(rows: &[Row], count: usize, seed: u64) -> Vec<usize> {
    let mut random = SplitMix64::new(seed);
    let mut order: Vec<usize> = (0..rows.len()).collect();
    random.shuffle(&mut order);
    let mut centres: Vec<Row> = order.iter().cycle().take(count).map(|&i| rows[i]).collect();
    let nearest = |centres: &[Row], x: &Row| {
        let distances = centres.iter().map(|c| squared_distance(c, x)).enumerate();
        distances.reduce(|a, b| if b.1 < a.1 { b } else { a }).map_or(0, |(i, _)| i)
    };
    for _ in 0..CLUSTER_ROUNDS {
        let of: Vec<usize> = rows.iter().map(|x| nearest(&centres, x)).collect();
        for (c, centre) in centres.iter_mut().enumerate() {
            let members: Vec<Row> = rows.iter().zip(&of).filter(|(_, of)| **of == c).map(|(x, _)| *x).collect();
            if !members.is_empty() {
                *centre = mean_of(&members);
            }
        }
    }
    rows.iter().map(|x| nearest(&centres, x)).collect()
}
