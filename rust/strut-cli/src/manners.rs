//! Styles that are performed in two manners, as reports name them.

use serde::Serialize;
use std::fmt::Write;
use strut_core::database::TwoManners;

/// A style of two manners in JSON.
#[derive(Serialize)]
pub(crate) struct TwoMannersEntry {
    pub(crate) action: String,
    pub(crate) style: String,
    pub(crate) separation: f32,
    pub(crate) clips: [Vec<String>; 2],
}

/// The entries of what was found.
pub(crate) fn entries(found: &[TwoManners]) -> Vec<TwoMannersEntry> {
    let entry = |TwoManners { action, style, separation, clips }: TwoManners| TwoMannersEntry {
        action,
        style,
        separation,
        clips,
    };
    found.iter().cloned().map(entry).collect()
}

impl TwoMannersEntry {
    /// What was found, and what it leads to.
    pub(crate) fn sentence(&self) -> String {
        format!(
            "{}/{} is performed in two manners, {:.1} times as far apart as two takes usually are, and styles to the \
             mean of both; a style of its own for either keeps them apart",
            self.action, self.style, self.separation
        )
    }
}

/// A line for every style of two manners and one for the clips of each.
pub(crate) fn text(found: &[TwoMannersEntry]) -> String {
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
