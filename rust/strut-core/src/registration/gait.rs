//! Divides clips at left heel strikes (`docs/methods/mar.md` §4).

use super::example::Example;
use super::outcome::{CycleFault, FaultyCycle};
use crate::math::stats;
use crate::pose_vector::{VELOCITY_X, VELOCITY_Z};
use std::ops::Range;

/// An action is locomotion if at least this share of its clips are, and one clip contains a whole cycle. A clip is
/// locomotion if it travels and most of its heel strikes alternate between the feet, which they do not after a jump.
const LOCOMOTION_SHARE: f32 = 0.5;
const MIN_STEP_SECS: f32 = 0.12;
const MIN_ALTERNATION: f32 = 0.7;
const MIN_SPEED: f32 = 0.25;
/// Greatest factor by which a cycle's duration may differ from the usual one.
const DURATION_TOLERANCE: f32 = 1.6;
/// A clip with this many cycles has its own usual duration.
const MIN_OWN_CYCLES: usize = 5;
/// Plausible durations of a gait cycle, seconds.
const PLAUSIBLE_SECS: Range<f32> = 0.3..3.0;

/// A part of a clip that is registered separately.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Segment {
    /// Frames that belong to it.
    pub frames: Range<usize>,
    /// Its kind.
    pub kind: SegmentKind,
}

/// Kind of a [`Segment`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum SegmentKind {
    /// The whole clip without standing at its ends.
    Clip,
    /// From the clip's start to the first strike.
    LeadIn,
    /// From one left heel strike to the next.
    Cycle,
    /// Between two left heel strikes, but not a gait cycle.
    Faulty,
    /// From the last strike to the clip's end.
    LeadOut,
}

impl Segment {
    /// Last frame that is compared, in an example of `total` frames: for a cycle the strike that ends it.
    pub(super) fn last(&self, total: usize) -> usize {
        match self.kind {
            SegmentKind::Clip => self.frames.end - 1,
            _ => self.frames.end.min(total - 1),
        }
    }
}

/// Frames of an example of `total` frames that segment `k` covers, including frames at the clip's ends that belong to
/// no segment.
pub(super) fn covered(segments: &[Segment], k: usize, total: usize) -> Range<usize> {
    let first = if k == 0 { 0 } else { segments[k].frames.start };
    first..if k + 1 == segments.len() { total } else { segments[k].frames.end }
}

/// Frames at which a foot (0 left, 1 right) touches down.
pub(super) fn strikes(contact: &[[bool; 2]], side: usize) -> Vec<usize> {
    (1..contact.len()).filter(|&f| contact[f][side] && !contact[f - 1][side]).collect()
}

/// Returns whether the clips of an action walk or run.
pub(super) fn is_locomotion(examples: &[Example], rate_hz: f32) -> bool {
    let walking = examples.iter().filter(|e| walks(e, rate_hz)).count();
    let share = walking as f32 / examples.len().max(1) as f32;
    share >= LOCOMOTION_SHARE && examples.iter().any(|e| !plain_cycles(e).is_empty())
}

fn walks(example: &Example, rate_hz: f32) -> bool {
    let both = |side: usize| strikes(&example.contact, side).into_iter().map(move |frame| (frame, side));
    let mut all: Vec<(usize, usize)> = both(0).chain(both(1)).collect();
    all.sort_unstable();
    let in_turn = all.windows(2).filter(|w| w[0].1 != w[1].1 && (w[1].0 - w[0].0) as f32 >= MIN_STEP_SECS * rate_hz);
    let speed = example.pose.iter().map(|r| (r[VELOCITY_X] * r[VELOCITY_X] + r[VELOCITY_Z] * r[VELOCITY_Z]).sqrt());
    all.len() >= 2
        && in_turn.count() as f32 >= MIN_ALTERNATION * (all.len() - 1) as f32
        && speed.sum::<f32>() >= MIN_SPEED * example.frames() as f32
}

/// Lengths of the intervals between two left heel strikes that contain one right heel strike.
fn plain_cycles(example: &Example) -> Vec<usize> {
    let right = strikes(&example.contact, 1);
    let left = strikes(&example.contact, 0);
    left.windows(2).filter(|w| between(&right, w[0], w[1]) == 1).map(|w| w[1] - w[0]).collect()
}

/// Segments of every example, which cover it without gaps, and the faults of its faulty cycles. An example without a
/// left heel strike has no segments.
pub(super) fn cut(examples: &[Example], styles: usize, rate_hz: f32) -> Vec<(Vec<Segment>, Vec<FaultyCycle>)> {
    let usual: Vec<Option<f32>> = (0..styles).map(|s| usual_frames(examples, s as u16, rate_hz)).collect();
    examples.iter().map(|e| cut_one(e, usual[usize::from(e.style)], rate_hz)).collect()
}

/// Usual length of a style's cycles in frames: their median.
fn usual_frames(examples: &[Example], style: u16, rate_hz: f32) -> Option<f32> {
    median(examples.iter().filter(|e| e.style == style).flat_map(plain_cycles), rate_hz)
}

fn median(lengths: impl Iterator<Item = usize>, rate_hz: f32) -> Option<f32> {
    let plausible = lengths.filter(|&length| PLAUSIBLE_SECS.contains(&(length as f32 / rate_hz)));
    stats::median(plausible.map(|length| length as f64)).map(|length| length as f32)
}

