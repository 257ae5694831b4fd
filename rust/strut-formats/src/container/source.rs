//! Sources of a file's bytes.

/// Bytes of a file, in memory or elsewhere, for example in the JavaScript heap, from which they are copied in parts.
pub trait Source {
    /// Number of bytes.
    fn len(&self) -> usize;

    /// Whether the file is empty.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Copies the bytes from `begin` on; the range must exist.
    fn copy(&self, begin: usize, to: &mut [u8]);
}

impl<T: AsRef<[u8]> + ?Sized> Source for T {
    fn len(&self) -> usize {
        self.as_ref().len()
    }

    fn copy(&self, begin: usize, to: &mut [u8]) {
        to.copy_from_slice(&self.as_ref()[begin..][..to.len()]);
    }
}
