//! Notes in reports.

use serde::{Deserialize, Serialize};
use strut_core::note::Note;

/// A note as JSON.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct NoteReport {
    /// Code of the note; `docs/reading.md` lists the codes.
    pub code: String,
    /// Message of the note.
    pub text: String,
}

impl NoteReport {
    /// Converts notes in their order.
    pub fn of<'a>(notes: impl IntoIterator<Item = &'a Note>) -> Vec<Self> {
        let report = |note: &Note| Self { code: note.code.name().to_owned(), text: note.text.clone().into_owned() };
        notes.into_iter().map(report).collect()
    }
}
