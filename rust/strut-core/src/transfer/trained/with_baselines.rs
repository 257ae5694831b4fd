//! Predictions of one target style by the methods with training.

use crate::baselines::{Now, Pairs, Predictor};
use crate::pose_vector::PoseRow;
use crate::transfer::input::Input;
use crate::transfer::model::Model;
use crate::transfer::options::Options;
use std::sync::Arc;

/// Number of stored frames on which a predictor is run before the first input.
const RUN_UP: usize = 64;

/// A predictor and its state.
#[derive(Clone, Debug)]
pub(in crate::transfer) struct Trained {
    predictor: Arc<dyn Predictor>,
    memory: Vec<f64>,
    step_secs: f32,
}

impl Trained {
    /// Predictor of one style for the classes that `options` allow; `None` if the method needs no training. Takes up to
    /// a second if the model has not trained it yet.
    pub(in crate::transfer) fn new(model: &Model, options: &Options, classes: &[usize], style: usize) -> Option<Self> {
        let baseline = options.method.baseline()?;
        let table = model.target_table(style);
        let pairs = Pairs::new(model.catalogue(), &table, classes);
        let predictor = model.baselines().predictor(baseline, &pairs, options.lambda);
        Some(Self { memory: vec![0.0; predictor.memory_len()], step_secs: 1.0 / model.catalogue().rate_hz, predictor })
    }

    /// Starts as if the input so far had been the stored frames up to the row `nearest`.
    pub(in crate::transfer) fn start(&mut self, model: &Model, nearest: Option<usize>) {
        let db = model.catalogue();
        let past: Vec<PoseRow> = nearest.map_or_else(Vec::new, |row| {
            let first = db.clips[db.clip_of_row(row)].first_frame;
            (first.max(row.saturating_sub(RUN_UP))..row).map(|row| model.rows().get(row)).collect()
        });
        self.predictor.start(&mut self.memory, &past);
    }

    /// Predicts the next row.
    pub(in crate::transfer) fn predict(&mut self, input: Input<'_>, previous_output: &PoseRow) -> PoseRow {
        let now = Now { input: input.current, previous_input: input.previous, previous_output };
        let prediction = self.predictor.predict(&mut self.memory, now);
        self.step_secs = prediction.step_secs;
        prediction.output
    }

    /// Duration of the last predicted row, seconds.
    pub(in crate::transfer) fn step_secs(&self) -> f32 {
        self.step_secs
    }
}
