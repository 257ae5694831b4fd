//! What messages quote of a file.

/// The beginning of a text, on one line: at most `most` characters, with a mark in place of what is not printed.
pub fn quotation(text: &str, most: usize) -> String {
    text.chars().map(|c| if c.is_control() { '\u{FFFD}' } else { c }).take(most).collect()
}
