//! Local autoregression of one class: Eq. 2 and the specification, §6.
//!
//! Each degree of freedom is predicted on its own as yₜ = uᵀβ with u = [xₜ₋₁, yₜ₋₁, xₜ, 1], β fitted
//! by ridge to the class's neighbours. Everything runs over whole rows, so that the compiler works on
//! several degrees of freedom at once, and sums over neighbours in their order.

use super::bias::{Bias, InputStatistics};
use crate::pose_vector::{PoseRow, ROW};
use crate::search::Neighbour;

/// Greatest weight of the previous output: more feeds errors back faster than they die out.
pub const MAX_FEEDBACK: f32 = 0.9;

/// Sums over the neighbours of products of the centred inputs xₜ₋₁ (`p`) and xₜ (`c`): the part of the
/// normal equations that all target styles share.
#[derive(Clone, Debug)]
pub(super) struct InputMoments {
    pub(super) mean_previous: PoseRow,
    pub(super) statistics: InputStatistics,
    pp: PoseRow,
    pc: PoseRow,
    cc: PoseRow,
}

impl InputMoments {
    /// Of the database rows at the neighbours, as far as each counts, and just before them.
    pub(super) fn new(rows: &[PoseRow], neighbours: &[Neighbour], weights: &[f32]) -> Self {
        let mean_previous = mean(rows, neighbours, weights, 1);
        let mean_current = mean(rows, neighbours, weights, 0);
        let (mut pp, mut pc, mut cc) = ([0.0; ROW], [0.0; ROW], [0.0; ROW]);
        for (n, &w) in neighbours.iter().zip(weights) {
            let (previous, current) = (&rows[n.row as usize - 1], &rows[n.row as usize]);
            for d in 0..ROW {
                let p = previous[d] - mean_previous[d];
                let c = current[d] - mean_current[d];
                let (wp, wc) = (w * p, w * c);
                pp[d] += wp * p;
                pc[d] += wp * c;
                cc[d] += wc * c;
            }
        }
        let count = weights.iter().sum::<f32>().max(f32::MIN_POSITIVE);
        let statistics = InputStatistics { mean: mean_current, deviation: cc.map(|v| (v / count).sqrt()) };
        Self { mean_previous, statistics, pp, pc, cc }
    }

    /// Mean change of the neighbours' inputs from t−1 to t.
    pub(super) fn input_step(&self) -> PoseRow {
        std::array::from_fn(|d| self.statistics.mean[d] - self.mean_previous[d])
    }
}

/// The registered examples of a class for one style: rows are looked up at the neighbours and just before.
#[derive(Clone, Copy, Debug)]
pub(super) struct Samples<'a> {
    /// All rows of the database: x.
    pub(super) inputs: &'a [PoseRow],
    /// What they become in the style: y.
    pub(super) targets: &'a [PoseRow],
    /// Which of them count. Their rows are never the first of a clip.
    pub(super) neighbours: &'a [Neighbour],
    /// How much each of them counts: 0 to 1, not all 0.
    pub(super) weights: &'a [f32],
}

/// What is known when a frame is predicted.
#[derive(Clone, Copy, Debug)]
pub(super) struct Regressors<'a> {
    /// xₜ₋₁.
    pub(super) previous_input: &'a PoseRow,
    /// xₜ.
    pub(super) input: &'a PoseRow,
    /// yₜ₋₁.
    pub(super) previous_output: &'a PoseRow,
}

/// What the regression gives.
#[derive(Clone, Debug)]
pub(super) struct Prediction {
    /// yₜ.
    pub(super) output: PoseRow,
    /// Mean change of the neighbours' targets from t−1 to t.
    pub(super) target_step: PoseRow,
}

