//! Checksum of a whole file that contains the checksum.

use super::Source;
use super::crc32::Crc32;
use std::ops::Range;

/// Name of the metadata's field in the form in which the file contains it: JSON within a JSON string. Quotation marks
/// in texts of the metadata are escaped twice, so that no text can match it.
const NAME: &[u8] = br#"\"checksum\""#;
/// Start of a text of the metadata.
const QUOTATION_MARK: &[u8] = br#"\""#;
/// Blanks that may occur between name, colon and value.
const BLANKS: [&[u8]; 4] = [b" ", br"\n", br"\r", br"\t"];
/// Number of digits of a checksum.
const DIGITS: usize = 8;
/// Placeholder of the digits while the checksum is computed.
pub(crate) const BLANK: &str = "00000000";

/// Bytes summed per call. In WebAssembly a function is optimised once it has been called often, even if one call runs long.
const PART: usize = 1 << 15;

/// Position of the digits in the header of a file, if it contains this checksum.
fn digits(beginning: &[u8], checksum: &str) -> Option<Range<usize>> {
    let mut from = 0;
    loop {
        let end = from + beginning[from..].windows(NAME.len()).position(|w| w == NAME)? + NAME.len();
        let value = text_after_colon(&beginning[end..]);
        if let Some(rest) = value.filter(|rest| checksum.len() == DIGITS && rest.starts_with(checksum.as_bytes())) {
            let begin = beginning.len() - rest.len();
            return Some(begin..begin + DIGITS);
        }
        from = end;
    }
}

/// Text after the quotation mark that opens the value of a field.
fn text_after_colon(after_name: &[u8]) -> Option<&[u8]> {
    let value = without_blanks(after_name).strip_prefix(b":")?;
    without_blanks(value).strip_prefix(QUOTATION_MARK)
}

fn without_blanks(mut text: &[u8]) -> &[u8] {
    while let Some(rest) = BLANKS.iter().find_map(|blank| text.strip_prefix(*blank)) {
        text = rest;
    }
    text
}

/// Correct checksum of a file whose header contains the checksum `found`, as lower-case hexadecimal. `beginning` is the
/// file up to the end of its header. `None` if the header does not contain `found`.
pub(super) fn compute<S: Source + ?Sized>(beginning: &[u8], file: &S, found: &str) -> Option<String> {
    let digits = digits(beginning, found)?;
    let mut crc = Crc32::new();
    crc.update(&beginning[..digits.start]);
    crc.update(BLANK.as_bytes());
    let mut part = vec![0; PART];
    for begin in (digits.end..file.len()).step_by(PART) {
        let part = &mut part[..PART.min(file.len() - begin)];
        file.copy(begin, part);
        crc.update(part);
    }
    Some(format!("{:08x}", crc.finish()))
}

/// Writes the checksum into a file whose metadata contain [`BLANK`] in its place.
pub(super) fn enter(file: &mut [u8]) {
    if let (Some(sum), Some(digits)) = (compute(file, file, BLANK), digits(file, BLANK)) {
        file[digits].copy_from_slice(sum.as_bytes());
    }
}
