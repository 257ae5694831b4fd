//! Training pairs of the baselines.

use std::ops::Range;
use strut_core::catalogue::{Catalogue, TargetTable};
use strut_core::math::float_funcs::ln;
use strut_core::pose_vector::{DOFS, PoseRow};

/// Rows of some classes of a database and their targets in one style.
#[derive(Clone, Debug)]
pub(super) struct Pairs<'a> {
    /// Catalogue, with their frame rate and ranges.
    pub(super) catalogue: &'a Catalogue,
    /// x.
    pub(super) inputs: Vec<PoseRow>,
    /// y.
    pub(super) targets: Vec<PoseRow>,
    /// Index of the style.
    pub(super) style: u16,
    /// Duration of each y, seconds.
    step_secs: Vec<f32>,
    /// Rows in sequence: one range for each clip, of at least two rows.
    pub(super) segments: Vec<Range<usize>>,
}

impl<'a> Pairs<'a> {
    /// Pairs of some classes. Classes without the style are omitted, unless none would be left; then the targets of
    /// rows are the rows themselves.
    pub(super) fn new(catalogue: &'a Catalogue, targets: &TargetTable, classes: &[usize]) -> Self {
        let any = classes.iter().any(|&c| targets.class_has_target(c));
        let segments = classes
            .iter()
            .filter(|&&c| targets.class_has_target(c) || !any)
            .flat_map(|&c| catalogue.clips[catalogue.classes()[c].clips.clone()].iter())
            .map(strut_core::database::Clip::rows)
            .filter(|rows| rows.len() >= 2)
            .collect();
        Self {
            catalogue,
            inputs: catalogue.rows().to_vec(),
            targets: (0..catalogue.frames()).map(|row| targets.pose(row)).collect(),
            style: targets.style(),
            step_secs: (0..catalogue.frames()).map(|row| targets.step_secs(row)).collect(),
            segments,
        }
    }

    /// Rows that have a predecessor, in order: the t of xₜ₋₁, xₜ, yₜ₋₁, yₜ.
    pub(super) fn rows(&self) -> impl Iterator<Item = usize> + Clone + '_ {
        self.segments.iter().flat_map(|s| s.start + 1..s.end)
    }

    /// Logarithm of the target's duration in frames at a row: 0 if the style keeps the input's tempo.
    pub(super) fn log_duration(&self, row: usize) -> f64 {
        f64::from(ln((self.step_secs[row] * self.catalogue.rate_hz).max(1e-3)))
    }

    /// Mean and standard deviation of each degree of freedom of some rows over the pairs.
    pub(super) fn moments(&self, rows: &[PoseRow]) -> [Vec<f64>; 2] {
        let (mut mean, mut deviation) = (vec![0.0; DOFS], vec![0.0; DOFS]);
        let n = self.segments.iter().map(Range::len).sum::<usize>().max(1) as f64;
        for row in self.segments.iter().cloned().flatten() {
            mean.iter_mut().zip(&rows[row]).for_each(|(m, v)| *m += f64::from(*v) / n);
        }
        for row in self.segments.iter().cloned().flatten() {
            for ((s, m), v) in deviation.iter_mut().zip(&mean).zip(&rows[row]) {
                *s += (f64::from(*v) - m) * (f64::from(*v) - m) / n;
            }
        }
        for s in &mut deviation {
            *s = s.sqrt();
        }
        [mean, deviation]
    }
}
