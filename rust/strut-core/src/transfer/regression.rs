//! Local autoregression of one class: Eq. 2 and `docs/methods/mar.md` §6.
//!
//! Each degree of freedom is predicted separately as yₜ = uᵀβ with u = [xₜ₋₁, yₜ₋₁, xₜ, 1], β fitted by ridge
//! regression to the class's neighbours. The neighbours' rows are gathered first. Then the sums of four degrees of
//! freedom are accumulated over all neighbours, in registers.

use super::bias::{Bias, InputStatistics};
use crate::catalogue::Rows;
use crate::math::lanes::Lane;
use crate::pose_vector::{LANES, PoseRow, ROW};
use crate::search::Neighbour;

/// Greatest magnitude of the coefficient of the previous output, also in the global autoregression: with more, errors feed
/// back faster than they decay.
pub const MAX_FEEDBACK: f32 = 0.9;

/// Neighbours' rows xₜ and their predecessors xₜ₋₁, in the order in which the sums read them: for each lane of four
/// degrees of freedom, [xₜ₋₁, xₜ] of all neighbours. The memory is reused.
#[derive(Clone, Debug, Default)]
pub(super) struct Gathered {
    pairs: Vec<[Lane; 2]>,
    /// Weighted means of each lane; zero without neighbours.
    means: [[Lane; 2]; LANES],
    count: usize,
}

impl Gathered {
    /// Reserves memory for the rows of `k` neighbours.
    pub(super) fn with_capacity(k: usize) -> Self {
        Self { pairs: Vec::with_capacity(LANES * k), ..Self::default() }
    }

    /// Replaces the rows. The neighbours' rows are never the first of a clip.
    pub(super) fn fill(&mut self, rows: &(impl Rows + ?Sized), neighbours: &[Neighbour], weights: &[f32]) {
        self.count = neighbours.len();
        self.pairs.resize(LANES * self.count, Default::default());
        self.means.fill(Default::default());
        let of = |n: &Neighbour| rows.pair(n.row as usize);
        let (fours, last) = neighbours.as_chunks::<4>();
        for (i, four) in fours.iter().enumerate() {
            self.add(4 * i, four.each_ref().map(of), weights);
        }
        for (i, n) in last.iter().enumerate() {
            self.add(4 * fours.len() + i, [of(n)], weights);
        }
        let total = Lane::splat(weights.iter().sum::<f32>().max(f32::MIN_POSITIVE));
        for mean in self.means.as_flattened_mut() {
            *mean = *mean / total;
        }
    }

    /// Copies the rows of the neighbours from `first` on, and adds them to the sums in `means`. Processing several
    /// neighbours at once shares the memory accesses.
    #[inline]
    fn add<const N: usize>(&mut self, first: usize, rows: [impl Fn(usize) -> [Lane; 2]; N], weights: &[f32]) {
        for (l, [before, at]) in self.means.iter_mut().enumerate() {
            let pairs = &mut self.pairs[l * self.count + first..][..N];
            for ((pair, row), w) in pairs.iter_mut().zip(&rows).zip(&weights[first..]) {
                *pair = row(l);
                *before += Lane::splat(*w) * pair[0];
                *at += Lane::splat(*w) * pair[1];
            }
        }
    }

    /// Values of four degrees of freedom for every neighbour.
    pub(super) fn lane(&self, l: usize) -> &[[Lane; 2]] {
        &self.pairs[l * self.count..][..self.count]
    }

    /// Means of four degrees of freedom, with the weights passed to [`Self::fill`].
    fn means(&self, l: usize) -> [Lane; 2] {
        self.means[l]
    }
}

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
    /// Sums over the neighbours' inputs, with these weights.
    pub(super) fn new(inputs: &Gathered, weights: &[f32]) -> Self {
        let zero = [0.0; ROW];
        let mut moments = Self {
            mean_previous: zero,
            statistics: InputStatistics { mean: zero, deviation: zero },
            pp: zero,
            pc: zero,
            cc: zero,
        };
        let count = Lane::splat(weights.iter().sum::<f32>().max(f32::MIN_POSITIVE));
        for l in 0..LANES {
            let [mean_previous, mean] = inputs.means(l);
            let (mut pp, mut pc, mut cc) = (Lane::default(), Lane::default(), Lane::default());
            for (&[p, c], &w) in inputs.lane(l).iter().zip(weights) {
                let (p, c, w) = (p - mean_previous, c - mean, Lane::splat(w));
                let (wp, wc) = (w * p, w * c);
                pp += wp * p;
                pc += wp * c;
                cc += wc * c;
            }
            mean_previous.write(&mut moments.mean_previous, l);
            mean.write(&mut moments.statistics.mean, l);
            (cc / count).map(f32::sqrt).write(&mut moments.statistics.deviation, l);
            pp.write(&mut moments.pp, l);
            pc.write(&mut moments.pc, l);
            cc.write(&mut moments.cc, l);
        }
        moments
    }

    /// Mean change of the neighbours' inputs from t−1 to t.
    pub(super) fn input_step(&self) -> PoseRow {
        std::array::from_fn(|d| self.statistics.mean[d] - self.mean_previous[d])
    }
}

