//! How much memory a file has a right to.

use allocation_counter::measure;

/// Bytes that a parser may take at once whatever the file is: tables, messages, buffers.
const FREE_BYTES: u64 = 1 << 20;

/// What `parse` gives; it may take `times` the bytes of its input at once, and [`FREE_BYTES`].
///
/// # Panics
/// If it takes more: then a number in the file, and not the file's length, decides how much.
pub(crate) fn bounded<T>(input: &[u8], times: u64, parse: impl FnOnce(&[u8]) -> T) -> T {
    let mut out = None;
    let info = measure(|| out = Some(parse(input)));
    let right = times * input.len() as u64 + FREE_BYTES;
    assert!(info.bytes_max <= right, "{} bytes were taken for a file of {}", info.bytes_max, input.len());
    out.expect("it was parsed")
}
