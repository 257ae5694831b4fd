//! Foot contacts on an action's canonical timeline, and the agreement of each clip with them.

use serde::Serialize;
use std::fmt::Write;
use std::ops::Range;
use strut_core::database::Database;

/// Share of an action's clips or gait cycles with a planted foot, for every frame of the canonical timeline.
#[derive(Serialize)]
pub(crate) struct CanonicalContact {
    /// Shares of the left foot, 0 to 1.
    pub(crate) left: Vec<f32>,
    /// Shares of the right foot, 0 to 1.
    pub(crate) right: Vec<f32>,
}

impl CanonicalContact {
    /// Measures an action whose timeline has this many frames; the time of gait cycles wraps around. Every frame of a
    /// clip is weighted by the canonical time that it covers, so that slow and fast clips have the same weight.
    pub(crate) fn of(db: &Database, action: u16, frames: f32, cyclic: bool) -> Self {
        let count = (frames.ceil() as usize).max(1);
        let mut planted = vec![[0.0_f32; 2]; count];
        let mut covered = vec![0.0_f32; count];
        for row in db.clips.iter().filter(|c| c.action == action).flat_map(strut_core::database::Clip::rows) {
            let mut from = db.canonical_time[row];
            let to = from + 1.0 / (db.time_step[row] * db.rate_hz);
            while from < to {
                let next = (from.floor() + 1.0).min(to);
                if let Some(k) = canonical_frame(from, frames, cyclic) {
                    covered[k] += next - from;
                    for (sum, contact) in planted[k].iter_mut().zip(db.contact[row]) {
                        *sum += (next - from) * f32::from(contact);
                    }
                }
                from = next;
            }
        }
        let share =
            |side: usize| planted.iter().zip(&covered).map(|(p, c)| p[side] / c.max(f32::MIN_POSITIVE)).collect();
        Self { left: share(0), right: share(1) }
    }

    /// Returns the percentage of a clip's contact labels, both feet, that agree with the majority of its action.
    pub(crate) fn agreement(&self, db: &Database, rows: Range<usize>, frames: f32, cyclic: bool) -> f32 {
        let (mut same, mut compared) = (0, 0);
        for row in rows {
            let Some(k) = canonical_frame(db.canonical_time[row], frames, cyclic) else { continue };
            for (share, contact) in [self.left[k], self.right[k]].into_iter().zip(db.contact[row]) {
                same += usize::from((share > 0.5) == (contact == 1));
                compared += 1;
            }
        }
        100.0 * same as f32 / compared.max(1) as f32
    }

    /// Returns the cells of a table: each foot's duty factor, per cent, and where on the timeline the majority has it
    /// planted.
    pub(crate) fn cells(&self) -> String {
        [&self.left, &self.right].into_iter().fold(String::new(), |mut out, shares| {
            let duty = 100.0 * shares.iter().sum::<f32>() / shares.len() as f32;
            // Writing to a string cannot fail.
            let _ = write!(out, "| {duty:.0} | {} ", planted_ranges(shares));
            out
        })
    }
}

/// Returns the frame of the canonical timeline at a time, or `None` outside the timeline of whole clips.
fn canonical_frame(time: f32, frames: f32, cyclic: bool) -> Option<usize> {
    let last = (frames.ceil() as usize).saturating_sub(1);
    if cyclic {
        return Some((time.rem_euclid(frames.max(1.0)) as usize).min(last));
    }
    (0.0..=frames).contains(&time).then(|| (time as usize).min(last))
}

/// Returns the ranges in which more than half have the foot planted, per cent of the timeline.
fn planted_ranges(shares: &[f32]) -> String {
    let percent = |k: usize| 100.0 * k as f32 / shares.len() as f32;
    let mut ranges: Vec<String> = Vec::new();
    let mut first = None;
    for k in 0..=shares.len() {
        let planted = shares.get(k).is_some_and(|s| *s > 0.5);
        match first {
            None if planted => first = Some(k),
            Some(begin) if !planted => {
                ranges.push(format!("{:.0}–{:.0}", percent(begin), percent(k)));
                first = None;
            }
            _ => {}
        }
    }
    if ranges.is_empty() { "never".to_owned() } else { ranges.join(", ") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn planted_stretches_are_read_off_the_shares() {
        assert_eq!(planted_ranges(&[0.9, 0.8, 0.2, 0.1, 0.6]), "0–40, 80–100");
        assert_eq!(planted_ranges(&[0.1; 4]), "never");
        assert_eq!(planted_ranges(&[1.0; 4]), "0–100");
    }

    #[test]
    fn time_wraps_in_cycles_and_ends_in_clips() {
        assert_eq!(canonical_frame(62.5, 60.0, true), Some(2));
        assert_eq!(canonical_frame(-0.5, 60.0, true), Some(59));
        assert_eq!(canonical_frame(-0.5, 60.0, false), None);
        assert_eq!(canonical_frame(60.0, 60.0, false), Some(59));
    }
}
