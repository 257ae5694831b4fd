//! Quotations from a file in messages.

/// Start of a text on one line: at most `most` characters, with control characters replaced.
pub fn quotation(text: &str, most: usize) -> String {
    text.chars().map(|c| if c.is_control() { '\u{FFFD}' } else { c }).take(most).collect()
}
