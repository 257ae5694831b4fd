//! Files inside or outside JavaScript's heap.

use js_sys::Uint8Array;
use std::cell::{Cell, RefCell};
use strut_formats::container::Source;
use wasm_bindgen::prelude::wasm_bindgen;

/// Bytes in JavaScript's heap. They are copied in parts, because a package never returns memory.
pub struct Bytes(pub Uint8Array);

impl Source for Bytes {
    fn len(&self) -> usize {
        self.0.length() as usize
    }

    fn copy(&self, begin: usize, to: &mut [u8]) {
        self.0.subarray(begin as u32, (begin + to.len()) as u32).copy_to(to);
    }
}

/// Size of a slice in JavaScript's heap: where the previous slice ends, …
const SLICE: usize = 32 << 20;
/// … and elsewhere, where few bytes may be needed.
const FIRST_SLICE: usize = 1 << 20;

#[wasm_bindgen]
extern "C" {
    /// A file outside JavaScript's heap: `SlicedFile` of `web/engine/database.ts`.
    pub type SlicedFile;

    /// Returns a range of bytes, or `None` if it cannot be read.
    #[wasm_bindgen(method)]
    fn read(this: &SlicedFile, begin: u32, end: u32) -> Uint8Array;
}

/// A file of which one slice at a time is in JavaScript's heap.
pub struct Slices {
    file: SlicedFile,
    bytes: usize,
    /// Start of the slice that was read last, and the slice.
    slice: RefCell<Option<(usize, Uint8Array)>>,
    failed: Cell<bool>,
}

impl Slices {
    /// Creates the slices of a file with this number of bytes.
    pub fn new(file: SlicedFile, bytes: usize) -> Self {
        Self { file, bytes, slice: RefCell::new(None), failed: Cell::new(false) }
    }

    /// Returns whether a slice could not be read. Its bytes then read as zeros.
    pub fn failed(&self) -> bool {
        self.failed.get()
    }

    /// Reads the slice that starts at `begin`; it is shorter at the end of the file.
    fn slice_from(&self, begin: usize, length: usize) -> Option<Uint8Array> {
        let end = self.bytes.min(begin + length);
        let slice = self.file.read(begin as u32, end as u32);
        (begin < end && slice.length() as usize == end - begin).then_some(slice)
    }
}

impl Source for Slices {
    fn len(&self) -> usize {
        self.bytes
    }

    fn copy(&self, begin: usize, to: &mut [u8]) {
        let mut slice = self.slice.borrow_mut();
        let mut done = 0;
        while done < to.len() && !self.failed.get() {
            let at = begin + done;
            let last = slice.as_ref().map_or(0, |(begin, bytes)| begin + bytes.length() as usize);
            match &*slice {
                Some((first, bytes)) if (*first..last).contains(&at) => {
                    let count = (to.len() - done).min(last - at);
                    let part = bytes.subarray((at - first) as u32, (at - first + count) as u32);
                    part.copy_to(&mut to[done..][..count]);
                    done += count;
                }
                _ => {
                    *slice = self.slice_from(at, if at == last { SLICE } else { FIRST_SLICE }).map(|next| (at, next));
                    self.failed.set(slice.is_none());
                }
            }
        }
        to[done..].fill(0);
    }
}
