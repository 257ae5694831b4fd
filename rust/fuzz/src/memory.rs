//! Memory limit of a parser.

use allocation_counter::measure;

/// Bytes that a parser may always allocate, for tables, messages and buffers.
const FREE_BYTES: u64 = 1 << 20;

/// Returns the result of `parse`, which may have allocated `times` the bytes of its input at once, plus [`FREE_BYTES`].
///
/// # Panics
/// If it allocates more: then a number in the file determines the size, and not the file's length.
pub(crate) fn bounded<T>(input: &[u8], times: u64, parse: impl FnOnce(&[u8]) -> T) -> T {
    let mut out = None;
    let info = measure(|| out = Some(parse(input)));
    let right = times * input.len() as u64 + FREE_BYTES;
    assert!(info.bytes_max <= right, "{} bytes were taken for a file of {}", info.bytes_max, input.len());
    out.expect("it was parsed")
}