/// The registered examples of a class for one style.
#[derive(Clone, Copy, Debug)]
pub(super) struct Samples<'a> {
    /// x.
    pub(super) inputs: &'a Gathered,
    /// Their targets in the style: y.
    pub(super) targets: &'a Gathered,
    /// Weight of each example: 0 to 1, not all 0.
    pub(super) weights: &'a [f32],
}

/// Known values from which a frame is predicted.
#[derive(Clone, Copy, Debug)]
pub(super) struct Regressors<'a> {
    /// xₜ₋₁.
    pub(super) previous_input: &'a PoseRow,
    /// xₜ.
    pub(super) input: &'a PoseRow,
    /// yₜ₋₁.
    pub(super) previous_output: &'a PoseRow,
}

/// Result of the regression.
#[derive(Clone, Debug)]
pub(super) struct Prediction {
    /// yₜ.
    pub(super) output: PoseRow,
    /// Mean change of the neighbours' targets from t−1 to t.
    pub(super) target_step: PoseRow,
}

/// Predicts yₜ of one style from the registered target rows of the neighbours.
///
/// `ridge` is λ·K in squared standard deviations, where K is the sum of the weights; `sigma` is the global standard
/// deviation of each degree of freedom. The bias is subtracted from the regressors and its share ρ is added to the
/// result (Eq. 6–7).
pub(super) fn predict(
    u: Regressors<'_>,
    moments: &InputMoments,
    samples: Samples<'_>,
    ridge: f32,
    sigma: &PoseRow,
    bias: &Bias,
) -> Prediction {
    let mut prediction = Prediction { output: [0.0; ROW], target_step: [0.0; ROW] };
    for l in 0..LANES {
        let examples = LaneMoments::new(l, moments, samples);
        let beta = examples.fit(ridge, sigma);
        examples.predict(beta, u, bias).write(&mut prediction.output, l);
        (examples.mean_target - examples.mean_before).write(&mut prediction.target_step, l);
    }
    prediction
}

/// Means and products of four degrees of freedom of the examples: the data for a fit with any ridge.
#[derive(Clone, Copy, Debug)]
pub(super) struct LaneMoments {
    lane: usize,
    mean_previous: Lane,
    mean_input: Lane,
    pub(super) mean_before: Lane,
    pub(super) mean_target: Lane,
    /// Without the ridge.
    gram: Gram,
    rhs: [Lane; 3],
}

impl LaneMoments {
    /// Moments of the lane `l` of samples whose inputs have the moments `moments`.
    #[inline]
    pub(super) fn new(l: usize, moments: &InputMoments, samples: Samples<'_>) -> Self {
        let Samples { inputs, targets, weights } = samples;
        let at = |row: &PoseRow| Lane::of(row, l);
        let (mean_previous, mean_input) = (at(&moments.mean_previous), at(&moments.statistics.mean));
        let [mean_before, mean_target] = targets.means(l);
        // Products with the previous target (`b`) and with the target (`t`).
        let (mut pb, mut cb, mut bb) = (Lane::default(), Lane::default(), Lane::default());
        let (mut pt, mut ct, mut bt) = (Lane::default(), Lane::default(), Lane::default());
        for ((&[p, c], &[b, t]), &w) in inputs.lane(l).iter().zip(targets.lane(l)).zip(weights) {
            let (p, c, b, t) = (p - mean_previous, c - mean_input, b - mean_before, t - mean_target);
            let w = Lane::splat(w);
            let (wb, t) = (w * b, w * t);
            pb += p * wb;
            cb += c * wb;
            bb += b * wb;
            pt += p * t;
            ct += c * t;
            bt += b * t;
        }
        let gram = Gram { pp: at(&moments.pp), pc: at(&moments.pc), cc: at(&moments.cc), pb, cb, bb };
        Self { lane: l, mean_previous, mean_input, mean_before, mean_target, gram, rhs: [pt, ct, bt] }
    }

