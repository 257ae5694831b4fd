//! How similar an input is to a database.
//!
//! Class weights do not measure this: they compare classes with each other (Eq. 4) and sum to 1 even where all are far.
//! The distance to the nearest window of the heaviest class does. In the built-in database its mean is at most .18 m
//! over 416 clips of `../shared/data`, half of whose actions the database lacks. A walk that is read with the wrong up
//! axis, or 93 cm off its floor, has .48 to 1.5 m.

use super::frame::Trace;
use crate::note::{Note, NoteCode};

/// Mean distance to the nearest windows beyond which an input counts as unlike the database, metres.
const FAR: f64 = 0.35;

/// Mean distance of an input from a database.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Familiarity {
    /// Sum of the distances, metres.
    sum: f64,
    frames: u32,
}

impl Familiarity {
    /// Adds a frame.
    pub(super) fn add(&mut self, trace: &Trace<'_>) {
        if let Some(nearest) = trace.neighbours().next() {
            self.sum += f64::from(nearest.distance);
            self.frames += 1;
        }
    }

    /// Mean distance of the input's windows to the nearest ones of the heaviest class, metres. 0 for methods without
    /// neighbours.
    pub fn distance_metres(&self) -> f64 {
        self.sum / f64::from(self.frames.max(1))
    }

    /// Note for an input that is unlike the database.
    pub fn note(&self) -> Option<Note> {
        let cm = (100.0 * self.distance_metres()).round();
        (self.distance_metres() > FAR).then(|| {
            let unlike = format!("The database has no similar motion: its poses are {cm} cm away on average.");
            Note::new(NoteCode::Unfamiliar, unlike + " The result is a guess.")
        })
    }
}