/// Predicts yₜ of one style from the registered target rows of the neighbours.
///
/// `ridge` is λ·K (the sum of the weights stands for K) in squared standard deviations; `sigma` the global standard
/// deviation of each degree of freedom. The bias is taken off the regressors and its share ρ put back on the result (Eq. 6–7).
pub(super) fn predict(
    u: Regressors<'_>,
    moments: &InputMoments,
    samples: Samples<'_>,
    ridge: f32,
    sigma: &PoseRow,
    bias: &Bias,
) -> Prediction {
    let Samples { inputs, targets, neighbours, weights } = samples;
    let mean_before = mean(targets, neighbours, weights, 1);
    let mean_target = mean(targets, neighbours, weights, 0);
    // Products with the previous target (`b`) and with the target (`t`).
    let (mut pb, mut cb, mut bb) = ([0.0; ROW], [0.0; ROW], [0.0; ROW]);
    let (mut pt, mut ct, mut bt) = ([0.0; ROW], [0.0; ROW], [0.0; ROW]);
    for (n, &w) in neighbours.iter().zip(weights) {
        let at = n.row as usize;
        let (x0, x1, y0, y1) = (&inputs[at - 1], &inputs[at], &targets[at - 1], &targets[at]);
        for d in 0..ROW {
            let p = x0[d] - moments.mean_previous[d];
            let c = x1[d] - moments.statistics.mean[d];
            let b = y0[d] - mean_before[d];
            let t = y1[d] - mean_target[d];
            let (wb, t) = (w * b, w * t);
            pb[d] += p * wb;
            cb[d] += c * wb;
            bb[d] += b * wb;
            pt[d] += p * t;
            ct[d] += c * t;
            bt[d] += b * t;
        }
    }
    let mut output = [0.0; ROW];
    for d in 0..ROW {
        let ridge = ridge * sigma[d] * sigma[d];
        let gram = Gram {
            pp: moments.pp[d] + ridge,
            pc: moments.pc[d],
            cc: moments.cc[d] + ridge,
            pb: pb[d],
            cb: cb[d],
            bb: bb[d] + ridge,
        };
        let beta = gram.solve([pt[d], ct[d], bt[d]]);
        output[d] = mean_target[d]
            + beta.previous_input * (u.previous_input[d] - bias.input[d] - moments.mean_previous[d])
            + beta.input * (u.input[d] - bias.input[d] - moments.statistics.mean[d])
            + beta.previous_output * (u.previous_output[d] - bias.output[d] - mean_before[d])
            + bias.output[d];
    }
    Prediction { output, target_step: std::array::from_fn(|d| mean_target[d] - mean_before[d]) }
}

/// Normal equations of one degree of freedom, ridge included: regressors p = xₜ₋₁, c = xₜ, b = yₜ₋₁.
#[derive(Clone, Copy, Debug)]
struct Gram {
    pp: f32,
    pc: f32,
    cc: f32,
    pb: f32,
    cb: f32,
    bb: f32,
}

/// Weights of the regressors.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Beta {
    previous_input: f32,
    input: f32,
    previous_output: f32,
}

impl Gram {
    /// Solves for the right-hand side [p·t, c·t, b·t]. The weight of yₜ₋₁ is found first (the Schur
    /// complement of the input part), limited to ± [`MAX_FEEDBACK`], and the other two solved for it.
    #[inline]
    fn solve(&self, rhs: [f32; 3]) -> Beta {
        let inverse_det = 1.0 / (self.pp * self.cc - self.pc * self.pc);
        let solve_input =
            |p: f32, c: f32| ((self.cc * p - self.pc * c) * inverse_det, (self.pp * c - self.pc * p) * inverse_det);
        let (bp, bc) = solve_input(self.pb, self.cb);
        let schur = self.bb - (self.pb * bp + self.cb * bc);
        let feedback = (rhs[2] - (rhs[0] * bp + rhs[1] * bc)) / schur;
        let b = feedback.clamp(-MAX_FEEDBACK, MAX_FEEDBACK);
        let (previous_input, input) = solve_input(rhs[0] - b * self.pb, rhs[1] - b * self.cb);
        Beta { previous_input, input, previous_output: b }
    }
}

/// Weighted mean of the rows `before` the neighbours, summed in order; zero if there are none.
fn mean(rows: &[PoseRow], neighbours: &[Neighbour], weights: &[f32], before: usize) -> PoseRow {
    let mut sum = [0.0; ROW];
    let mut count = 0.0;
    for (n, &w) in neighbours.iter().zip(weights) {
        for (s, v) in sum.iter_mut().zip(&rows[n.row as usize - before]) {
            *s += w * v;
        }
        count += w;
    }
    sum.map(|s| s / f32::max(count, f32::MIN_POSITIVE))
}

/// Distance below which neighbours are taken as equally near, (3 mm)².
const SAME: f32 = 1e-5;

/// Inverse-distance mean of the neighbours' values: KNN interpolation.
pub(super) fn interpolate<const N: usize>(values: &[[f32; N]], neighbours: &[Neighbour]) -> [f32; N] {
    inverse_distance_mean(neighbours.iter().map(|n| (n.distance, &values[n.row as usize])))
}

/// The same of the targets one frame earlier.
pub(super) fn interpolate_before(samples: Samples<'_>) -> PoseRow {
    inverse_distance_mean(samples.neighbours.iter().map(|n| (n.distance, &samples.targets[n.row as usize - 1])))
}

