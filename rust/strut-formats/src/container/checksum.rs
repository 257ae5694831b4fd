//! The checksum of a whole file that contains it.

use super::Source;
use super::crc32::Crc32;
use std::ops::Range;

/// The metadata's field as it is in the file: JSON within a JSON string. Quotation marks in texts of the metadata are
/// escaped twice, so that no text can match it.
const FIELD: &[u8] = br#"\"checksum\":\""#;
/// Digits of a checksum.
const DIGITS: usize = 8;
/// Placeholder of the digits while the checksum is computed.
pub(crate) const BLANK: &str = "00000000";

/// Bytes summed per call. In WebAssembly a function is optimised once it has been called often, however long one call
/// runs.
const PART: usize = 1 << 15;

/// Position of the digits in the beginning of a file, if it has a checksum.
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
