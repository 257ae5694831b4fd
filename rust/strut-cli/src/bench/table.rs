//! Timings as a table, next to the paper's.

use super::measure::{Mode, Row};
use std::fmt::Write;

/// The search time of [`PAPER_MS`].
pub(super) const PAPER_SEARCH_MS: f64 = 7.31;
/// Times of Table 2 of Xia et al. 2015, milliseconds, at 79,829 frames; the search ran on a GPU. Its post-processing
/// corresponds to our footplant.
const PAPER_MS: [(&str, f64); 4] =
    [("frame", 18.1), ("search", PAPER_SEARCH_MS), ("regression", 9.7), ("footplant", 1.09)];

/// Returns one line per stage, with median and 95th percentile in every mode.
pub(super) fn text(rows: &[Row], frames: usize, classes: usize) -> String {
    let mut out = format!("\n{frames} frames, {classes} classes; milliseconds, median and 95th percentile\n\n");
    let mut line = |stage: &str, cells: [String; 3], paper: &str| {
        let cells = cells.map(|cell| format!("{cell:>19}")).concat();
        // Writing to a string cannot fail.
        let _ = writeln!(out, "{stage:<13}{cells}{paper:>9}");
    };
    line("", Mode::ALL.map(|mode| mode.name().to_owned()), "paper");
    let mut stages: Vec<&str> = Vec::new();
    for row in rows {
        if !stages.contains(&row.stage) {
            stages.push(row.stage);
        }
    }
    for stage in stages {
        let cells = Mode::ALL.map(|mode| {
            let row = rows.iter().find(|r| r.stage == stage && r.mode == mode.name());
            row.map_or(String::new(), |r| format!("{} {:>8}", short(r.median_ms), short(r.p95_ms)))
        });
        let paper = PAPER_MS.iter().find(|(name, _)| *name == stage).map_or(String::new(), |(_, ms)| ms.to_string());
        line(stage, cells, &paper);
    }
    out
}

/// Formats milliseconds with about four digits.
pub(super) fn short(ms: f64) -> String {
    let decimals = if ms < 1.0 {
        4
    } else if ms < 100.0 {
        2
    } else {
        0
    };
    format!("{ms:.decimals$}")
}
