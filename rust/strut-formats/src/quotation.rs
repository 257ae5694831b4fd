//! Quotations from a file in messages.

/// Start of a text on one line: at most `most` characters, with control characters replaced.
pub fn quotation(text: &str, most: usize) -> String {
    text.chars().map(|c| if c.is_control() { '\u{FFFD}' } else { c }).take(most).collect()
}

/// A number in a message, with an exponent if it would have many digits.
pub fn shown_number(value: f64) -> String {
    let (least, greatest) = (1e-9, 1e9);
    let has_few_digits = value == 0.0 || !value.is_finite() || (least..greatest).contains(&value.abs());
    if has_few_digits { value.to_string() } else { format!("{value:e}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_few_digits() {
        let of = [0.25, -3.0, 0.0, 1e300, -2.5e-300, f64::NAN].map(shown_number);
        assert_eq!(of, ["0.25", "-3", "0", "1e300", "-2.5e-300", "NaN"]);
    }
}
