//! Counterparts: each segment is registered to the pieces of a style that fit it best (`docs/methods/mar.md` §4).

use super::features::Feature;
use super::gait::{Segment, SegmentKind, covered};
use super::matching::{Match, Piece, WHOLE_CLIP, Warper};
use super::options::{MAX_COUNTERPARTS, Options};
use super::outcome::{Counterpart, Counterparts};
use super::warp::{Ends, Warp};
use crate::humanoid::JOINTS;
use crate::math::{Vec3, sort_by_number};
use std::ops::Range;

/// Factor by which the frames of a lead-in or lead-out may be stretched towards the open end.
const OPEN_REACH: usize = 2;

/// Features and segments of an accepted example.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part<'a> {
    /// Index of the example.
    pub(super) example: usize,
    /// Index of its style.
    pub(super) style: u16,
    /// Features of its frames.
    pub(super) features: &'a [Feature],
    /// Heading-free joint positions of its frames, metres.
    pub(super) point_cloud: &'a [[Vec3; JOINTS]],
    /// Its segments.
    pub(super) segments: &'a [Segment],
}

/// Counterparts of one example: frames × requested styles.
#[derive(Clone, Debug, Default)]
pub(super) struct Paired {
    pub(super) counterparts: Vec<Counterparts>,
    /// Mean cost of the matches; `None` without matches.
    pub(super) cost: Option<f32>,
}

/// Finds the counterparts of an example in some styles, in all examples of its action including itself.
pub(super) fn pair(part: &Part, all: &[Part], styles: Range<usize>, options: &Options, warper: &mut Warper) -> Paired {
    let mut counterparts: Vec<Counterparts> = vec![[None; MAX_COUNTERPARTS]; part.features.len() * styles.len()];
    let (mut cost_sum, mut cost_count) = (0.0, 0);
    for (column, style) in styles.clone().enumerate() {
        let others: Vec<&Part> = all.iter().filter(|p| usize::from(p.style) == style).collect();
        if others.is_empty() {
            continue;
        }
        let mut matches: Vec<Vec<Match>> =
            part.segments.iter().map(|s| matches_of(s, part, &others, options, warper)).collect();
        for m in matches.iter().flatten() {
            cost_sum += m.warp.cost;
            cost_count += 1;
        }
        let changes = changes(part, &mut matches, &others, warper.reach());
        let last_frame = |example| others.iter().find(|o| o.example == example).map_or(0, |o| o.features.len() - 1);
        fill(part, &matches, &changes, last_frame, |frame, found| counterparts[frame * styles.len() + column] = found);
    }
    Paired { counterparts, cost: (cost_count > 0).then(|| cost_sum / cost_count as f32) }
}

/// Best matches of a segment in one style: at least one if the style has an example.
fn matches_of(segment: &Segment, part: &Part, others: &[&Part], options: &Options, warper: &mut Warper) -> Vec<Match> {
    let last = segment.last(part.features.len());
    let a =
        Piece { example: part.example, all: part.features, first: segment.frames.start, last, ends: Ends::default() };
    let frames = last + 1 - segment.frames.start;
    let pieces: Vec<Piece> = others.iter().flat_map(|o| pieces_for(segment, frames, o)).collect();
    let mut best = |pieces: &[Piece]| warper.best(&a, pieces, options.candidates, options.counterparts());
    let mut matches = best(&pieces);
    if matches.is_empty() {
        let anywhere: Vec<Piece> = others
            .iter()
            .map(|o| Piece {
                example: o.example,
                all: o.features,
                first: 0,
                last: o.features.len() - 1,
                ends: Ends { open_begin: Ends::OPEN, open_end: Ends::OPEN, skip: None },
            })
            .collect();
        matches = best(&anywhere);
    }
    if matches.is_empty() {
        // Longer than any piece in the style by more than the slope limit: linear time is the only possibility.
        matches.extend(others.iter().max_by_key(|o| o.features.len()).map(|o| Match {
            example: o.example,
            warp: Warp::linear(frames, 0.0, (o.features.len() - 1) as f32, 0.0),
        }));
    }
    matches
}

/// Pieces of another example with which a segment of `n` frames may be matched.
fn pieces_for<'a>(segment: &Segment, n: usize, other: &Part<'a>) -> Vec<Piece<'a>> {
    let end = other.features.len() - 1;
    let piece = |first: usize, last: usize, ends: Ends| Piece {
        example: other.example,
        all: other.features,
        first,
        last,
        ends,
    };
    let strikes = || {
        other
            .segments
            .iter()
            .filter(|s| matches!(s.kind, SegmentKind::Cycle | SegmentKind::LeadOut))
            .map(|s| s.frames.start)
    };
    let reach = OPEN_REACH * n;
    match segment.kind {
        SegmentKind::Clip => {
            let whole = other.segments.iter().filter(|s| s.kind == SegmentKind::Clip);
            whole.map(|s| piece(s.frames.start, s.frames.end - 1, WHOLE_CLIP)).collect()
        }
        SegmentKind::Cycle => other
            .segments
            .iter()
            .filter(|s| s.kind == SegmentKind::Cycle)
            .map(|s| piece(s.frames.start, s.frames.end, Ends::default()))
            .collect(),
        SegmentKind::LeadIn => {
            let open = Ends { open_begin: Ends::OPEN, open_end: 0, skip: None };
            // A shorter piece would be stretched to the length of the lead-in.
            strikes().filter(|s| s + 1 >= n).map(|s| piece(s.saturating_sub(reach), s, open)).collect()
        }
        SegmentKind::LeadOut => {
            let open = Ends { open_begin: 0, open_end: Ends::OPEN, skip: None };
            strikes().filter(|s| end - s + 1 >= n).map(|s| piece(s, (s + reach).min(end), open)).collect()
        }
        SegmentKind::Faulty => vec![piece(0, end, Ends { open_begin: Ends::OPEN, open_end: Ends::OPEN, skip: None })],
    }
}

