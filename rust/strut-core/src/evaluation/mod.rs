//! How good the transfer is, measured on real performances (specification §12; the paper's section 7).
//!
//! [`leave_one_out`] holds a take out of a database, styles it and compares the result with what the same
//! performer did in the target style ([`truth`]). [`off_database`] measures what becomes of motion that a
//! database does not hold; [`quality`] what can be said of any output. Numbers only: what they should be is
//! for others to say.

pub mod leave_one_out;
pub mod off_database;
pub mod quality;
pub mod truth;
