//! Duration of a frame, estimated from the neighbours (`docs/methods/mar.md` §9).

use super::Lens;
use super::error::{LensError, among};
use crate::catalogue::ExampleRows;
use crate::search::Neighbour;
use crate::transfer::timing::{Kernel, Moment, duration};

/// The neighbours of the heaviest class and their durations.
#[derive(Clone, Debug, PartialEq)]
pub struct Timing {
    /// d: distance of each from the input and the output, in standard deviations.
    pub distances: Vec<f32>,
    /// w: duration of each in the style, seconds.
    pub durations: Vec<f32>,
    /// g: weight by the distance, relative to the nearest.
    pub kernel: Vec<f32>,
    /// v: weight as a neighbour.
    pub weights: Vec<f32>,
    /// h: the bandwidth.
    pub bandwidth: f32,
    /// Duration of the frame, seconds; `None` without neighbours.
    pub duration: Option<f32>,
}

impl Lens {
    /// Durations in a style that has a weight.
    ///
    /// # Errors
    /// If the style does not exist or has no weight.
    pub fn timing(&self, style: usize) -> Result<Timing, LensError> {
        let model = self.model();
        let styles = &model.catalogue().styles;
        let style = among("style", style, styles.len())?;
        let not_active = || LensError::NotActive { name: styles[style].clone() };
        let current = self.stylizer.predicted_row(style).ok_or_else(not_active)?;
        let before = self.outputs_before[style].as_ref().unwrap_or(current);
        let mixture = self.stylizer.inside().mixture;
        let (neighbours, weights) = (mixture.heaviest_neighbours(), mixture.heaviest_neighbour_weights());
        let (mut of_inputs, mut of_outputs) = (Vec::new(), Vec::new());
        let input = Moment { pose: &self.now, previous: &self.previous };
        model.scales().squared_distances(input, &ExampleRows::Inputs(model.rows()), neighbours, &mut of_inputs);
        let table = model.target_table(style);
        let output = Moment { pose: current, previous: before };
        model.scales().squared_distances(output, &ExampleRows::Targets(&table), neighbours, &mut of_outputs);
        let kernel = Kernel::new(&of_inputs, &of_outputs);
        let squares: Vec<f32> = of_inputs.iter().zip(&of_outputs).map(|(x, y)| x + y).collect();
        let secs = |n: &Neighbour| table.step_secs(n.row as usize);
        Ok(Timing {
            distances: squares.iter().map(|square| square.sqrt()).collect(),
            durations: neighbours.iter().map(secs).collect(),
            kernel: squares.iter().map(|&square| kernel.weight(square)).collect(),
            weights: weights.to_vec(),
            bandwidth: kernel.bandwidth,
            duration: duration(&of_inputs, &of_outputs, neighbours, weights, |row| table.step_secs(row)),
        })
    }
}