    /// β of Eq. 2; `ridge` and `sigma` as in [`predict`].
    #[inline]
    pub(super) fn fit(&self, ridge: f32, sigma: &PoseRow) -> Beta {
        let sigma = Lane::of(sigma, self.lane);
        let ridge = Lane::splat(ridge) * sigma * sigma;
        let Gram { pp, pc, cc, pb, cb, bb } = self.gram;
        Gram { pp: pp + ridge, pc, cc: cc + ridge, pb, cb, bb: bb + ridge }.solve(self.rhs)
    }

    /// yₜ.
    #[inline]
    pub(super) fn predict(&self, beta: Beta, u: Regressors<'_>, bias: &Bias) -> Lane {
        let at = |row: &PoseRow| Lane::of(row, self.lane);
        self.mean_target
            + beta.previous_input * (at(u.previous_input) - at(&bias.input) - self.mean_previous)
            + beta.input * (at(u.input) - at(&bias.input) - self.mean_input)
            + beta.previous_output * (at(u.previous_output) - at(&bias.output) - self.mean_before)
            + at(&bias.output)
    }
}

/// Normal equations of four degrees of freedom: regressors p = xₜ₋₁, c = xₜ, b = yₜ₋₁.
#[derive(Clone, Copy, Debug)]
struct Gram {
    pp: Lane,
    pc: Lane,
    cc: Lane,
    pb: Lane,
    cb: Lane,
    bb: Lane,
}

/// Weights of the regressors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Beta {
    pub(super) previous_input: Lane,
    pub(super) input: Lane,
    pub(super) previous_output: Lane,
}

impl Gram {
    /// Solves for the right-hand side [p·t, c·t, b·t]. The weight of yₜ₋₁ is found first (by the Schur complement of
    /// the input part) and limited to ± [`MAX_FEEDBACK`]. Then the other two are solved for it.
    #[inline]
    fn solve(&self, rhs: [Lane; 3]) -> Beta {
        let inverse_det = Lane::splat(1.0) / (self.pp * self.cc - self.pc * self.pc);
        let solve_input =
            |p: Lane, c: Lane| ((self.cc * p - self.pc * c) * inverse_det, (self.pp * c - self.pc * p) * inverse_det);
        let (bp, bc) = solve_input(self.pb, self.cb);
        let schur = self.bb - (self.pb * bp + self.cb * bc);
        let feedback = (rhs[2] - (rhs[0] * bp + rhs[1] * bc)) / schur;
        let b = feedback.map(|b| b.clamp(-MAX_FEEDBACK, MAX_FEEDBACK));
        let (previous_input, input) = solve_input(rhs[0] - b * self.pb, rhs[1] - b * self.cb);
        Beta { previous_input, input, previous_output: b }
    }
}

/// Added to distances before they are inverted, (3 mm)². Neighbours nearer than this have about equal weight.
const SAME: f32 = 1e-5;

