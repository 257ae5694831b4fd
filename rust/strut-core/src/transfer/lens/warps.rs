//! Comparison of the clips of an action, as in the registration when the database was built.

use super::error::{LensError, among};
use crate::catalogue::Catalogue;
use crate::humanoid::Proportions;
use crate::pose_vector::{Placement, PoseRow, point_cloud};
use crate::registration::{Compared, Comparison, Example, Stretch, WarpMethod};
use crate::transfer::Model;
use std::ops::Range;
use std::sync::Arc;

/// Clips of an action, with their indices in the database.
#[derive(Clone, Debug)]
pub struct Warps {
    model: Arc<Model>,
    clips: Vec<usize>,
    comparison: Comparison,
}

impl Warps {
    /// Computes the features of an action's clips. This takes a second for some minutes of motion.
    ///
    /// # Errors
    /// If the action does not exist.
    pub fn new(model: Arc<Model>, action: u16) -> Result<Self, LensError> {
        let catalogue = model.catalogue();
        among("action", action.into(), catalogue.actions.len())?;
        let of_action = catalogue.classes().iter().filter(|c| c.action == action);
        let clips: Vec<usize> = of_action.flat_map(|c| c.clips.clone()).collect();
        let examples: Vec<Example> = clips.iter().map(|&clip| example(catalogue, clip)).collect();
        let comparison = Comparison::new(&examples, catalogue.styles.len(), catalogue.neutral, catalogue.rate_hz);
        Ok(Self { model, clips, comparison })
    }

    /// The shared model.
    pub fn model(&self) -> &Arc<Model> {
        &self.model
    }

    /// Gait cycles of a clip: from one left heel strike to the next.
    ///
    /// # Errors
    /// If the clip does not belong to the action.
    pub fn cycles(&self, clip: usize) -> Result<Vec<Range<usize>>, LensError> {
        Ok(self.comparison.cycles(self.example(clip)?).collect())
    }

    /// Compares two ranges of frames.
    ///
    /// # Errors
    /// If one of them does not exist.
    pub fn compare(&self, a: &Stretch, b: &Stretch, by: WarpMethod) -> Result<Compared, LensError> {
        let own = |(clip, frames): &Stretch| Ok::<_, LensError>((self.example(*clip)?, frames.clone()));
        let not_there = || {
            let frames = |clip: usize| self.model.catalogue().clips[clip].frames;
            let last = |s: &Stretch| *s.1.end();
            let (stretch, frames) = if last(a) >= frames(a.0) { (a, frames(a.0)) } else { (b, frames(b.0)) };
            LensError::NotThere { what: "stretch of frames to", index: last(stretch), last: frames - 1 }
        };
        self.comparison.compare(&own(a)?, &own(b)?, by).ok_or_else(not_there)
    }

    /// For every frame of `a` the frame of `b`, relative to the start of its range, that the database holds as its
    /// counterpart: exact where the clips have scripts. NaN where it is in another clip.
    ///
    /// # Errors
    /// If one of the clips does not belong to the action.
    pub fn recorded(&self, a: &Stretch, b: &Stretch) -> Result<Vec<f32>, LensError> {
        self.example(a.0)?;
        self.example(b.0)?;
        let catalogue = self.model.catalogue();
        let (from, to) = (&catalogue.clips[a.0], &catalogue.clips[b.0]);
        let rows = to.rows();
        let counterpart = |frame: usize| {
            let row = from.first_frame + frame.min(from.frames - 1);
            let mut found = catalogue.counterparts(row, to.style);
            found.find(|at| (rows.start as f32..rows.end as f32).contains(at)).unwrap_or(f32::NAN)
        };
        let first = (rows.start + b.1.start()) as f32;
        Ok(a.1.clone().map(|frame| counterpart(frame) - first).collect())
    }

    fn example(&self, clip: usize) -> Result<usize, LensError> {
        let last = self.model.catalogue().clips.len().saturating_sub(1);
        let not_there = LensError::NotThere { what: "clip of the action", index: clip, last };
        self.clips.iter().position(|&c| c == clip).ok_or(not_there)
    }
}

/// A clip in the form that registration reads.
fn example(catalogue: &Catalogue, clip: usize) -> Example {
    let clip = &catalogue.clips[clip];
    let pose: Vec<PoseRow> = clip.rows().map(|row| catalogue.rows().get(row)).collect();
    let body: &Proportions = &catalogue.proportions;
    Example {
        style: clip.style,
        point_cloud: pose
            .iter()
            .map(|row| point_cloud(body, &catalogue.chart.decode(row, Placement::default()), 0.0))
            .collect(),
        contact: clip.rows().map(|row| catalogue.contact(row).map(|planted| planted != 0)).collect(),
        pose,
        script: None,
    }
}
