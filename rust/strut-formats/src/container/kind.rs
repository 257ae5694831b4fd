//! Kinds of files.

/// A kind of file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Kind {
    /// Name in messages.
    pub name: &'static str,
    /// Name of the metadata entry.
    pub entry: &'static str,
    /// Version that is written, major.minor. Files of another major version are rejected.
    pub version: &'static str,
    /// First minor version whose files have a checksum.
    pub checksum_since: u32,
    /// Greatest size of a file, bytes.
    pub max_bytes: usize,
}
