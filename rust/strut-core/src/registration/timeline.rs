//! Canonical timeline of an action: the time of its neutral reference cycle or clip (`docs/methods/mar.md` §4).

use super::features::Feature;
use super::gait::{Segment, SegmentKind, covered};
use super::matching::{WHOLE_CLIP, Warper, linear_distance};
use super::outcome::{Counterpart, Counterparts};
use super::warp::{Ends, Warp};
use crate::math::gaussian::smoothed;
use std::ops::Range;

/// Durations are smoothed over this time, seconds: changes of pace within a step are kept, and jitter of the warp,
/// which would bias mean durations upwards, is removed (timing error 13.9 ms at 0.03 s, 13.5 at 0.05).
const PACE_SMOOTHING_SECS: f32 = 0.05;
/// Slowest and fastest pace: canonical frames per frame of a clip.
const PACE_RANGE: (f32, f32) = (0.1, 10.0);
/// Greatest number of segments with which each candidate for the reference is compared.
const COMPARED: usize = 48;

/// Reference segment of an action.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Reference {
    /// Index of its example.
    pub(super) example: usize,
    /// Its frames.
    pub(super) frames: Range<usize>,
    /// Whether it is a gait cycle, in which time is periodic.
    pub(super) cyclic: bool,
}

impl Reference {
    /// Length of the canonical timeline in frames; for a cycle its period.
    pub(super) fn canonical_frames(&self) -> f32 {
        if self.cyclic { self.frames.len() as f32 } else { self.frames.len().saturating_sub(1) as f32 }
    }

    /// Last frame that is compared, in an example of `total` frames: for a cycle the strike that ends it.
    fn last(&self, total: usize) -> usize {
        if self.cyclic { self.frames.end.min(total - 1) } else { self.frames.end - 1 }
    }

    /// Chooses the segment that is most similar to all others, among candidates (example, frames) of about the median
    /// length.
    pub(super) fn choose(
        candidates: &[(usize, Range<usize>)],
        features: &[Vec<Feature>],
        cyclic: bool,
    ) -> Option<Self> {
        let mut lengths: Vec<usize> = candidates.iter().map(|(_, f)| f.len()).collect();
        lengths.sort_unstable();
        let median = *lengths.get(lengths.len() / 2)? as f32;
        let typical = |f: &Range<usize>| (f.len() as f32 - median).abs() <= 0.15 * median;
        let compared = || candidates.iter().step_by(candidates.len().div_ceil(COMPARED).max(1));
        let of = |(e, f): &(usize, Range<usize>)| &features[*e][f.clone()];
        let mut best: Option<(f32, &(usize, Range<usize>))> = None;
        for candidate in candidates.iter().filter(|(_, f)| typical(f)) {
            let here = of(candidate);
            let cost: f32 = compared().map(|other| linear_distance(here, of(other))).sum();
            if best.is_none_or(|(least, _)| cost < least) {
                best = Some((cost, candidate));
            }
        }
        best.map(|(_, (example, frames))| Self { example: *example, frames: frames.clone(), cyclic })
    }
}

/// Canonical time and seconds per canonical frame of every frame of an example.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct CanonicalTime {
    /// Strictly increasing: the times of successive cycles are concatenated.
    unwrapped: Vec<f32>,
    /// The same times, for cycles modulo the period.
    pub(super) time: Vec<f32>,
    pub(super) time_step: Vec<f32>,
}

impl CanonicalTime {
    fn new(unwrapped: Vec<f32>, reference: &Reference, rate_hz: f32) -> Self {
        let length = reference.canonical_frames();
        let wrapped = |t: &f32| if reference.cyclic { t - (t / length).floor() * length } else { *t };
        Self { time: unwrapped.iter().map(wrapped).collect(), time_step: time_steps(&unwrapped, rate_hz), unwrapped }
    }
}

