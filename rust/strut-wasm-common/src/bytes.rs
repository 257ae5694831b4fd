//! Files in JavaScript's heap.

use js_sys::Uint8Array;
use strut_formats::container::Source;

/// Bytes in the heap of JavaScript, copied part by part: memory that a package takes is never given back.
pub struct Bytes(pub Uint8Array);

impl Source for Bytes {
    fn len(&self) -> usize {
        self.0.length() as usize
    }

    fn copy(&self, begin: usize, to: &mut [u8]) {
        self.0.subarray(begin as u32, (begin + to.len()) as u32).copy_to(to);
    }
}
