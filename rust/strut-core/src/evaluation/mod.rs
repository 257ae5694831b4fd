//! How good the transfer is, measured on real performances (specification §12; the paper's section 7).

pub mod off_database;
