//! Linear time-invariant systems: Hsu, Pulli, Popović, "Style Translation for Human Motion", 2005.
//!
//! A state-space model maps the input's degrees of freedom to the output's. The training pairs are registered rows, as
//! the paper's are warped clips. There are two variants: one system of order 8 for each degree of freedom (the figures
//! of `docs/methods/mar.md` are for this variant), or one system for the leading principal components of all. Timing is
//! an additional output: the log duration, predicted from the input's leading components and smoothed afterwards, as in
//! the paper. Feet are planted by the stylizer, as for every method.

use super::pairs::Pairs;
use super::principal::Principal;
use super::subspace::{Recording, Shape, StateSpace};
use strut_core::math::float_funcs::double;
use strut_core::math::float_funcs::exp;
use strut_core::pose_vector::{DOFS, PoseRow, ROW};
use strut_core::transfer::{PredictedFrame, Predictor, PredictorInput};

/// Shape of the systems of one degree of freedom: the order of the literature, and lags of a third of a second at 60
/// Hz, enough to determine the phase of a step.
const SINGLE: Shape = Shape { inputs: 1, outputs: 1, order: 8, lags: 20 };
/// Number of principal components of the input and of the output in the joint system.
const COMPONENTS: usize = 16;
/// Shape of the joint system: with more outputs, fewer lags determine the state.
const JOINT: Shape = Shape { inputs: COMPONENTS, outputs: COMPONENTS, order: 32, lags: 8 };
/// Shape of the system that predicts the log duration from the leading components of the input.
const TIMING: Shape = Shape { inputs: 6, outputs: 1, order: 8, lags: 12 };
/// Degrees of freedom with a smaller deviation are treated as constant.
const STILL: f64 = 1e-5;
/// Half-life of the smoothing of log durations, seconds: a tempo changes over a step, not within it.
const TIMING_HALF_LIFE_SECS: f64 = 0.1;

/// A system for each degree of freedom, or one for all.
#[derive(Clone, Debug)]
enum Systems {
    /// One entry for each degree of freedom; `None` if the input is constant.
    Single(Vec<Option<StateSpace>>),
    Joint {
        system: StateSpace,
        output: Principal,
    },
}

/// Linear time-invariant systems of one target style.
#[derive(Clone, Debug)]
pub(super) struct Lti {
    systems: Systems,
    /// Components of the input's rows.
    components: Principal,
    /// System from the components to the log duration.
    timing: StateSpace,
    input_mean: Vec<f64>,
    input_deviation: Vec<f64>,
    output_mean: Vec<f64>,
    frame_secs: f32,
    /// Share of a new log duration in the smoothed one.
    timing_share: f64,
}

impl Lti {
    /// Trains one system for each degree of freedom.
    pub(super) fn train(pairs: &Pairs<'_>) -> Self {
        let (x, y) = (&pairs.inputs, &pairs.targets);
        let mut lti = Self::timing_only(pairs);
        let system = |d: usize| {
            // Both in deviations of the input, so that they are of similar size.
            let deviation = lti.input_deviation[d];
            let standard = |row: &PoseRow, mean: f64| (f64::from(row[d]) - mean) / deviation;
            let recordings =
                recordings(pairs, |t| [standard(&x[t], lti.input_mean[d])], |t| [standard(&y[t], lti.output_mean[d])]);
            (deviation > STILL).then(|| StateSpace::identify(&recordings, SINGLE))
        };
        lti.systems = Systems::Single((0..DOFS).map(system).collect());
        lti
    }

    /// Trains one system for the principal components of all degrees of freedom.
    pub(super) fn train_joint(pairs: &Pairs<'_>) -> Self {
        let mut lti = Self::timing_only(pairs);
        let output = principal(pairs, &pairs.targets);
        let recordings = recordings(
            pairs,
            |t| projected(&lti.components, &pairs.inputs[t]),
            |t| projected(&output, &pairs.targets[t]),
        );
        lti.systems = Systems::Joint { system: StateSpace::identify(&recordings, JOINT), output };
        lti
    }

    /// Trains everything except the systems for the pose.
    fn timing_only(pairs: &Pairs<'_>) -> Self {
        let [input_mean, input_deviation] = pairs.moments(&pairs.inputs);
        let [output_mean, _] = pairs.moments(&pairs.targets);
        let components = principal(pairs, &pairs.inputs);
        let recordings =
            recordings(pairs, |t| timing_input(&projected(&components, &pairs.inputs[t])), |t| [pairs.log_duration(t)]);
        Self {
            systems: Systems::Single(Vec::new()),
            timing: StateSpace::identify(&recordings, TIMING),
            components,
            input_mean,
            input_deviation,
            output_mean,
            frame_secs: 1.0 / pairs.catalogue.rate_hz,
            timing_share: 1.0 - double::exp2(-1.0 / (TIMING_HALF_LIFE_SECS * f64::from(pairs.catalogue.rate_hz))),
        }
    }

