//! Hash of everything that an output depends on.

use crate::digest::sha256_hex;
use strut_formats::GENERATOR;

/// Digests of what all outputs of a variant depend on.
#[derive(Clone, Debug)]
pub(super) struct Digests {
    database: String,
    settings: String,
}

impl Digests {
    /// Combines a database's digest and the [canonical text](crate::stylize::StyleSettings::canonical) of the settings.
    pub(super) fn new(database: &str, settings: &str) -> Self {
        Self { database: database.to_owned(), settings: settings.to_owned() }
    }

    /// Returns the key of the job with this input digest. It includes the program's version, since outputs may differ
    /// between versions.
    pub(super) fn key(&self, input: &str) -> String {
        sha256_hex([GENERATOR, &self.database, &self.settings, input].join("\n").as_bytes())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
