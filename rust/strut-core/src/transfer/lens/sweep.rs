//! Error of a free-running prediction as a function of the ridge.

use super::error::LensError;
use super::{FitSettings, Lens, Stream, WeightedNeighbour};
use crate::humanoid::Pose;
use crate::pose_vector::PoseRow;
use crate::search::{Metric, Neighbours};
use crate::transfer::regression::Regressors;

impl Lens {
    /// For each λ the root mean square error of one degree of freedom. It is predicted over the whole input from its
    /// own previous output, and compared with `ideal`: the poses of the input's counterpart in the style of the
    /// greatest weight, one per frame. The examples are those of the class that is the heaviest at the viewed frame.
    /// The prediction is not smoothed. `settings.lambda` is not used.
    ///
    /// # Errors
    /// If a setting is out of range, or the number of poses differs from the number of frames.
    pub fn sweep(&mut self, settings: &FitSettings, lambdas: &[f32], ideal: &[Pose]) -> Result<Vec<f32>, LensError> {
        let class = self.heaviest_class().unwrap_or(0);
        for &lambda in lambdas {
            FitSettings { lambda, ..*settings }.validate()?;
        }
        if ideal.len() != self.input.len() {
            let value = ideal.len() as f32;
            return Err(LensError::OutOfRange {
                what: "the number of counterparts",
                value,
                expected: "one for each frame of the input",
            });
        }
        let model = std::sync::Arc::clone(self.model());
        let (style, sigma, dof) = (self.greatest_style(), model.catalogue().sigma(), settings.dof);
        let mut found = Neighbours::with_capacity(settings.k);
        let mut outputs: Vec<Option<PoseRow>> = vec![None; lambdas.len()];
        let mut squares = vec![0.0_f64; lambdas.len()];
        let mut scratch = std::mem::take(&mut self.scratch);
        let mut stream = Stream::new(&model, &self.input);
        let mut previous: Option<PoseRow> = None;
        for ideal in Stream::new(&model, ideal) {
            let Some(row) = stream.next() else { break };
            let query = model.index().prepare(&stream.window, Metric::FullBody);
            model.index().nearest(&query, &[class], settings.k, &mut scratch, &mut found);
            let weighted = found.as_slice().iter();
            let neighbours: Vec<WeightedNeighbour> =
                weighted.map(|n| WeightedNeighbour { row: n.row as usize, square: n.distance, weight: 1.0 }).collect();
            let examples = self.examples(settings, style, &neighbours, &row);
            for ((&lambda, output), square) in lambdas.iter().zip(&mut outputs).zip(&mut squares) {
                let mut y = output.unwrap_or(examples.start);
                let u = Regressors { previous_input: &previous.unwrap_or(row), input: &row, previous_output: &y };
                let beta = examples.lane.fit(lambda * examples.weight_sum, sigma);
                examples.lane.predict(beta, u, &examples.bias).write(&mut y, dof / crate::math::lanes::WIDTH);
                *output = Some(y);
                let error = f64::from(y[dof] - ideal[dof]);
                *square += error * error;
            }
            previous = Some(row);
        }
        self.scratch = scratch;
        Ok(squares.into_iter().map(|sum| (sum / self.input.len() as f64).sqrt() as f32).collect())
    }
}
