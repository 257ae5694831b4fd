//! Printing.

use std::io::{self, Write};
use std::path::Path;
use strut_tasks::Outcome;
use strut_tasks::files::Outputs;
use strut_tasks::note_report::NoteReport;

/// Prints to stdout; a closed pipe is not an error.
pub(crate) fn print(text: &str) {
    let mut out = io::stdout().lock();
    let _ = out.write_all(text.as_bytes()).and_then(|()| out.flush());
}

/// Writes a text to a file, or to stdout without one.
pub(crate) fn write_or_print(target: Option<&Path>, text: &str) -> Outcome {
    let Some(target) = target else {
        print(text);
        return Ok(());
    };
    let mut outputs = Outputs::default();
    outputs.stage(target, text.as_bytes())?;
    outputs.commit()
}

/// Prints notes on a file to stderr, where users see them even if a program reads the text.
pub(crate) fn print_notes(file: &str, notes: &[NoteReport]) {
    for note in notes {
        print_warnings(&format!("note: {file}: {}\n", note.text));
    }
}

/// Prints to stderr; a closed pipe is not an error.
pub(crate) fn print_warnings(text: &str) {
    let _ = io::stderr().write_all(text.as_bytes());
}
