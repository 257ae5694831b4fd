//! Fuzz targets: functions of arbitrary bytes that fail by a panic.
//!
//! *Parsers* read arbitrary files, and files that were edited so that they pass the checks of headers and checksums
//! ([`edits`]). *Semantic* targets use the values that a parser accepts: they are styled, walked, keyed, exported and
//! read again. The results must be finite, have the right length, and take no more memory than the size of the file
//! justifies.
//!
//! `npm run fuzz` runs them with libFuzzer; `cargo tests` runs them on their corpora (`corpus/`) and on a few random
//! inputs.
#![forbid(unsafe_code)]

pub mod bases;
pub mod edits;
mod memory;
mod parsers;
mod semantics;

/// A fuzz target.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// Name on the command line, and of the folder of its corpus.
    pub name: &'static str,
    /// Longest useful input, bytes.
    pub max_len: usize,
    /// Runs the target on an input.
    ///
    /// # Panics
    /// If the product violates its rules with this input.
    pub run: fn(&[u8]),
}

/// All targets: parsers, then semantic ones.
pub const TARGETS: &[Target] = &[
    Target { name: "bvh", max_len: 4096, run: parsers::bvh },
    Target { name: "bvh_edited", max_len: 256, run: parsers::bvh_edited },
    Target { name: "strutdb", max_len: 4096, run: parsers::strutdb },
    Target { name: "strutdb_edited", max_len: 256, run: parsers::strutdb_edited },
    Target { name: "packed", max_len: 256, run: parsers::packed_edited },
    Target { name: "walk_model", max_len: 256, run: parsers::walk_model_edited },
    Target { name: "key_style_model", max_len: 256, run: parsers::key_style_model_edited },
    Target { name: "style_keys", max_len: 1024, run: parsers::style_keys },
    Target { name: "corpus_table", max_len: 1024, run: parsers::corpus_table },
    Target { name: "labels", max_len: 512, run: parsers::labels },
    Target { name: "expression", max_len: 512, run: parsers::expression },
    Target { name: "vmc", max_len: 2048, run: parsers::vmc },
    Target { name: "style_a_file", max_len: 256, run: semantics::style_a_file },
    Target { name: "style_with_a_database", max_len: 256, run: semantics::style_with_a_database },
    Target { name: "walk", max_len: 256, run: semantics::walk },
    Target { name: "key_style", max_len: 256, run: semantics::key_style },
];

/// Returns the target of this name.
pub fn target(name: &str) -> Option<&'static Target> {
    TARGETS.iter().find(|target| target.name == name)
}
