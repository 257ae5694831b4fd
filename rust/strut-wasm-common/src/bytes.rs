//! Files in JavaScript's heap, or outside of it.

use js_sys::{Function, Uint8Array};
use std::cell::{Cell, RefCell};
use strut_formats::container::Source;
use wasm_bindgen::{JsCast, JsValue};

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

/// Bytes that are in JavaScript's heap at once: where the last slice ends, …
const SLICE: usize = 32 << 20;
/// … and elsewhere, where few may be wanted.
const FIRST_SLICE: usize = 1 << 20;

/// A file outside of JavaScript's heap, of which a slice at a time is there.
pub struct Slices {
    bytes: usize,
    read: Function,
    /// The slice that was read last, and where it begins.
    slice: RefCell<(usize, Uint8Array)>,
    failed: Cell<bool>,
}

impl Slices {
    /// Of so many bytes; `read` gives those from a number up to another as a `Uint8Array`, or throws.
    pub fn new(bytes: usize, read: Function) -> Self {
        Self { bytes, read, slice: RefCell::new((0, Uint8Array::new_with_length(0))), failed: Cell::new(false) }
    }

    /// Whether a slice could not be read: zeros then stand for it.
    pub fn failed(&self) -> bool {
        self.failed.get()
    }

    /// The slice from `begin` on, shorter at the end of the file.
    fn slice_from(&self, begin: usize, length: usize) -> Option<Uint8Array> {
        let end = self.bytes.min(begin + length);
        if end <= begin {
            return None;
        }
        let slice = self.read.call2(&JsValue::NULL, &JsValue::from(begin as u32), &JsValue::from(end as u32)).ok()?;
        slice.dyn_into::<Uint8Array>().ok().filter(|slice| slice.length() as usize == end - begin)
    }
}

impl Source for Slices {
    fn len(&self) -> usize {
        self.bytes
    }

    fn copy(&self, begin: usize, to: &mut [u8]) {
        let mut slice = self.slice.borrow_mut();
        let mut done = 0;
        while done < to.len() {
            let at = begin + done;
            let within = at.checked_sub(slice.0).filter(|&within| within < slice.1.length() as usize);
            let Some(within) = within else {
                let length = if at == slice.0 + slice.1.length() as usize { SLICE } else { FIRST_SLICE };
                let Some(next) = self.slice_from(at, length).filter(|_| !self.failed.get()) else {
                    self.failed.set(true);
                    to[done..].fill(0);
                    return;
                };
                *slice = (at, next);
                continue;
            };
            let count = (to.len() - done).min(slice.1.length() as usize - within);
            slice.1.subarray(within as u32, (within + count) as u32).copy_to(&mut to[done..][..count]);
            done += count;
        }
    }
}
