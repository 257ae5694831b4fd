//! Timing of the engine's stages.

use serde::Serialize;
use std::sync::Arc;
use std::time::Instant;
use strut_core::humanoid::Pose;
use strut_core::transfer::{Model, Options, Stage, StageClock, Stylizer};
use strut_demo::benchmark::Query;

/// Labels of the input that are set, and which classes are used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Mode {
    /// Action and style of the input are known: one class is used.
    Labelled,
    /// No label is known; classes with a negligible weight are skipped.
    Unlabelled,
    /// No label is known; every class is used.
    All,
}

impl Mode {
    pub(crate) const ALL: [Self; 3] = [Self::Labelled, Self::Unlabelled, Self::All];

    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Labelled => "labelled",
            Self::Unlabelled => "unlabelled",
            Self::All => "all",
        }
    }

    fn options(self, query: &Query) -> Options {
        match self {
            Self::Labelled => {
                Options { action: Some(query.action), input_style: Some(query.style), ..Options::DEFAULT }
            }
            Self::Unlabelled => Options::DEFAULT,
            Self::All => Options { least_weight: 0.0, ..Options::DEFAULT },
        }
    }
}

/// One line of the report: a stage's times over all frames.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Row {
    pub(crate) stage: &'static str,
    pub(crate) mode: &'static str,
    pub(crate) engine: &'static str,
    frames: usize,
    classes: usize,
    pub(crate) median_ms: f64,
    pub(crate) p95_ms: f64,
}

impl Row {
    pub(crate) fn new(
        stage: &'static str,
        mode: &'static str,
        frames: usize,
        classes: usize,
        samples_ms: Vec<f64>,
    ) -> Self {
        Self::of("native", stage, mode, frames, classes, samples_ms)
    }

    /// Creates a row of an engine.
    pub(crate) fn of(
        engine: &'static str,
        stage: &'static str,
        mode: &'static str,
        frames: usize,
        classes: usize,
        mut samples_ms: Vec<f64>,
    ) -> Self {
        samples_ms.sort_by(f64::total_cmp);
        let [median_ms, p95_ms] = [0.5, 0.95].map(|share| percentile(&samples_ms, share));
        Self { stage, mode, engine, frames, classes, median_ms, p95_ms }
    }
}

/// Returns the value that this share of the samples does not exceed; NaN without samples.
pub(crate) fn percentile(sorted: &[f64], share: f64) -> f64 {
    let rank = (share * sorted.len() as f64).ceil() as usize;
    sorted.get(rank.max(1) - 1).copied().unwrap_or(f64::NAN)
}

/// Number of measured frames of each query.
const FRAMES_OF_QUERY: usize = 80;
/// Number of unmeasured frames at the start of a query, in which the search cannot use the previous frame.
const WARM_UP: usize = 20;
/// Number of frames between two cold starts of the search.
const COLD_STRIDE: usize = 20;

/// Times of one mode over several queries.
pub(crate) struct Run<'a> {
    model: &'a Arc<Model>,
    mode: Mode,
    frame: Vec<f64>,
    stages: [Vec<f64>; Stage::ALL.len()],
    cold_search: Vec<f64>,
    first_search: Vec<f64>,
}

impl<'a> Run<'a> {
    pub(crate) fn new(model: &'a Arc<Model>, mode: Mode) -> Self {
        let stages = Default::default();
        Self { model, mode, frame: Vec::new(), stages, cold_search: Vec::new(), first_search: Vec::new() }
    }

    /// Styles a query: once for the whole frames, once with the times of every stage, and at some frames from a cold
    /// start, with a whole window and with a first frame. The target is the neutral style; the choice does not matter.
    pub(crate) fn add(&mut self, query: &Query) {
        let Ok(stylizer) = Stylizer::new(Arc::clone(self.model), self.mode.options(query)) else {
            return; // No class has these labels.
        };
        let poses = &query.motion.poses[..query.motion.poses.len().min(WARM_UP + FRAMES_OF_QUERY)];
        let mut whole = stylizer.clone();
        for (i, pose) in poses.iter().enumerate() {
            let started = Instant::now();
            whole.push(pose);
            if i >= WARM_UP {
                self.frame.push(ms_since(started));
            }
        }
        let mut staged = stylizer.clone();
        for (i, pose) in poses.iter().enumerate() {
            let mut clock = StopWatch::default();
            staged.push_timed(pose, &mut clock);
            if i >= WARM_UP {
                self.stages.iter_mut().zip(clock.stages_ms).for_each(|(all, ms)| all.push(ms));
            }
        }
        let search_ms = |mut stylizer: Stylizer, pose: &Pose| {
            let mut clock = StopWatch::default();
            stylizer.push_timed(pose, &mut clock);
            clock.stages_ms[Stage::Search as usize]
        };
        // Changed labels of the input reset the search.
        let other = if self.mode == Mode::Labelled { Mode::Unlabelled } else { Mode::Labelled };
        for i in (WARM_UP..poses.len()).step_by(COLD_STRIDE) {
            self.first_search.push(search_ms(stylizer.clone(), &poses[i]));
            let mut cold = stylizer.clone();
            if cold.set_options(other.options(query)).is_ok() {
                poses[i - WARM_UP..i].iter().for_each(|pose| _ = cold.push(pose));
                if cold.set_options(self.mode.options(query)).is_ok() {
                    self.cold_search.push(search_ms(cold, &poses[i]));
                }
            }
        }
    }

    /// Returns rows for the frame, the stages and the cold starts.
    pub(crate) fn rows(self) -> Vec<Row> {
        let db = self.model.catalogue();
        let row = |stage, samples| Row::new(stage, self.mode.name(), db.frames(), db.classes().len(), samples);
        let stages = Stage::ALL.into_iter().map(Stage::name).zip(self.stages);
        let cold = [("cold search", self.cold_search), ("first search", self.first_search)];
        let rows = [("frame", self.frame)].into_iter().chain(stages).chain(cold);
        rows.filter(|(_, samples)| !samples.is_empty()).map(|(stage, samples)| row(stage, samples)).collect()
    }
}

/// Milliseconds of every stage of one frame.
struct StopWatch {
    last: Instant,
    stages_ms: [f64; Stage::ALL.len()],
}

impl Default for StopWatch {
    fn default() -> Self {
        Self { last: Instant::now(), stages_ms: [0.0; Stage::ALL.len()] }
    }
}

impl StageClock for StopWatch {
    fn start(&mut self) {
        self.last = Instant::now();
    }

    fn end(&mut self, stage: Stage) {
        let now = Instant::now();
        self.stages_ms[stage as usize] = (now - self.last).as_secs_f64() * 1e3;
        self.last = now;
    }
}

pub(crate) fn ms_since(started: Instant) -> f64 {
    started.elapsed().as_secs_f64() * 1e3
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_hold_the_median_and_the_95th_percentile() {
        let row = Row::new("frame", "all", 1, 1, (1..=100).rev().map(f64::from).collect());
        assert_eq!((row.median_ms, row.p95_ms), (50.0, 95.0));
        assert_eq!(Row::new("open", "all", 1, 1, vec![7.0]).p95_ms, 7.0);
        assert!(Row::new("open", "all", 1, 1, vec![]).median_ms.is_nan());
    }
}
