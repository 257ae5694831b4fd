//! Evaluation of the transfer on real performances (`docs/methods/mar.md` §12; the paper's section 7).
//!
//! [`leave_one_out`] holds a take out of a database, styles it and compares the result with the same performer's take in
//! the target style ([`truth`]). [`off_database`] measures the result for motion unlike the database's; [`quality`]
//! needs no reference, and [`style_progress`] the takes of the style as a whole. Numbers only, no thresholds.

pub mod leave_one_out;
pub mod off_database;
pub mod quality;
pub mod style_progress;
pub mod truth;