/// Computes the times of an example from its segments; `None` if a segment cannot be warped to the reference.
pub(super) fn canonical_time(
    segments: &[Segment],
    features: &[Feature],
    reference: &Reference,
    all_features: &[Vec<Feature>],
    rate_hz: f32,
    warper: &mut Warper,
) -> Option<CanonicalTime> {
    let length = reference.canonical_frames();
    let of_example = &all_features[reference.example];
    let reference_features = &of_example[reference.frames.start..=reference.last(of_example.len())];
    // Canonical times of every segment's frames; the cycles are numbered consecutively.
    let mut warps: Vec<Warp> = Vec::with_capacity(segments.len());
    let mut cycles = 0.0;
    for segment in segments {
        let last = segment.last(features.len());
        let piece = &features[segment.frames.start..=last];
        let (target, ends) = match segment.kind {
            SegmentKind::LeadIn => {
                (tiled(reference_features, 2 * piece.len()), Ends { open_begin: Ends::OPEN, open_end: 0, skip: None })
            }
            SegmentKind::LeadOut => {
                (tiled(reference_features, 2 * piece.len()), Ends { open_begin: 0, open_end: Ends::OPEN, skip: None })
            }
            SegmentKind::Clip => (reference_features.to_vec(), WHOLE_CLIP),
            _ => (reference_features.to_vec(), Ends::default()),
        };
        let last = (target.len() - 1) as f32;
        let found = warper.warp(piece, &target, ends);
        let mut warp = match segment.kind {
            SegmentKind::Clip => found?,
            _ => found.unwrap_or_else(|| Warp::linear(piece.len(), 0.0, last, 0.0)),
        };
        let ahead = if segment.kind == SegmentKind::LeadIn { last } else { 0.0 };
        for at in &mut warp.at {
            *at += cycles * length - ahead;
        }
        warps.push(warp);
        if matches!(segment.kind, SegmentKind::Cycle | SegmentKind::Faulty) {
            cycles += 1.0;
        }
    }
    // At a border the times of both segments have equal weight; away from it the weights change linearly.
    let reach = warper.reach().max(1) as f32;
    let at = |k: usize, frame: usize| warps[k].extrapolated(frame as isize - segments[k].frames.start as isize);
    let mut unwrapped: Vec<f32> = Vec::with_capacity(features.len());
    for (k, segment) in segments.iter().enumerate() {
        for frame in covered(segments, k, features.len()) {
            let share = |distance: usize| 0.5 * (1.0 - distance as f32 / reach).max(0.0);
            let here = at(k, frame);
            let mut time = here;
            if k > 0 {
                time += share(frame - segment.frames.start) * (at(k - 1, frame) - here);
            }
            if k + 1 < segments.len() {
                time += share(segment.frames.end - frame) * (at(k + 1, frame) - here);
            }
            let earliest = unwrapped.last().map_or(time, |t| t + PACE_RANGE.0);
            unwrapped.push(time.max(earliest));
        }
    }
    Some(CanonicalTime::new(unwrapped, reference, rate_hz))
}

/// Mean canonical time of a clip according to its counterparts in the neutral style. Each counterpart has its own warp
/// to the reference, so that their mean is less uncertain than a single warp, and it is consistent with the
/// counterparts. `counterparts` are those of the clip in the neutral style, frame by frame.
pub(super) fn agreed<'a>(
    own: &CanonicalTime,
    counterparts: impl Iterator<Item = &'a Counterparts>,
    all: &[Option<CanonicalTime>],
    reference: &Reference,
    rate_hz: f32,
) -> CanonicalTime {
    let length = reference.canonical_frames();
    let time_at = |c: &Counterpart| {
        let there = &all[c.example as usize].as_ref()?.unwrapped;
        let i = (c.frame as usize).min(there.len() - 1);
        let next = there[(i + 1).min(there.len() - 1)];
        Some(there[i] + (next - there[i]) * (c.frame - i as f32))
    };
    let mut unwrapped: Vec<f32> = Vec::with_capacity(own.unwrapped.len());
    for (&time, counterparts) in own.unwrapped.iter().zip(counterparts) {
        let (mut sum, mut count) = (0.0, 0.0);
        for there in counterparts.iter().flatten().filter_map(time_at) {
            let ahead = there - time;
            sum += if reference.cyclic { ahead - (ahead / length).round() * length } else { ahead };
            count += 1.0;
        }
        let agreed = if count > 0.0 { time + sum / count } else { time };
        let earliest = unwrapped.last().map_or(agreed, |t| t + PACE_RANGE.0);
        unwrapped.push(agreed.max(earliest));
    }
    CanonicalTime::new(unwrapped, reference, rate_hz)
}

/// Repetitions of a cycle's features and the frame after the last repetition, at least `frames` in total. A cycle's
/// features end with the next cycle's first frame.
fn tiled(cycle: &[Feature], frames: usize) -> Vec<Feature> {
    let period = cycle.len().saturating_sub(1).max(1);
    let count = frames.div_ceil(period).max(1) * period + 1;
    (0..count).map(|f| cycle[f % period]).collect()
}

/// Seconds per canonical frame from increasing canonical times.
pub(crate) fn time_steps(unwrapped: &[f32], rate_hz: f32) -> Vec<f32> {
    let last = unwrapped.len().saturating_sub(1);
    let pace: Vec<f32> = (0..unwrapped.len())
        .map(|f| {
            let (a, b) = (f.saturating_sub(1), (f + 1).min(last));
            ((unwrapped[b] - unwrapped[a]) / (b - a).max(1) as f32).clamp(PACE_RANGE.0, PACE_RANGE.1)
        })
        .collect();
    smoothed(&pace, PACE_SMOOTHING_SECS * rate_hz).iter().map(|p| 1.0 / (p * rate_hz)).collect()
}
