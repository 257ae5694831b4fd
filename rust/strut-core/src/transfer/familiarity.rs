//! How well a database knows an input.
//!
//! Class weights do not tell: they compare classes with each other (Eq. 4), and sum to 1 also where all are far. The distance
//! to the nearest window of the heaviest class does. Measured in the built-in database, its mean is at most .18 m over 416
//! clips of `../shared/data`, half of whose actions the database lacks. A walk that is read with another up axis, or 93 cm off
//! its floor, has .48 to 1.5 m.

use super::frame::Trace;
use crate::note::{Note, NoteCode};

/// An input whose windows are farther than this from the nearest of the database on average is unlike all of it, metres.
const FAR: f64 = 0.35;

/// Mean distance of an input from a database.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Familiarity {
    /// Sum of the distances, metres.
    sum: f64,
    frames: u32,
}

impl Familiarity {
    /// Takes a frame into account.
    pub(super) fn add(&mut self, trace: &Trace<'_>) {
        if let Some(nearest) = trace.neighbours().next() {
            self.sum += f64::from(nearest.distance);
            self.frames += 1;
        }
    }

    /// Mean distance of the input's windows from the nearest ones of the heaviest class, metres. 0 where a method has none.
    pub fn distance_metres(&self) -> f64 {
        self.sum / f64::from(self.frames.max(1))
    }

    /// What there is to say of an input that is unlike the database.
    pub fn note(&self) -> Option<Note> {
        let cm = (100.0 * self.distance_metres()).round();
        (self.distance_metres() > FAR).then(|| {
            let unlike = format!("This motion is unlike all of the database: its poses are {cm} cm away on average.");
            Note::new(NoteCode::Unfamiliar, unlike + " The result is a guess.")
        })
    }
}
