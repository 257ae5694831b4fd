//! Registers an additional clip with clips that are already registered.

use super::gait::{self, SegmentKind};
use super::job::Job;
use super::matching::Warper;
use super::outcome::{Counterparts, Refusal};
use super::pairing::{self, Part};
use crate::parallel::ParallelMap;

/// Correspondence of a clip in a new style with the others of its action.
#[derive(Clone, Debug, PartialEq)]
pub struct Addition {
    /// Its counterparts: frames × styles; its own style is the last.
    pub counterparts: Vec<Counterparts>,
    /// For every other example, the counterparts of its frames in the clip's style.
    pub of_others: Vec<Vec<Counterparts>>,
    /// Mean cost of its warps to the others (squared feature distance per frame).
    pub cost: f32,
}

impl Job<'_> {
    /// Registers the last example, the only one of the last style, with the others, whose correspondence is kept. The
    /// result is that of [`Job::run`], in the time of one clip. Scripts are ignored.
    ///
    /// # Errors
    /// If the clip does not fit the others. If they walk or run, it must contain a whole gait cycle.
    pub fn run_last(&self, executor: &impl ParallelMap) -> Result<Addition, Refusal> {
        let (last, style) = (self.examples.len() - 1, self.styles - 1);
        let mut refusals = self.wrong_turns();
        let wrong_turn = refusals[last].take();
        refusals.fill(None);
        let (clip, others) = (&self.examples[last..], &self.examples[..last]);
        let locomotion = gait::is_locomotion(others, self.rate_hz);
        let cuts = if locomotion { gait::cut(self.examples, self.styles, self.rate_hz) } else { self.uncut() };
        if !locomotion && gait::is_locomotion(clip, self.rate_hz) {
            return Err(Refusal::Gait);
        }
        if locomotion && cuts[last].0.iter().all(|s| s.kind != SegmentKind::Cycle) {
            return Err(Refusal::NoGait);
        }
        if let Some(refusal) = wrong_turn {
            return Err(refusal);
        }
        let features = self.features(&refusals, &cuts, locomotion, executor);
        let parts: Vec<Part> = (0..self.examples.len()).map(|i| self.part(i, &features[i], &cuts[i].0)).collect();
        let mut paired = executor.map(parts.len(), &|i| {
            let styles = if i == last { 0..self.styles } else { style..self.styles };
            pairing::pair(&parts[i], &parts, styles, self.options, &mut Warper::new(self.options, self.rate_hz))
        });
        let own = paired.pop().unwrap_or_default();
        Ok(Addition {
            counterparts: own.counterparts,
            of_others: paired.into_iter().map(|p| p.counterparts).collect(),
            cost: own.cost.ok_or(Refusal::NoWarp)?,
        })
    }
}
