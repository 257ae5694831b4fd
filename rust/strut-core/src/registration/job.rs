//! Registration of one action: its input, and quantities computed from it.

use super::example::Example;
use super::features::{self, Feature};
use super::gait::{Segment, SegmentKind};
use super::matching::Warper;
use super::options::Options;
use super::outcome::{FaultyCycle, Refusal};
use super::timeline::{self, CanonicalTime, Reference};
use super::{pairing, rest};
use crate::math::stats::median;
use crate::parallel::ParallelMap;
use std::ops::Range;

/// A clip turns in the wrong direction if it turns by more than the first angle, radians, against the action's usual
/// turn. There is a usual turn if this share of the clips turns by more than the second angle in the same direction.
const OPPOSITE_TURN: f32 = 0.6;
const USUAL_TURN: f32 = 0.9;
const USUAL_TURN_SHARE: f32 = 0.7;

/// Registration of one action.
#[derive(Clone, Copy, Debug)]
pub struct Job<'a> {
    /// All clips of the action, sorted by style.
    pub examples: &'a [Example],
    /// Number of styles in the database; the style of every example is below it.
    pub styles: usize,
    /// Neutral style, whose cycles define the canonical timeline.
    pub neutral: u16,
    /// Frames per second of all examples.
    pub rate_hz: f32,
    /// Settings.
    pub options: &'a Options,
}

impl Job<'_> {
    /// Refusals of clips that turn against the direction in which most clips of the action turn.
    pub(super) fn wrong_turns(&self) -> Vec<Option<Refusal>> {
        let turns: Vec<f32> = self.examples.iter().map(|e| e.turn(self.rate_hz)).collect();
        let usual = median(turns.iter().map(|&turn| turn.into())).unwrap_or(0.0) as f32;
        let agreeing = turns.iter().filter(|t| **t * usual > 0.0 && t.abs() > USUAL_TURN).count();
        let has_usual = usual.abs() > USUAL_TURN && agreeing as f32 >= USUAL_TURN_SHARE * turns.len() as f32;
        turns
            .iter()
            .map(|&turn| {
                let opposite = has_usual && turn * usual < 0.0 && turn.abs() > OPPOSITE_TURN;
                opposite.then_some(Refusal::TurnsTheOtherWay { turn, usual })
            })
            .collect()
    }

    /// Moving part of every clip as one segment.
    pub(super) fn uncut(&self) -> Vec<(Vec<Segment>, Vec<FaultyCycle>)> {
        let whole =
            |e: &Example| vec![Segment { frames: rest::moving(&e.point_cloud, self.rate_hz), kind: SegmentKind::Clip }];
        self.examples.iter().map(|e| (whole(e), Vec::new())).collect()
    }

    /// Data of an example for pairing.
    pub(super) fn part<'b>(
        &'b self,
        example: usize,
        features: &'b [Feature],
        segments: &'b [Segment],
    ) -> pairing::Part<'b> {
        let Example { style, point_cloud, .. } = &self.examples[example];
        pairing::Part { example, style: *style, features, point_cloud, segments }
    }

    /// Features of the accepted examples, empty for the others.
    pub(super) fn features(
        &self,
        refusals: &[Option<Refusal>],
        cuts: &[(Vec<Segment>, Vec<FaultyCycle>)],
        cyclic: bool,
        executor: &impl ParallelMap,
    ) -> Vec<Vec<Feature>> {
        let used: Vec<&Example> =
            self.examples.iter().zip(refusals).filter(|(_, r)| r.is_none()).map(|(e, _)| e).collect();
        let whole = |(segments, _): &(Vec<Segment>, _)| {
            segments.first().map_or(0, |s| s.frames.start)..segments.last().map_or(0, |s| s.frames.end)
        };
        let compared: Vec<Range<usize>> =
            cuts.iter().zip(refusals).filter(|(_, r)| r.is_none()).map(|(cut, _)| whole(cut)).collect();
        let mut features =
            features::of_examples(&used, &compared, self.styles, self.rate_hz, cyclic, executor).into_iter();
        let mut next = |r: &Option<Refusal>| if r.is_none() { features.next() } else { None };
        refusals.iter().map(|r| next(r).unwrap_or_default()).collect()
    }

    /// Most typical cycle (or clip) of the neutral style, or of all styles if the neutral style has none.
    pub(super) fn reference(
        &self,
        refusals: &[Option<Refusal>],
        cuts: &[(Vec<Segment>, Vec<FaultyCycle>)],
        features: &[Vec<Feature>],
        cyclic: bool,
    ) -> Option<Reference> {
        let candidates = |style: Option<u16>| -> Vec<(usize, Range<usize>)> {
            (0..self.examples.len())
                .filter(|&i| refusals[i].is_none() && style.is_none_or(|s| s == self.examples[i].style))
                .flat_map(|i| cuts[i].0.iter().map(move |s| (i, s)))
                .filter(|(_, s)| matches!(s.kind, SegmentKind::Cycle | SegmentKind::Clip))
                .map(|(i, s)| (i, s.frames.clone()))
                .collect()
        };
        Reference::choose(&candidates(Some(self.neutral)), features, cyclic)
            .or_else(|| Reference::choose(&candidates(None), features, cyclic))
    }

    /// Canonical times of the accepted examples; rejects examples that have none.
    pub(super) fn canonical_times(
        &self,
        refusals: &mut [Option<Refusal>],
        cuts: &[(Vec<Segment>, Vec<FaultyCycle>)],
        features: &[Vec<Feature>],
        reference: Option<&Reference>,
        executor: &impl ParallelMap,
    ) -> Vec<Option<CanonicalTime>> {
        let accepted: Vec<bool> = refusals.iter().map(Option::is_none).collect();
        let times = executor.map(self.examples.len(), &|i| {
            let reference = reference.filter(|_| accepted[i])?;
            let mut warper = Warper::new(self.options, self.rate_hz);
            timeline::canonical_time(&cuts[i].0, &features[i], reference, features, self.rate_hz, &mut warper)
        });
        for (refusal, time) in refusals.iter_mut().zip(&times) {
            if refusal.is_none() && time.is_none() {
                *refusal = Some(Refusal::NoWarp);
            }
        }
        times
    }
}