/// Inverse-distance mean of the neighbours' values: KNN interpolation.
pub(super) fn interpolate<const N: usize>(value: impl Fn(usize) -> [f32; N], neighbours: &[Neighbour]) -> [f32; N] {
    let mut sum = [0.0; N];
    let mut weights = 0.0;
    for n in neighbours {
        let w = 1.0 / (n.distance + SAME);
        weights += w;
        for (s, v) in sum.iter_mut().zip(value(n.row as usize)) {
            *s += w * v;
        }
    }
    sum.map(|s| s / f32::max(weights, f32::MIN_POSITIVE))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn gathered(rows: &[PoseRow], weights: &[f32]) -> Gathered {
        let mut gathered = Gathered::default();
        gathered.fill(rows, &neighbours(rows.len()), weights);
        gathered
    }

    fn neighbours(rows: usize) -> Vec<Neighbour> {
        (1..rows).map(|row| Neighbour { distance: 0.0, row: row as u32 }).collect()
    }

    /// 60 numbers between −1 and 1.
    fn noise(seed: u32) -> Vec<f32> {
        crate::fixtures::noise(seed).take(60).map(|v| v as f32).collect()
    }

    proptest! {
        /// Rows are random and targets follow a known recursion, which the fit must recover.
        #[test]
        fn a_planted_linear_model_is_recovered(
            seed in 0u32..1 << 30, a in -0.5f32..0.5, c in 0.3f32..1.0, b in -0.8f32..0.8,
        ) {
            // Where a + b·c is zero, the targets are c·xₜ and a constant, which many models explain.
            prop_assume!((a + b * c).abs() > 0.02);
            let noise = noise(seed);
            let inputs: Vec<PoseRow> = noise.iter().map(|&v| [v; ROW]).collect();
            let mut targets = vec![[0.3; ROW]];
            for t in 1..inputs.len() {
                targets.push([a * inputs[t - 1][0] + b * targets[t - 1][0] + c * inputs[t][0] + 0.5; ROW]);
            }
            let weights: Vec<f32> = (1..inputs.len()).map(|row| 1.0 - row as f32 / 60.0).collect();
            let (inputs, targets) = (gathered(&inputs, &weights), gathered(&targets, &weights));
            let moments = InputMoments::new(&inputs, &weights);
            let (x0, x1, y0) = ([0.2; ROW], [-0.4; ROW], [0.7; ROW]);
            let u = Regressors { previous_input: &x0, input: &x1, previous_output: &y0 };
            let samples = Samples { inputs: &inputs, targets: &targets, weights: &weights };
            let y = predict(u, &moments, samples, 1e-5, &[1.0; ROW], &Bias::NONE).output;
            let expected = a * 0.2 + b * 0.7 + c * -0.4 + 0.5;
            prop_assert!((y[0] - expected).abs() < 5e-3, "{} {expected}", y[0]);
            prop_assert!(y.iter().all(|v| *v == y[0]));
        }

        #[test]
        fn feedback_is_limited_and_the_rest_solved_for_it(
            rows in prop::collection::vec(prop::array::uniform4(-1.0f32..1.0), 4..40), gain in 0.95f32..3.0,
        ) {
            let [mut pp, mut pc, mut cc, mut pb, mut cb, mut bb] = [0.1_f32, 0.0, 0.1, 0.0, 0.0, 0.1];
            let mut rhs = [0.0_f32; 3];
            for [p, c, b, e] in &rows {
                let t = gain * b * 2.0 + 0.1 * e;
                pp += p * p; pc += p * c; cc += c * c; pb += p * b; cb += c * b; bb += b * b;
                rhs[0] += p * t; rhs[1] += c * t; rhs[2] += b * t;
            }
            let [pp, pc, cc, pb, cb, bb] = [pp, pc, cc, pb, cb, bb].map(Lane::splat);
            let beta = Gram { pp, pc, cc, pb, cb, bb }.solve(rhs.map(Lane::splat));
            let residual = pp * beta.previous_input + pc * beta.input + pb * beta.previous_output;
            let residual = residual.to_array()[0] - rhs[0];
            prop_assert!(beta.previous_output.to_array().iter().all(|b| b.abs() <= MAX_FEEDBACK));
            prop_assert!(residual.abs() < 1e-2, "{residual}");
        }
    }

    #[test]
    fn identical_neighbours_give_their_target() {
        let (inputs, targets) = (vec![[0.5; ROW]; 10], vec![[0.8; ROW]; 10]);
        assert!(interpolate(|row| targets[row], &neighbours(10)).iter().all(|v| (v - 0.8).abs() < 1e-6));
        let (inputs, targets) = (gathered(&inputs, &[1.0; 9]), gathered(&targets, &[1.0; 9]));
        let moments = InputMoments::new(&inputs, &[1.0; 9]);
        let (x, y0) = ([0.9; ROW], [0.1; ROW]);
        let u = Regressors { previous_input: &x, input: &x, previous_output: &y0 };
        let samples = Samples { inputs: &inputs, targets: &targets, weights: &[1.0; 9] };
        let y = predict(u, &moments, samples, 4.0, &[0.3; ROW], &Bias::NONE).output;
        assert!(y.iter().all(|v| (v - 0.8).abs() < 1e-6));
    }
}
