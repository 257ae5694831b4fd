//! What Strut is measured with, apart from the product: trained methods for comparison ([`baselines`]), yardsticks of
//! the [`search`], and evaluations.
//!
//! Evaluation of the transfer on real performances (`docs/methods/mar.md` §12; the paper's section 7):
//! [`leave_one_out`] holds a take out of a database, styles it and compares the result with the same performer's take
//! in the target style ([`truth`]). [`off_database`] measures the result for motion that is unlike the database;
//! [`quality`] needs no reference, and [`style_progress`] compares with the mean of the takes of the style. The modules
//! compute numbers only, no thresholds.
//!
//! [`walk`] evaluates walk synthesis, [`key_style`] key-styling.
#![forbid(unsafe_code)]

pub mod baselines;
#[cfg(test)]
#[path = "../../strut-core/src/fixtures.rs"]
mod fixtures;
pub mod key_style;
pub mod leave_one_out;
pub mod off_database;
pub mod quality;
pub mod search;
pub mod style_progress;
pub mod truth;
pub mod walk;
