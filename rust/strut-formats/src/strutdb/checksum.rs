//! The checksum of a whole file that contains it.

use super::Source;
use super::crc32::Crc32;
use std::ops::Range;

/// How the metadata's field looks in the file: JSON within a JSON string. A quotation mark in any text
/// of the metadata is escaped twice, so that no text can look like this.
const FIELD: &[u8] = br#"\"checksum\":\""#;
/// Digits of a checksum.
const DIGITS: usize = 8;
/// What stands in the digits' place while the checksum is computed.
pub(super) const BLANK: &str = "00000000";

/// Bytes that are summed at once. In WebAssembly a function becomes fast once it has been called often, however long it
/// runs.
const PART: usize = 1 << 15;

/// Where the digits are in a file that begins so, if it has a checksum.
fn digits(beginning: &[u8]) -> Option<Range<usize>> {
    let begin = beginning.windows(FIELD.len()).position(|w| w == FIELD)? + FIELD.len();
    (begin + DIGITS <= beginning.len()).then_some(begin..begin + DIGITS)
}

/// The checksum that a file should have, if its beginning, up to the end of the header, has one; lower-case hexadecimal.
pub(super) fn compute<S: Source + ?Sized>(beginning: &[u8], file: &S) -> Option<String> {
    let digits = digits(beginning)?;
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

/// Enters the checksum into a file whose metadata hold [`BLANK`] in its place.
pub(super) fn enter(file: &mut [u8]) {
    if let (Some(sum), Some(digits)) = (compute(file, file), digits(file)) {
        file[digits].copy_from_slice(sum.as_bytes());
    }
}