    /// Calls `f` for every system with the quantity that it predicts, its memory and its input for a row.
    fn for_each(&self, memory: &mut [f64], row: &PoseRow, mut f: impl FnMut(Part, &StateSpace, &mut [f64], &[f64])) {
        let components = projected(&self.components, row);
        let (timing, mut rest) = memory.split_at_mut(2 * self.timing.order());
        f(Part::Duration, &self.timing, timing, &timing_input(&components));
        match &self.systems {
            Systems::Single(systems) => {
                for (d, system) in systems.iter().enumerate() {
                    let Some(system) = system else { continue };
                    let (own, others) = rest.split_at_mut(2 * system.order());
                    rest = others;
                    let u = (f64::from(row[d]) - self.input_mean[d]) / self.input_deviation[d];
                    f(Part::Dof(d), system, own, &[u]);
                }
            }
            Systems::Joint { system, .. } => f(Part::Body, system, rest, &components),
        }
    }
}

/// Quantity that a system predicts.
#[derive(Clone, Copy, Debug)]
enum Part {
    Duration,
    Dof(usize),
    Body,
}

impl Predictor for Lti {
    fn memory_len(&self) -> usize {
        let systems = match &self.systems {
            Systems::Single(systems) => systems.iter().flatten().map(StateSpace::order).sum(),
            Systems::Joint { system, .. } => system.order(),
        };
        1 + 2 * (self.timing.order() + systems)
    }

    fn start(&self, memory: &mut [f64], past: &[PoseRow]) {
        memory.fill(0.0);
        let Some((log_duration, states)) = memory.split_first_mut() else { return };
        let mut timing = [0.0];
        if let Some(first) = past.first() {
            self.for_each(states, first, |part, system, state, u| {
                system.rest(state, u);
                if let Part::Duration = part {
                    system.output(state, u, &mut timing);
                }
            });
            *log_duration = timing[0];
        }
        for row in past {
            self.for_each(states, row, |part, system, state, u| {
                if let Part::Duration = part {
                    system.output(state, u, &mut timing);
                }
                system.step(state, u);
            });
            *log_duration += self.timing_share * (timing[0] - *log_duration);
        }
    }

    fn predict(&self, memory: &mut [f64], now: PredictorInput<'_>) -> PredictedFrame {
        let mut pose: [f64; DOFS] = std::array::from_fn(|d| self.output_mean[d]);
        let (smoothed, states) = memory.split_at_mut(1);
        let mut log_duration = [0.0];
        self.for_each(states, now.input, |part, system, memory, u| {
            match part {
                Part::Duration => system.output(memory, u, &mut log_duration),
                Part::Dof(d) => {
                    let mut y = [0.0];
                    system.output(memory, u, &mut y);
                    pose[d] += self.input_deviation[d] * y[0];
                }
                Part::Body => {
                    let mut y = [0.0; COMPONENTS];
                    system.output(memory, u, &mut y);
                    if let Systems::Joint { output, .. } = &self.systems {
                        output.reconstruct(&y[..output.len()], &mut pose);
                    }
                }
            }
            system.step(memory, u);
        });
        let mut output = [0.0; ROW];
        output.iter_mut().zip(pose).for_each(|(o, v)| *o = v as f32);
        smoothed[0] += self.timing_share * (log_duration[0] - smoothed[0]);
        PredictedFrame { output, step_secs: self.frame_secs * exp(smoothed[0] as f32) }
    }
}

/// Inputs and outputs of a system at the pairs' rows, a recording for each segment.
fn recordings<const M: usize, const L: usize>(
    pairs: &Pairs<'_>,
    input: impl Fn(usize) -> [f64; M],
    output: impl Fn(usize) -> [f64; L],
) -> Vec<Recording> {
    let recording = |rows: &std::ops::Range<usize>| Recording {
        inputs: rows.clone().flat_map(&input).collect(),
        outputs: rows.clone().flat_map(&output).collect(),
    };
    pairs.segments.iter().map(recording).collect()
}

/// Components of some rows of the pairs.
fn principal(pairs: &Pairs<'_>, rows: &[PoseRow]) -> Principal {
    let data: Vec<f64> = pairs.segments.iter().cloned().flatten().flat_map(|t| wide(&rows[t])).collect();
    Principal::new(&data, DOFS, COMPONENTS)
}

fn wide(row: &PoseRow) -> [f64; DOFS] {
    std::array::from_fn(|d| f64::from(row[d]))
}

/// The components of a row; missing ones are zero.
fn projected(principal: &Principal, row: &PoseRow) -> [f64; COMPONENTS] {
    let mut out = [0.0; COMPONENTS];
    principal.project(&wide(row), &mut out);
    out
}

fn timing_input(components: &[f64; COMPONENTS]) -> [f64; TIMING.inputs] {
    std::array::from_fn(|i| components[i])
}