fn cut_one(example: &Example, usual: Option<f32>, rate_hz: f32) -> (Vec<Segment>, Vec<FaultyCycle>) {
    let left = strikes(&example.contact, 0);
    let right = strikes(&example.contact, 1);
    let (mut segments, mut faulty) = (Vec::new(), Vec::new());
    // A clip may have its own pace.
    let own = plain_cycles(example);
    let usual = if own.len() >= MIN_OWN_CYCLES { median(own.into_iter(), rate_hz).or(usual) } else { usual };
    let (Some(&first), Some(&last)) = (left.first(), left.last()) else { return (segments, faulty) };
    segments.push(Segment { frames: 0..first, kind: SegmentKind::LeadIn });
    for w in left.windows(2) {
        let (frames, found) = (w[0]..w[1], (w[1] - w[0]) as f32);
        let usual = usual.unwrap_or(found);
        let in_range = PLAUSIBLE_SECS.contains(&(found / rate_hz))
            && found <= usual * DURATION_TOLERANCE
            && found * DURATION_TOLERANCE >= usual;
        let fault = match between(&right, w[0], w[1]) {
            1 if in_range => None,
            1 => Some(CycleFault::Duration { found_secs: found / rate_hz, usual_secs: usual / rate_hz }),
            n => Some(CycleFault::RightStrikes(n)),
        };
        let kind = if fault.is_some() { SegmentKind::Faulty } else { SegmentKind::Cycle };
        faulty.extend(fault.map(|fault| FaultyCycle { frames: frames.clone(), fault }));
        segments.push(Segment { frames, kind });
    }
    segments.push(Segment { frames: last..example.frames(), kind: SegmentKind::LeadOut });
    (segments, faulty)
}

fn between(strikes: &[usize], from: usize, to: usize) -> usize {
    strikes.iter().filter(|&&s| (from..to).contains(&s)).count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::humanoid::JOINTS;
    use crate::math::Vec3;
    use crate::pose_vector::ROW;

    /// Contacts from strike frames; each contact lasts ten frames.
    fn example(frames: usize, left: &[usize], right: &[usize]) -> Example {
        let down = |strikes: &[usize], f: usize| strikes.iter().any(|&s| (s..s + 10).contains(&f));
        let mut row = [0.0; ROW];
        row[VELOCITY_Z] = 1.0;
        Example {
            style: 0,
            pose: vec![row; frames],
            point_cloud: vec![[Vec3::ZERO; JOINTS]; frames],
            contact: (0..frames).map(|f| [down(left, f), down(right, f)]).collect(),
            script: None,
        }
    }

    #[test]
    fn a_steady_gait_is_cut_into_cycles_and_two_partial_ends() {
        let walk = example(280, &[20, 80, 140, 200, 260], &[50, 110, 170, 230]);
        assert!(is_locomotion(std::slice::from_ref(&walk), 60.0));
        let (segments, faulty) = cut(&[walk], 1, 60.0).remove(0);
        assert!(faulty.is_empty());
        let kinds: Vec<_> = segments.iter().map(|s| (s.frames.clone(), s.kind)).collect();
        assert_eq!(
            kinds,
            [
                (0..20, SegmentKind::LeadIn),
                (20..80, SegmentKind::Cycle),
                (80..140, SegmentKind::Cycle),
                (140..200, SegmentKind::Cycle),
                (200..260, SegmentKind::Cycle),
                (260..280, SegmentKind::LeadOut),
            ]
        );
    }

    #[test]
    fn a_stumble_and_a_pause_are_faulty() {
        let walk = example(500, &[20, 80, 140, 200, 380, 440], &[50, 100, 120, 170, 230, 410]);
        let (segments, faulty) = cut(&[walk], 1, 60.0).remove(0);
        assert_eq!(segments.iter().filter(|s| s.kind == SegmentKind::Cycle).count(), 3);
        assert_eq!(faulty[0], FaultyCycle { frames: 80..140, fault: CycleFault::RightStrikes(2) });
        assert_eq!(faulty[1].frames, 200..380);
        assert_eq!(faulty[1].fault.to_string(), "it lasts 3.00 s; about 1.00 s is usual");
    }

    #[test]
    fn standing_is_no_locomotion_and_has_no_segments() {
        let stand = example(100, &[], &[]);
        assert!(!is_locomotion(std::slice::from_ref(&stand), 60.0));
        assert!(cut(&[stand], 1, 60.0).remove(0).0.is_empty());
    }

    #[test]
    fn landing_on_both_feet_is_no_locomotion_but_a_single_stride_beside_a_walk_is() {
        let jump = example(80, &[10, 60], &[11, 61]);
        assert!(!is_locomotion(&[jump.clone(), jump], 60.0));
        let (walk, stride) = (example(280, &[20, 80, 140], &[50, 110]), example(60, &[35], &[10]));
        assert!(is_locomotion(&[walk, stride.clone(), stride.clone()], 60.0));
        assert!(!is_locomotion(&[stride], 60.0), "nothing to take a cycle from");
        assert!(!is_locomotion(&[], 60.0));
    }
}