/// Frames at which the matches of a segment change to those of the next: for every border and slot the frames after the
/// border (negative: before it). All matches have equal weight in the mean, so that they cannot be cross-faded; a match
/// is replaced at the frame where both are most similar. The matches of the later segment are sorted by their slots.
fn changes(part: &Part, matches: &mut [Vec<Match>], others: &[&Part], reach: usize) -> Vec<Vec<isize>> {
    let reach = reach as isize;
    let points = |m: &Match, segment: &Segment, frame: isize| -> Option<&[Vec3; JOINTS]> {
        let of = others.iter().find(|o| o.example == m.example)?;
        of.point_cloud.get(m.warp.extrapolated(frame - segment.frames.start as isize).max(0.0).round() as usize)
    };
    let mut changes = Vec::with_capacity(matches.len());
    for (k, segments) in part.segments.windows(2).enumerate() {
        let border = segments[1].frames.start as isize;
        let (before, after) = (&matches[k], &matches[k + 1]);
        let mut options: Vec<(f32, usize, usize, isize)> = Vec::with_capacity(before.len() * after.len());
        for (slot, old) in before.iter().enumerate() {
            for (number, new) in after.iter().enumerate() {
                let distance_at = |&after: &isize| {
                    let (a, b) = (points(old, &segments[0], border + after), points(new, &segments[1], border + after));
                    let apart = |(a, b): (&[Vec3; JOINTS], &[Vec3; JOINTS])| -> f32 {
                        a.iter().zip(b).map(|(a, b)| (*a - *b).length_squared()).sum()
                    };
                    a.zip(b).map_or(f32::INFINITY, apart)
                };
                // Of equal instants the one nearest to the border.
                let nearest_first = (0..=reach).flat_map(|d| [d, -d]);
                let nearest = nearest_first.map(|d| (distance_at(&d), d)).min_by(|a, b| a.0.total_cmp(&b.0));
                options.extend(nearest.map(|(distance, d)| (distance, slot, number, d)));
            }
        }
        sort_by_number(&mut options, |(distance, ..)| *distance);
        let mut slot_of: Vec<Option<usize>> = vec![None; after.len()];
        let mut change = vec![0; before.len().max(after.len())];
        let mut taken = vec![false; change.len()];
        for (_, slot, number, d) in options {
            if !taken[slot] && slot_of[number].is_none() {
                (taken[slot], slot_of[number], change[slot]) = (true, Some(slot), d);
            }
        }
        // If a segment has more matches than the one before, they fill the free slots.
        let mut free = (0..taken.len()).filter(|&slot| !taken[slot]);
        let mut ordered: Vec<(usize, Match)> = slot_of
            .into_iter()
            .zip(std::mem::take(&mut matches[k + 1]))
            .map(|(slot, m)| (slot.or_else(|| free.next()).unwrap_or(usize::MAX), m))
            .collect();
        sort_by_number(&mut ordered, |(slot, _)| *slot as f32);
        matches[k + 1] = ordered.into_iter().map(|(_, m)| m).collect();
        changes.push(change);
    }
    changes
}

/// Sets the counterparts of every frame: in each slot the match of its segment, or of a neighbouring segment near a
/// border.
fn fill(
    part: &Part,
    matches: &[Vec<Match>],
    changes: &[Vec<isize>],
    last_frame: impl Fn(usize) -> usize,
    mut put: impl FnMut(usize, Counterparts),
) {
    for (k, segment) in part.segments.iter().enumerate() {
        for frame in covered(part.segments, k, part.features.len()) {
            let mut found: Counterparts = [None; MAX_COUNTERPARTS];
            let mut used = 0;
            for slot in 0..MAX_COUNTERPARTS {
                let change = |border: usize| changes.get(border).and_then(|c| c.get(slot)).copied().unwrap_or(0);
                let of = if k > 0 && (frame as isize - segment.frames.start as isize) < change(k - 1) {
                    k - 1
                } else if k + 1 < matches.len() && (frame as isize - segment.frames.end as isize) >= change(k) {
                    k + 1
                } else {
                    k
                };
                let Some(m) = matches[of].get(slot) else { continue };
                let at = m.warp.extrapolated(frame as isize - part.segments[of].frames.start as isize);
                let at = at.clamp(0.0, last_frame(m.example) as f32);
                found[used] = Some(Counterpart { example: m.example as u32, frame: at });
                used += 1;
            }
            put(frame, found);
        }
    }
}
