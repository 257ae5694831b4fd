//! Yardsticks of the search: kd-trees, and the share of the nearest windows that a search finds.

mod kd_trees;
mod recall;

pub use kd_trees::with_kd_trees;
pub use recall::{ClassSearch, Recall};

#[cfg(test)]
mod tests;
