//! The search method on the command line: `exact`, or `kdtree:160`.

use serde::{Serialize, Serializer};
use std::fmt;
use std::num::NonZero;
use std::str::FromStr;
use strut_core::search::Index;
use strut_evaluation::search::with_kd_trees;
use strut_formats::quotation;

/// Default number of candidates of a kd-tree.
const CANDIDATES: NonZero<usize> = NonZero::new(160).unwrap();

/// Exact search, or search among a number of candidates of each class's kd-tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Search {
    /// All windows that the bounds do not exclude are compared.
    Exact,
    /// The nearest candidates of a kd-tree are compared.
    KdTree {
        /// Number of compared windows in each class.
        candidates: NonZero<usize>,
    },
}

impl Search {
    /// Returns the index with this search.
    pub fn of(self, index: Index) -> Index {
        match self {
            Self::Exact => index,
            Self::KdTree { candidates } => with_kd_trees(index, candidates),
        }
    }
}

impl FromStr for Search {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let candidates = match text.split_once(':') {
            None if text == "exact" => return Ok(Self::Exact),
            None if text == "kdtree" => Some(CANDIDATES),
            Some(("kdtree", number)) => number.parse().ok(),
            _ => None,
        };
        let expected =
            || format!("the search is '{}'; exact, kdtree or kdtree:CANDIDATES was expected", quotation(text, 40));
        candidates.map(|candidates| Self::KdTree { candidates }).ok_or_else(expected)
    }
}

impl fmt::Display for Search {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Exact => f.write_str("exact"),
            Self::KdTree { candidates } => write!(f, "kdtree:{candidates}"),
        }
    }
}

impl Serialize for Search {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.collect_str(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_search_reads_as_it_is_written_and_anything_else_is_refused() {
        for text in ["exact", "kdtree:40"] {
            assert_eq!(text.parse::<Search>().unwrap().to_string(), text);
        }
        assert_eq!("kdtree".parse::<Search>().unwrap().to_string(), "kdtree:160");
        for text in ["", "kdtree:", "kdtree:0", "kdtree:-1", "exact:40", "tree"] {
            assert!(text.parse::<Search>().unwrap_err().contains(&format!("'{text}'")));
        }
        assert!("x".repeat(5000).parse::<Search>().unwrap_err().len() < 200);
    }
}
