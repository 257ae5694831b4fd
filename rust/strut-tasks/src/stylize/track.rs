//! Styles that change over time.

use crate::error::{Outcome, TaskError};
use crate::weights::StyleWeights;
use strut_core::catalogue::Catalogue;
use strut_formats::shown_number;

/// Styles that are reached at a time.
#[derive(Clone, Debug, PartialEq)]
pub struct StyleKey {
    /// Time in the input, seconds.
    pub secs: f64,
    /// The styles.
    pub styles: StyleWeights,
}

/// The weights of a database's styles at every frame. They are interpolated linearly between two keys, and constant
/// before the first and after the last key.
#[derive(Clone, Debug)]
pub struct StyleTrack {
    /// Frames at the database's rate, ascending, with the weights there.
    keys: Vec<(f64, Vec<f32>)>,
}

impl StyleTrack {
    /// Creates a track through keys, at least one.
    ///
    /// # Errors
    /// If there is no key, times do not ascend, or the database lacks a style.
    pub fn new(keys: &[StyleKey], db: &Catalogue) -> Outcome<Self> {
        let mut track = Self { keys: Vec::with_capacity(keys.len()) };
        for StyleKey { secs, styles } in keys {
            let frame = secs * f64::from(db.rate_hz);
            if !frame.is_finite() || track.keys.last().is_some_and(|(before, _)| frame <= *before) {
                return Err(TaskError::usage(format_args!(
                    "a key is at {} s; finite, ascending times were expected",
                    shown_number(*secs)
                )));
            }
            track.keys.push((frame, styles.of(db).map_err(TaskError::new)?));
        }
        if track.keys.is_empty() {
            return Err(TaskError::usage("the track has no key; at least one was expected"));
        }
        Ok(track)
    }

    /// Returns the weights at a frame.
    pub(super) fn weights(&self, frame: usize) -> Vec<f32> {
        let frame = frame as f64;
        let after = self.keys.partition_point(|(at, _)| *at <= frame);
        let (Some(first), Some(last)) = (self.keys.get(after.saturating_sub(1)), self.keys.get(after)) else {
            return self.keys.last().map(|(_, weights)| weights.clone()).unwrap_or_default();
        };
        let share = if last.0 > first.0 { (frame - first.0) / (last.0 - first.0) } else { 0.0 };
        let mixed = |(a, b): (&f32, &f32)| (f64::from(*a) + (f64::from(*b) - f64::from(*a)) * share) as f32;
        first.1.iter().zip(&last.1).map(mixed).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_pass_from_key_to_key() {
        let track = StyleTrack { keys: vec![(10.0, vec![0.0, 1.0]), (20.0, vec![1.0, 0.0]), (21.0, vec![0.5, 0.5])] };
        for (frame, expected) in
            [(0, [0.0, 1.0]), (10, [0.0, 1.0]), (15, [0.5, 0.5]), (20, [1.0, 0.0]), (21, [0.5, 0.5]), (99, [0.5, 0.5])]
        {
            assert_eq!(track.weights(frame), expected, "{frame}");
        }
    }
}
