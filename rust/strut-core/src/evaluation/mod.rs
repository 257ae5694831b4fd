//! Evaluation of the transfer on real performances (`docs/methods/mar.md` §12; the paper's section 7).
//!
//! [`leave_one_out`] holds a take out of a database, styles it and compares the result with the same performer's take
//! in the target style ([`truth`]). [`off_database`] measures the result for motion that is unlike the database;
//! [`quality`] needs no reference, and [`style_progress`] compares with the mean of the takes of the style. The modules
//! compute numbers only, no thresholds.

pub mod leave_one_out;
pub mod off_database;
pub mod quality;
pub mod style_progress;
pub mod truth;
