//! Counterparts: each segment is registered to the pieces of a style that fit it best (specification §4).

use super::features::Feature;
use super::gait::{Segment, SegmentKind};
use super::matching::{Match, Piece, Warper};
use super::warp::{Ends, Warp};
use super::{Counterpart, Counterparts, Options};
use crate::database::MAX_COUNTERPARTS;

/// A lead-in or lead-out may be stretched by this much on its way to the open end.
const OPEN_REACH: usize = 2;

/// Features and segments of one example that takes part.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part<'a> {
    /// Number of the example.
    pub(super) example: usize,
    /// Number of its style.
    pub(super) style: u16,
    /// Features of its frames.
    pub(super) features: &'a [Feature],
    /// Its segments.
    pub(super) segments: &'a [Segment],
}

/// Counterparts of one example: frames × styles.
#[derive(Clone, Debug, Default)]
pub(super) struct Paired {
    pub(super) counterparts: Vec<Counterparts>,
    /// Mean cost of the matches; `None` without any.
    pub(super) cost: Option<f32>,
}

/// Finds the counterparts of an example among all examples of its action, itself included.
pub(super) fn pair(part: &Part, all: &[Part], styles: usize, options: &Options, warper: &mut Warper) -> Paired {
    let mut counterparts: Vec<Counterparts> = vec![[None; MAX_COUNTERPARTS]; part.features.len() * styles];
    let (mut cost_sum, mut cost_count) = (0.0, 0);
    for style in 0..styles {
        let others: Vec<&Part> = all.iter().filter(|p| usize::from(p.style) == style).collect();
        if others.is_empty() {
            continue;
        }
        let matches: Vec<Vec<Match>> =
            part.segments.iter().map(|s| matches_of(s, part, &others, options, warper)).collect();
        for m in matches.iter().flatten() {
            cost_sum += m.warp.cost;
            cost_count += 1;
        }
        fill(
            part,
            &matches,
            options.counterparts(),
            |example| last_frame(all, example),
            |frame, found| {
                counterparts[frame * styles + style] = found;
            },
        );
    }
    Paired { counterparts, cost: (cost_count > 0).then(|| cost_sum / cost_count as f32) }
}

fn last_frame(all: &[Part], example: usize) -> f32 {
    all.iter().find(|p| p.example == example).map_or(0.0, |p| (p.features.len() - 1) as f32)
}

/// The best matches of a segment in one style: at least one, if the style has any example.
fn matches_of(segment: &Segment, part: &Part, others: &[&Part], options: &Options, warper: &mut Warper) -> Vec<Match> {
    // A cycle is compared up to and with the strike that ends it.
    let last = segment.frames.end.min(part.features.len() - 1);
    let a = &part.features[segment.frames.start..=last];
    let pieces: Vec<Piece> = others.iter().flat_map(|o| pieces_for(segment, a.len(), o)).collect();
    let mut best = |pieces: &[Piece]| warper.best(a, pieces, options.candidates, options.counterparts());
    let mut matches = best(&pieces);
    if matches.is_empty() {
        let anywhere: Vec<Piece> = others
            .iter()
            .map(|o| Piece {
                example: o.example,
                first: 0,
                features: o.features,
                ends: Ends { open_begin: true, open_end: true },
            })
            .collect();
        matches = best(&anywhere);
    }
    if matches.is_empty() {
        // Longer than anything in the style by more than the slope limit: linear time is all there is.
        matches.extend(others.iter().max_by_key(|o| o.features.len()).map(|o| Match {
            example: o.example,
            warp: Warp::linear(a.len(), 0.0, (o.features.len() - 1) as f32, 0.0),
        }));
    }
    matches
}

/// The pieces of another example that a segment of `n` frames may be matched with.
fn pieces_for<'a>(segment: &Segment, n: usize, other: &Part<'a>) -> Vec<Piece<'a>> {
    let end = other.features.len() - 1;
    let piece = |first: usize, last: usize, ends: Ends| Piece {
        example: other.example,
        first,
        features: &other.features[first..=last],
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
        SegmentKind::Clip => vec![piece(0, end, Ends::default())],
        SegmentKind::Cycle => other
            .segments
            .iter()
            .filter(|s| s.kind == SegmentKind::Cycle)
            .map(|s| piece(s.frames.start, s.frames.end, Ends::default()))
            .collect(),
        SegmentKind::LeadIn => {
            let open = Ends { open_begin: true, open_end: false };
            // Too short a run-up would be stretched to fill the lead-in.
            strikes().filter(|s| s + 1 >= n).map(|s| piece(s.saturating_sub(reach), s, open)).collect()
        }
        SegmentKind::LeadOut => {
            let open = Ends { open_begin: false, open_end: true };
            strikes().filter(|s| end - s + 1 >= n).map(|s| piece(s, (s + reach).min(end), open)).collect()
        }
        SegmentKind::Faulty => vec![piece(0, end, Ends { open_begin: true, open_end: true })],
    }
}

/// Hands every frame its counterparts. Around a border between segments the matches of the one give way to
/// those of the other over three frames: since all count alike in the mean, a share of one is a share of
/// the slots.
fn fill(
    part: &Part,
    matches: &[Vec<Match>],
    slots: usize,
    last_frame: impl Fn(usize) -> f32,
    mut put: impl FnMut(usize, Counterparts),
) {
    for (k, segment) in part.segments.iter().enumerate() {
        for frame in segment.frames.clone() {
            let from_start = frame - segment.frames.start;
            let to_end = segment.frames.end - frame;
            // Shares of the previous and of the next segment: 1/4 past a border, 1/2 on it, 1/4 before it.
            let neighbour = match (from_start, to_end) {
                (0, _) if k > 0 => Some((k - 1, 0.5)),
                (1, _) if k > 0 => Some((k - 1, 0.25)),
                (_, 1) if k + 1 < matches.len() => Some((k + 1, 0.25)),
                _ => None,
            };
            let mut found: Counterparts = [None; MAX_COUNTERPARTS];
            let mut used = 0;
            let mut take = |k: usize, count: usize| {
                for m in matches[k].iter().take(count.min(slots - used)) {
                    let at = m.warp.extrapolated(frame as isize - part.segments[k].frames.start as isize);
                    let at = at.clamp(0.0, last_frame(m.example));
                    found[used] = Some(Counterpart { example: m.example as u32, frame: at });
                    used += 1;
                }
            };
            let borrowed = neighbour.map_or(0, |(k, share)| (share * slots.min(matches[k].len()) as f32) as usize);
            if let Some((k, _)) = neighbour {
                take(k, borrowed);
            }
            take(k, slots - borrowed);
            put(frame, found);
        }
    }
}