fn inverse_distance_mean<'a, const N: usize>(values: impl Iterator<Item = (f32, &'a [f32; N])>) -> [f32; N] {
    let mut sum = [0.0; N];
    let mut weights = 0.0;
    for (distance, value) in values {
        let w = 1.0 / (distance + SAME);
        weights += w;
        for (s, v) in sum.iter_mut().zip(value) {
            *s += w * v;
        }
    }
    sum.map(|s| s / f32::max(weights, f32::MIN_POSITIVE))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn neighbours(rows: usize) -> Vec<Neighbour> {
        (1..rows).map(|row| Neighbour { distance: 0.0, row: row as u32 }).collect()
    }

    /// 60 numbers between −1 and 1 (Numerical Recipes' linear congruence).
    fn noise(seed: u32) -> Vec<f32> {
        let next = |s: &u32| Some(s.wrapping_mul(1_664_525).wrapping_add(1_013_904_223));
        std::iter::successors(Some(seed), next)
            .skip(1)
            .take(60)
            .map(|s| (s >> 8) as f32 / (1 << 23) as f32 - 1.0)
            .collect()
    }

    proptest! {
        /// Rows drawn at random, targets made by a known recursion: the fit must give it back.
        #[test]
        fn a_planted_linear_model_is_recovered(
            seed in 0u32..1 << 30, a in -0.5f32..0.5, c in 0.3f32..1.0, b in -0.8f32..0.8,
        ) {
            let noise = noise(seed);
            let inputs: Vec<PoseRow> = noise.iter().map(|&v| [v; ROW]).collect();
            let mut targets = vec![[0.3; ROW]];
            for t in 1..inputs.len() {
                targets.push([a * inputs[t - 1][0] + b * targets[t - 1][0] + c * inputs[t][0] + 0.5; ROW]);
            }
            let list = neighbours(inputs.len());
            let weights: Vec<f32> = list.iter().map(|n| 1.0 - n.row as f32 / 60.0).collect();
            let moments = InputMoments::new(&inputs, &list, &weights);
            let (x0, x1, y0) = ([0.2; ROW], [-0.4; ROW], [0.7; ROW]);
            let u = Regressors { previous_input: &x0, input: &x1, previous_output: &y0 };
            let y = predict(u, &moments, Samples { inputs: &inputs, targets: &targets, neighbours: &list, weights: &weights }, 1e-5, &[1.0; ROW], &Bias::NONE).output;
            let expected = a * 0.2 + b * 0.7 + c * -0.4 + 0.5;
            prop_assert!((y[0] - expected).abs() < 5e-3, "{} {expected}", y[0]);
            prop_assert!(y.iter().all(|v| *v == y[0]));
        }

        #[test]
        fn feedback_is_limited_and_the_rest_solved_for_it(
            rows in prop::collection::vec(prop::array::uniform4(-1.0f32..1.0), 4..40), gain in 0.95f32..3.0,
        ) {
            let mut g = Gram { pp: 0.1, pc: 0.0, cc: 0.1, pb: 0.0, cb: 0.0, bb: 0.1 };
            let mut rhs = [0.0; 3];
            for [p, c, b, e] in &rows {
                let t = gain * b * 2.0 + 0.1 * e;
                g.pp += p * p; g.pc += p * c; g.cc += c * c; g.pb += p * b; g.cb += c * b; g.bb += b * b;
                rhs[0] += p * t; rhs[1] += c * t; rhs[2] += b * t;
            }
            let beta = g.solve(rhs);
            prop_assert!(beta.previous_output.abs() <= MAX_FEEDBACK);
            let residual = g.pp * beta.previous_input + g.pc * beta.input + g.pb * beta.previous_output - rhs[0];
            prop_assert!(residual.abs() < 1e-2, "{residual}");
        }
    }

    #[test]
    fn identical_neighbours_give_their_target() {
        let (inputs, targets) = (vec![[0.5; ROW]; 10], vec![[0.8; ROW]; 10]);
        let (list, weights) = (neighbours(10), [1.0; 9]);
        let moments = InputMoments::new(&inputs, &list, &weights);
        let (x, y0) = ([0.9; ROW], [0.1; ROW]);
        let u = Regressors { previous_input: &x, input: &x, previous_output: &y0 };
        let y = predict(
            u,
            &moments,
            Samples { inputs: &inputs, targets: &targets, neighbours: &list, weights: &weights },
            4.0,
            &[0.3; ROW],
            &Bias::NONE,
        )
        .output;
        assert!(y.iter().all(|v| (v - 0.8).abs() < 1e-6));
        assert!(interpolate(&targets, &list).iter().all(|v| (v - 0.8).abs() < 1e-6));
    }
}
