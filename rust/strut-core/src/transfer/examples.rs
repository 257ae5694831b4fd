//! Database rows from which each frame of a clip was predicted, for display with the prediction.

use super::blend::StyleBlend;
use super::body_part::BodyPart;
use super::frame::Trace;
use super::model::Model;
use crate::pose_vector::{DOFS, PoseRow, ROW};

/// A row of the database and its weight, 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Example {
    row: u32,
    weight: f32,
}

/// The neighbours of every frame of a clip in its heaviest class, nearest first.
#[derive(Clone, Debug, Default)]
pub struct Examples {
    /// Of all frames, one after the other.
    entries: Vec<Example>,
    /// Number of examples of each frame.
    counts: Vec<usize>,
    /// Styles, each with the index of the first example to which they apply.
    blends: Vec<(usize, StyleBlend)>,
}

impl Examples {
    /// Reserves memory for a clip of `frames` frames with `per_frame` examples each.
    pub fn with_capacity(frames: usize, per_frame: usize) -> Self {
        Self {
            entries: Vec::with_capacity(frames.saturating_mul(per_frame)),
            counts: Vec::with_capacity(frames),
            blends: Vec::new(),
        }
    }

    /// Adds the examples of a traced frame.
    pub fn record(&mut self, trace: &Trace<'_>) {
        if self.blends.last().is_none_or(|(_, last)| last != trace.blend) {
            self.blends.push((self.entries.len(), trace.blend.clone()));
        }
        let pairs = trace.neighbours.iter().zip(trace.neighbour_weights);
        self.entries.extend(pairs.map(|(n, &weight)| Example { row: n.row, weight }));
        self.counts.push(trace.neighbours.len());
    }

    /// Number of examples of each frame.
    pub fn counts(&self) -> &[usize] {
        &self.counts
    }

    /// Weight of each example, 0 to 1.
    pub fn weights(&self) -> impl Iterator<Item = f32> + '_ {
        self.entries.iter().map(|e| e.weight)
    }

    /// Each example in the styles of its frame: the weighted sum of its registered targets, as in `blended`, without
    /// limits.
    pub fn targets<'a>(&'a self, model: &'a Model) -> impl Iterator<Item = PoseRow> + 'a {
        let parts = BodyPart::of_row();
        let mut later = self.blends.iter().peekable();
        let mut blend = None;
        self.entries.iter().enumerate().map(move |(i, example)| {
            while let Some((_, next)) = later.next_if(|(first, _)| *first <= i) {
                blend = Some(next);
            }
            let mut sum = [0.0; ROW];
            let styles = 0..model.catalogue().styles.len();
            for (style, blend) in styles.filter_map(|style| Some((style, blend.filter(|b| b.is_active(style))?))) {
                let target = model.target_table(style).pose(example.row as usize);
                for d in 0..DOFS {
                    sum[d] += blend.weight(parts[d], style) * target[d];
                }
            }
            sum
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixtures::{BENT, NEUTRAL, database, walk};
    use crate::humanoid::Role;
    use crate::transfer::{ClipJob, NoClock, Options, Stylizer};
    use std::sync::Arc;

    /// Examples of a walk that is neutral at first and bent from frame 60 on.
    fn examples(model: &Arc<Model>) -> (Examples, ClipJob) {
        let mut job = ClipJob::new(Stylizer::new(Arc::clone(model), Options::DEFAULT).unwrap());
        let mut examples = Examples::default();
        for (i, pose) in walk(&NEUTRAL, 120, 0.0).poses.iter().enumerate() {
            job.set_styles(&[0.0, if i < 60 { 0.0 } else { 1.0 }]).unwrap();
            examples.record(&job.push(pose, &mut NoClock));
        }
        (examples, job)
    }

    #[test]
    fn every_frame_has_its_neighbours_in_the_styles_of_its_own_time() {
        let model = Arc::new(Model::new(database()));
        let (examples, _) = examples(&model);
        assert_eq!(examples.counts().len(), 120);
        assert_eq!(examples.counts().iter().sum::<usize>(), examples.weights().count());
        assert!(examples.weights().all(|w| (0.0..=1.0).contains(&w)));
        let lean_of = |row: &PoseRow| {
            let chart = &model.catalogue().chart;
            let up = [Role::Hips, Role::Spine, Role::Chest]
                .iter()
                .fold(crate::math::Quat::IDENTITY, |q, &role| q * chart.rotation(role, row))
                * crate::math::Vec3::Y;
            up.z
        };
        let leans: Vec<f32> = examples.targets(&model).map(|row| lean_of(&row)).collect();
        let turn: usize = examples.counts()[..60].iter().sum();
        let mean = |leans: &[f32]| leans.iter().sum::<f32>() / leans.len() as f32;
        let (before, after) = (mean(&leans[..turn]), mean(&leans[turn..]));
        assert!(after - before > 0.5 * (BENT.lean - NEUTRAL.lean), "{before} {after}");
    }

    #[test]
    fn the_prediction_is_among_its_examples() {
        let model = Arc::new(Model::new(database()));
        let (examples, job) = examples(&model);
        let chart = &model.catalogue().chart;
        let knee = |row: &PoseRow| chart.rotation(Role::LeftLowerLeg, row);
        let targets: Vec<PoseRow> = examples.targets(&model).collect();
        let first: usize = examples.counts()[..30].iter().sum();
        let own = &targets[first..][..examples.counts()[30]];
        let predicted = job.frames()[30].pose.rotations[Role::LeftLowerLeg.index()];
        let nearest = own.iter().map(|row| knee(row).inv_mul(predicted).angle()).fold(f32::INFINITY, f32::min);
        assert!(nearest < 0.05, "{nearest} rad from the nearest example");
    }
}
