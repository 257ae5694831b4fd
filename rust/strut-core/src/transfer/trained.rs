//! Methods with training, which other crates define, and their predictions of one target style.

use super::input::Input;
use super::model::Model;
use crate::catalogue::TargetTable;
use crate::pose_vector::PoseRow;
use std::fmt;
use std::sync::Arc;

/// Number of stored frames on which a predictor is run before the first input.
const RUN_UP: usize = 64;

/// A method with training, for [`Method::Trained`](super::Method::Trained). Two are equal if their names are.
#[derive(Clone, Copy)]
pub struct TrainedMethod {
    /// Command-line name of the method.
    pub name: &'static str,
    /// Whether the training depends on λ.
    pub has_ridge: bool,
    /// Trains a predictor, or returns the one that was trained for the same arguments.
    pub train: fn(&Training<'_>) -> Arc<dyn Predictor>,
}

impl PartialEq for TrainedMethod {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl Eq for TrainedMethod {}

impl fmt::Debug for TrainedMethod {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)
    }
}

/// Arguments of a training.
#[derive(Clone, Copy, Debug)]
pub struct Training<'a> {
    /// The model, with the rows that are the inputs.
    pub model: &'a Model,
    /// Targets of all rows in the style that is predicted.
    pub targets: &'a TargetTable,
    /// Indices of the classes whose rows are used.
    pub classes: &'a [usize],
    /// λ of the options.
    pub lambda: f32,
}

/// Input of the prediction of a frame.
#[derive(Clone, Copy, Debug)]
pub struct PredictorInput<'a> {
    /// xₜ.
    pub input: &'a PoseRow,
    /// xₜ₋₁.
    pub previous_input: &'a PoseRow,
    /// yₜ₋₁; an estimate for the first frame.
    pub previous_output: &'a PoseRow,
}

/// A frame that a [`Predictor`] predicts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PredictedFrame {
    /// yₜ.
    pub output: PoseRow,
    /// Duration of the frame, seconds.
    pub step_secs: f32,
}

/// A method trained for one target style.
pub trait Predictor: fmt::Debug + Send + Sync {
    /// Number of values that [`Predictor::predict`] keeps from frame to frame.
    fn memory_len(&self) -> usize;

    /// Sets the memory to its value after the rows of `past`, the stored frames up to the one nearest to the first
    /// input. `past` may be empty.
    fn start(&self, memory: &mut [f64], past: &[PoseRow]);

    /// Predicts the next frame. Must not allocate.
    fn predict(&self, memory: &mut [f64], now: PredictorInput<'_>) -> PredictedFrame;
}

/// A predictor and its state.
#[derive(Clone, Debug)]
pub(super) struct Trained {
    predictor: Arc<dyn Predictor>,
    memory: Vec<f64>,
    step_secs: f32,
}

impl Trained {
    /// A method's predictor of one style. Takes up to a second if the model has not trained it yet.
    pub(super) fn new(method: &TrainedMethod, training: &Training<'_>) -> Self {
        let predictor = (method.train)(training);
        let step_secs = 1.0 / training.model.catalogue().rate_hz;
        Self { memory: vec![0.0; predictor.memory_len()], step_secs, predictor }
    }

    /// Starts as if the input so far had been the stored frames up to the row `nearest`.
    pub(super) fn start(&mut self, model: &Model, nearest: Option<usize>) {
        let db = model.catalogue();
        let past: Vec<PoseRow> = nearest.map_or_else(Vec::new, |row| {
            let first = db.clips[db.clip_of_row(row)].first_frame;
            (first.max(row.saturating_sub(RUN_UP))..row).map(|row| model.rows().get(row)).collect()
        });
        self.predictor.start(&mut self.memory, &past);
    }

    /// Predicts the next row.
    pub(super) fn predict(&mut self, input: Input<'_>, previous_output: &PoseRow) -> PoseRow {
        let now = PredictorInput { input: input.current, previous_input: input.previous, previous_output };
        let prediction = self.predictor.predict(&mut self.memory, now);
        self.step_secs = prediction.step_secs;
        prediction.output
    }

    /// Duration of the last predicted row, seconds.
    pub(super) fn step_secs(&self) -> f32 {
        self.step_secs
    }
}
