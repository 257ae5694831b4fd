//! Measurement of the length of a style's steps in a synthesised walk (`docs/methods/hsmm.md` §11).

use super::step_length::SHARE;
use super::{RuntimeWalkModel, Walker};
use crate::hsmm::model::WalkModel;
use crate::math::Vec3;
use crate::parallel::ParallelMap;
use std::sync::Arc;

/// Steps that are excluded at the start of a measured walk, without and with a target length, and steps that are measured: an
/// equal number of either foot.
const BEGINNING: u64 = 2;
const COMING_TO_LENGTH: u64 = 20;
const MEASURED: u64 = 20;
/// Weights at which the reachable step length of a style is measured: its opposite, and twice the style.
const BEYOND: [f32; 2] = [-1.0, 2.0];

impl WalkModel {
    /// Measures the lengths of every style's steps in walks without a target length, and the corrections of the proportional
    /// lengths where the legs cannot swing far enough, in the style's opposite and in twice the style.
    pub fn with_walked_lengths(mut self, executor: &impl ParallelMap) -> Self {
        for means in &mut self.means {
            (means.step_length, means.step_length_bends) = (0.0, [0.0; 2]);
        }
        let runtime = Arc::new(RuntimeWalkModel::new(&self));
        let lengths = executor.map(self.styles.len(), &|style| walked(&runtime, style, 1.0, BEGINNING).length);
        self.means.iter_mut().zip(lengths).for_each(|(means, length)| means.step_length = length);
        let runtime = Arc::new(RuntimeWalkModel::new(&self));
        let average = self.average().step_length;
        let bends = executor.map(self.styles.len(), &|style| {
            BEYOND.map(|weight| {
                let asked = average + f64::from(weight) * (self.means[style].step_length - average);
                let Walked { length, swing } = walked(&runtime, style, weight, COMING_TO_LENGTH);
                if SHARE.contains(&swing) { (length - asked) / f64::from(weight - weight.clamp(0.0, 1.0)) } else { 0.0 }
            })
        });
        self.means.iter_mut().zip(bends).for_each(|(means, bends)| means.step_length_bends = bends);
        self
    }
}

/// A measured walk.
struct Walked {
    /// Mean length of its steps, metres.
    length: f64,
    /// The factor of the legs' swing at its end.
    swing: f32,
}

/// Walks in a style with a weight.
fn walked(runtime: &Arc<RuntimeWalkModel>, style: usize, weight: f32, beginning: u64) -> Walked {
    let mut walker = Walker::new(Arc::clone(runtime));
    for weights in &mut walker.planner.weights.0 {
        weights[style] = weight;
    }
    walker.reset(Vec3::ZERO, 0.0);
    let mut place_before = |step: u64| {
        while walker.next_step() < step {
            walker.advance();
        }
        walker.pose.root
    };
    let from = place_before(beginning);
    let way = f64::from((place_before(beginning + MEASURED) - from).length());
    Walked { length: way / MEASURED as f64, swing: walker.planner.swing }
}
