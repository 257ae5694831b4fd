//! What an output depends on, as a number.

use sha2::{Digest, Sha256};
use std::fmt::Write;
use strut_formats::GENERATOR;

/// SHA-256 of bytes.
pub(super) fn sha256(bytes: &[u8]) -> [u8; 32] {
    Sha256::digest(bytes).into()
}

/// A digest as hexadecimal digits.
pub(super) fn hex(digest: [u8; 32]) -> String {
    digest.iter().fold(String::with_capacity(64), |mut text, byte| {
        // Writing to a string cannot fail.
        let _ = write!(text, "{byte:02x}");
        text
    })
}

/// SHA-256 of bytes as hexadecimal digits.
pub(super) fn sha256_hex(bytes: &[u8]) -> String {
    hex(sha256(bytes))
}

/// What all outputs of a variant depend on.
#[derive(Clone, Debug)]
pub(super) struct Digests {
    database: String,
    settings: String,
}

impl Digests {
    /// Of a database's digest and the [canonical text](crate::stylize::StyleSettings::canonical) of the settings.
    pub(super) fn new(database: &str, settings: &str) -> Self {
        Self { database: database.to_owned(), settings: settings.to_owned() }
    }

    /// The key of the job with an input of this digest. It holds the version of the program too, whose outputs may differ.
    pub(super) fn key(&self, input: &str) -> String {
        sha256_hex([GENERATOR, &self.database, &self.settings, input].join("\n").as_bytes())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digests_are_those_of_the_standard() {
        // FIPS 180-2, appendix B.1.
        assert_eq!(sha256_hex(b"abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    }

    #[test]
    fn a_key_changes_with_whatever_the_output_depends_on() {
        let key = |database, settings, input| Digests::new(database, settings).key(input);
        let first = key("d", "s", "i");
        assert_eq!(first, key("d", "s", "i"));
        for other in [key("D", "s", "i"), key("d", "S", "i"), key("d", "s", "I")] {
            assert_ne!(first, other);
        }
    }
}
