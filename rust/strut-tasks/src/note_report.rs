//! Notes in reports.

use serde::Serialize;
use strut_core::note::Note;

/// A note as JSON.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct NoteReport {
    /// What it is about; `docs/reference/notes.md` lists the codes.
    pub code: &'static str,
    /// The sentence.
    pub text: String,
}

impl NoteReport {
    /// Notes in their order.
    pub fn of<'a>(notes: impl IntoIterator<Item = &'a Note>) -> Vec<Self> {
        let report = |note: &Note| Self { code: note.code.name(), text: note.text.clone().into_owned() };
        notes.into_iter().map(report).collect()
    }
}
