//! The canonical timeline of an action: the time of its neutral reference cycle or clip (specification §4).

use super::features::Feature;
use super::gait::{Segment, SegmentKind};
use super::matching::{Warper, linear_distance};
use super::smooth::gaussian;
use super::warp::{Ends, Warp};
use std::ops::Range;

/// Durations are smoothed over this time: pace within a step is kept, jitter of the warp is not.
const PACE_SMOOTHING_SECS: f32 = 0.015;
/// Slowest and fastest pace: canonical frames per frame of a clip.
const PACE_RANGE: (f32, f32) = (0.1, 10.0);
/// Others that each candidate for the reference is compared with, at most.
const COMPARED: usize = 48;

/// The reference segment of an action.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Reference {
    /// Number of its example.
    pub(super) example: usize,
    /// Its frames.
    pub(super) frames: Range<usize>,
    /// Whether it is a gait cycle, whose time wraps around.
    pub(super) cyclic: bool,
}

impl Reference {
    /// Frames of the canonical timeline: of a cycle until it begins again.
    pub(super) fn canonical_frames(&self) -> f32 {
        if self.cyclic { self.frames.len() as f32 } else { self.frames.len().saturating_sub(1) as f32 }
    }

    /// The segment most like all others among candidates (example, frames) of about the median length.
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
    pub(super) time: Vec<f32>,
    pub(super) time_step: Vec<f32>,
}

/// Times an example by its segments. `None` if a segment cannot be warped to the reference.
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
    let reference_features = &of_example[reference.frames.start..=reference.frames.end.min(of_example.len() - 1)];
    let mut unwrapped: Vec<f32> = Vec::with_capacity(features.len());
    let mut cycles = 0.0;
    for segment in segments {
        let last = segment.frames.end.min(features.len() - 1);
        let piece = &features[segment.frames.start..=last];
        let warp = match segment.kind {
            SegmentKind::Clip => warper.warp(piece, reference_features, Ends::default())?,
            SegmentKind::Cycle | SegmentKind::Faulty => warper
                .warp(piece, reference_features, Ends::default())
                .unwrap_or_else(|| Warp::linear(piece.len(), 0.0, length, 0.0)),
            SegmentKind::LeadIn => {
                let tiled = tiled(reference_features, 2 * piece.len());
                let ends = Ends { open_begin: true, open_end: false };
                let mut warp = warper
                    .warp(piece, &tiled, ends)
                    .unwrap_or_else(|| Warp::linear(piece.len(), 0.0, (tiled.len() - 1) as f32, 0.0));
                for at in &mut warp.at {
                    *at -= (tiled.len() - 1) as f32;
                }
                warp
            }
            SegmentKind::LeadOut => {
                let tiled = tiled(reference_features, 2 * piece.len());
                let ends = Ends { open_begin: false, open_end: true };
                warper
                    .warp(piece, &tiled, ends)
                    .unwrap_or_else(|| Warp::linear(piece.len(), 0.0, (tiled.len() - 1) as f32, 0.0))
            }
        };
        unwrapped.extend(warp.at[..segment.frames.len()].iter().map(|at| cycles * length + at));
        if matches!(segment.kind, SegmentKind::Cycle | SegmentKind::Faulty) {
            cycles += 1.0;
        }
    }
    let time = if reference.cyclic {
        unwrapped.iter().map(|t| t - (t / length).floor() * length).collect()
    } else {
        unwrapped.clone()
    };
    Some(CanonicalTime { time, time_step: time_steps(&unwrapped, rate_hz) })
}

/// Whole repetitions of a cycle's features and the frame after the last, at least `frames` in all. A cycle's
/// features end with the next cycle's first frame.
fn tiled(cycle: &[Feature], frames: usize) -> Vec<Feature> {
    let period = cycle.len().saturating_sub(1).max(1);
    let count = frames.div_ceil(period).max(1) * period + 1;
    (0..count).map(|f| cycle[f % period]).collect()
}

/// Seconds per canonical frame from increasing canonical times.
fn time_steps(unwrapped: &[f32], rate_hz: f32) -> Vec<f32> {
    let last = unwrapped.len().saturating_sub(1);
    let pace: Vec<f32> = (0..unwrapped.len())
        .map(|f| {
            let (a, b) = (f.saturating_sub(1), (f + 1).min(last));
            ((unwrapped[b] - unwrapped[a]) / (b - a).max(1) as f32).clamp(PACE_RANGE.0, PACE_RANGE.1)
        })
        .collect();
    gaussian(&pace, PACE_SMOOTHING_SECS * rate_hz).iter().map(|p| 1.0 / (p * rate_hz)).collect()
}
