//! Bimodal styles in reports.

use serde::Serialize;
use std::fmt::Write;
use strut_core::database::BimodalStyle;

/// A bimodal style in JSON.
#[derive(Serialize)]
pub(crate) struct BimodalEntry {
    pub(crate) action: String,
    pub(crate) style: String,
    pub(crate) separation: f32,
    pub(crate) clips: [Vec<String>; 2],
}

/// Converts the results to entries.
pub(crate) fn entries(found: &[BimodalStyle]) -> Vec<BimodalEntry> {
    let entry = |BimodalStyle { action, style, separation, clips }: BimodalStyle| BimodalEntry {
        action,
        style,
        separation,
        clips,
    };
    found.iter().cloned().map(entry).collect()
}

impl BimodalEntry {
    /// Returns a sentence about the style and its consequence.
    pub(crate) fn sentence(&self) -> String {
        format!(
            "the takes of {}/{} form two groups, {:.1} times as far apart as two takes usually are; the style is the \
             mean \
             of both. To keep them apart, label the groups as two styles",
            self.action, self.style, self.separation
        )
    }
}

/// Returns a line for every bimodal style, and one for the clips of each cluster.
pub(crate) fn text(found: &[BimodalEntry]) -> String {
    let mut out = String::new();
    for entry in found {
        // Writing to a string cannot fail.
        let _ = writeln!(out, "note: {}", entry.sentence());
        for names in &entry.clips {
            let _ = writeln!(out, "  {}", names.join(", "));
        }
    }
    out
}
