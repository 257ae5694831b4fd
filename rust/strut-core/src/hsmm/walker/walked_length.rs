//! How long the steps of a style are: measured in the walking figure (`docs/methods/hsmm.md` §11).

use super::{RuntimeWalkModel, Walker};
use crate::hsmm::model::WalkModel;
use crate::math::Vec3;
use crate::parallel::ParallelMap;
use std::sync::Arc;

/// Steps of a walk that is measured that belong to its beginning, and those that are measured: as many of either foot.
const BEGINNING: u64 = 2;
const MEASURED: u64 = 20;

impl WalkModel {
    /// With the lengths of every style's steps as a walker takes them when it is not told how long they are.
    pub fn with_walked_lengths(mut self, executor: &impl ParallelMap) -> Self {
        self.means.iter_mut().for_each(|means| means.step_length = 0.0);
        let runtime = Arc::new(RuntimeWalkModel::new(&self));
        let lengths = executor.map(self.styles.len(), &|style| walked_length(&runtime, style));
        self.means.iter_mut().zip(lengths).for_each(|(means, length)| means.step_length = length);
        self
    }
}

/// Mean length of a style's steps, metres.
fn walked_length(runtime: &Arc<RuntimeWalkModel>, style: usize) -> f64 {
    let mut walker = Walker::new(Arc::clone(runtime));
    for weights in &mut walker.planner.weights.0 {
        weights[style] = 1.0;
    }
    walker.reset(Vec3::ZERO, 0.0);
    let mut place_before = |step: u64| {
        while walker.next_step() < step {
            walker.advance();
        }
        walker.pose.root
    };
    let from = place_before(BEGINNING);
    f64::from((place_before(BEGINNING + MEASURED) - from).length()) / MEASURED as f64
}
