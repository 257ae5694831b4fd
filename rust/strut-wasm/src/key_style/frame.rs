//! A frame as numbers.

use crate::common::{EngineError, write_floats};
use js_sys::Float32Array;
use strut_core::humanoid::{POSE_FLOATS, Pose};
use strut_core::somn::Style;

/// The pose, the share of each component, the style measured on the pose and the style that the pose was synthesised
/// from: one number per component, and one per axis.
pub(crate) struct Frame {
    axes: usize,
    floats: Box<[f32]>,
}

impl Frame {
    pub(crate) fn new(components: usize, axes: usize) -> Self {
        Self { axes, floats: vec![0.0; POSE_FLOATS + components + 2 * axes].into() }
    }

    /// Writes all numbers to an array of that length.
    pub(crate) fn write(&self, into: &Float32Array) -> Result<(), EngineError> {
        write_floats(&self.floats, into)
    }

    pub(crate) fn show(&mut self, pose: &Pose, weights: &[f64], measured: &Style, reached: &Style) {
        let Some((floats, rest)) = self.floats.split_first_chunk_mut::<POSE_FLOATS>() else { return };
        pose.write_to(floats);
        let styles = measured[..self.axes].iter().chain(&reached[..self.axes]);
        rest.iter_mut().zip(weights.iter().chain(styles)).for_each(|(out, value)| *out = *value as f32);
    }
}

/// Reads a style from numbers; missing ones are 0.
pub(crate) fn style(values: &[f64]) -> Style {
    let mut style = Style::default();
    style.iter_mut().zip(values).for_each(|(s, value)| *s = *value);
    style
}
