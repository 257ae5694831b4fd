//! The checksum of a whole file that contains it.

use super::crc32::Crc32;

/// How the metadata's field looks in the file: JSON within a JSON string. A quotation mark in any text
/// of the metadata is escaped twice, so that no text can look like this.
const FIELD: &[u8] = br#"\"checksum\":\""#;
/// Digits of a checksum.
const DIGITS: usize = 8;
/// What stands in the digits' place while the checksum is computed.
pub(super) const BLANK: &str = "00000000";

/// Where the digits are, if the file has a checksum.
fn digits(file: &[u8]) -> Option<std::ops::Range<usize>> {
    let header_bytes = usize::try_from(u64::from_le_bytes(file.get(..8)?.try_into().ok()?)).ok()?;
    let header = file.get(8..header_bytes.checked_add(8)?)?;
    let begin = 8 + header.windows(FIELD.len()).position(|w| w == FIELD)? + FIELD.len();
    (begin + DIGITS <= file.len()).then_some(begin..begin + DIGITS)
}

/// The checksum that a file should have, if it has one; lower-case hexadecimal.
pub(super) fn compute(file: &[u8]) -> Option<String> {
    let digits = digits(file)?;
    let mut crc = Crc32::new();
    crc.update(&file[..digits.start]);
    crc.update(BLANK.as_bytes());
    crc.update(&file[digits.end..]);
    Some(format!("{:08x}", crc.finish()))
}

/// Enters the checksum into a file whose metadata hold [`BLANK`] in its place.
pub(super) fn enter(file: &mut [u8]) {
    if let (Some(sum), Some(digits)) = (compute(file), digits(file)) {
        file[digits].copy_from_slice(sum.as_bytes());
    }
}
