//! The model's curve of one joint over a pair of steps, for display.

use super::model::{SIDES, Side, Stream, StyleMeans, WalkModel};
use super::statistics::states;
use super::walker::{RuntimeWalkModel, Walker, WeightsError};
use crate::humanoid::Role;
use crate::math::{Vec3, exp_map};
use std::sync::Arc;

/// Steps that are walked before the displayed pair, so that its trajectory has a past.
pub(super) const STEPS_BEFORE: u64 = 2;

/// One frame of a [`JointCurve`]; angles in radians from the joint's mean rotation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvePoint {
    /// The synthesised angle.
    pub angle: f32,
    /// Mean of the frame's state.
    pub mean: f32,
    /// Standard deviation of that state.
    pub deviation: f32,
    /// The foot that swings.
    pub side: Side,
    /// The state, 0 to 4.
    pub state: usize,
}

/// A joint's angle through a left step and a right one.
#[derive(Clone, Debug, PartialEq)]
pub struct JointCurve {
    /// The axis of the joint's own frame about which it turns most: 0 to 2.
    pub axis: usize,
    /// One point per frame.
    pub points: Vec<CurvePoint>,
}

impl JointCurve {
    /// Curve of one mixture of styles for the left steps and one for the right steps, with one weight per style.
    ///
    /// # Errors
    /// See [`WeightsError`].
    pub fn new(
        model: &WalkModel,
        runtime: &Arc<RuntimeWalkModel>,
        weights: [&[f32]; SIDES],
        joint: Role,
    ) -> Result<Self, WeightsError> {
        let mut walker = Walker::new(Arc::clone(runtime));
        walker.set_sides(weights)?;
        let average = model.average();
        let mixed = mixed_sides(model, &average, weights);
        let dims = 3 * joint.index()..3 * joint.index() + 3;
        let pose = Stream::Static as usize;
        let spread = |d: usize| {
            let means = || states().map(|(side, state)| average.means[side][state][pose][d]);
            means().fold(f64::NEG_INFINITY, f64::max) - means().fold(f64::INFINITY, f64::min)
        };
        let first = dims.start;
        let d = dims.reduce(|a, b| if spread(b) > spread(a) { b } else { a }).unwrap_or(first);
        let axis = d - first;

        walker.reset(Vec3::ZERO, 0.0);
        let mut points = Vec::new();
        loop {
            let rotation = walker.advance().rotations[joint.index()];
            let (step, side) = walker.step();
            if step >= STEPS_BEFORE + SIDES as u64 {
                break;
            }
            if step >= STEPS_BEFORE {
                let state = walker.state();
                let angle = exp_map::log(model.reference[joint.index()].inv_mul(rotation)).to_array()[axis];
                let mean = mixed[side as usize].means[side as usize][state][pose][d] as f32;
                let deviation = model.variances[side as usize][state][pose][d].max(0.0).sqrt() as f32;
                points.push(CurvePoint { angle, mean, deviation, side, state });
            }
        }
        Ok(Self { axis, points })
    }
}

/// The mixed means for the steps of either foot.
pub(super) fn mixed_sides(model: &WalkModel, average: &StyleMeans, weights: [&[f32]; SIDES]) -> [StyleMeans; SIDES] {
    weights.map(|weights| model.mix(average, &weights.iter().map(|w| f64::from(*w)).collect::<Vec<_>>()))
}
