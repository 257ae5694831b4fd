//! What an output depends on, as a number.

use crate::digest::sha256_hex;
use strut_formats::GENERATOR;

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
    fn a_key_changes_with_whatever_the_output_depends_on() {
        let key = |database, settings, input| Digests::new(database, settings).key(input);
        let first = key("d", "s", "i");
        assert_eq!(first, key("d", "s", "i"));
        for other in [key("D", "s", "i"), key("d", "S", "i"), key("d", "s", "I")] {
            assert_ne!(first, other);
        }
    }
}
