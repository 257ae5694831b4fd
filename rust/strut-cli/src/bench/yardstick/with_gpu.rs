//! The exhaustive search with wgpu.

use super::super::measure::{Row, ms_since};
use super::super::recall::{self, K};
use super::super::table::{PAPER_SEARCH_MS, short};
use crate::print::print;
use serde::Serialize;
use std::fmt::Write;
use std::time::Instant;
use strut_core::search::{Index, QueryWindow};
use strut_gpu::{Adapter, Context, GpuError, Searcher};
use strut_tasks::Outcome;

/// Number of queries per batch in mode `batch`.
const BATCH: usize = 256;
/// Number of queries that are searched one by one in mode `all`, and compared where times are not meaningful.
const SINGLE: usize = 64;
/// Number of first searches of each mode that are not measured: drivers finish their compilation late.
const WARM_UP: usize = 3;
/// Name of the engine in reports.
const ENGINE: &str = "gpu-brute";

/// An open GPU.
pub(in crate::bench) struct Yardstick {
    context: Context,
}

/// Results of a GPU, compared with the engine's.
#[derive(Serialize)]
pub(in crate::bench) struct Comparison {
    adapter: String,
    driver: String,
    backend: String,
    /// Whether the GPU is emulated in software; there are no times then.
    software: bool,
    frames: usize,
    classes: usize,
    /// Number of sets of neighbours, one for each window and class.
    sets: usize,
    /// Number of sets that are bit-identical to the engine's.
    identical: usize,
    candidates_per_neighbour: f64,
    /// Number of sets for which the engine had to search.
    searched_by_engine: usize,
    /// Ratio of the median search times, GPU to engine from a cold start.
    #[serde(skip_serializing_if = "Option::is_none")]
    engine_is_faster: Option<Ratios>,
}

/// A ratio for each mode.
#[derive(Clone, Copy, Serialize)]
struct Ratios {
    all: f64,
    batch: f64,
}

impl Yardstick {
    /// Opens the fastest GPU. Prints a message if there is none.
    #[allow(clippy::unnecessary_wraps)] // Without the feature `gpu` it fails.
    pub(in crate::bench) fn open() -> Outcome<Option<Self>> {
        match Context::new() {
            Ok(context) => {
                print(&format!("{}\n", context.adapter()));
                Ok(Some(Self { context }))
            }
            Err(reason) => {
                print(&format!("{}; only the CPU is measured\n", capitalised(&reason.to_string())));
                Ok(None)
            }
        }
    }

    /// Searches for the windows' neighbours in every class, and prints and returns the comparison. Prints a message if
    /// the GPU fails.
    pub(in crate::bench) fn measure(&self, index: &Index, windows: &[QueryWindow]) -> Option<(Vec<Row>, Comparison)> {
        let measured = self.try_to_measure(index, windows);
        measured
            .map_err(|reason| {
                print(&format!("\n{}; only the CPU is measured\n", capitalised(&reason.to_string())));
            })
            .ok()
    }

    fn try_to_measure(&self, index: &Index, windows: &[QueryWindow]) -> Result<(Vec<Row>, Comparison), GpuError> {
        let adapter = self.context.adapter();
        let mut searcher = Searcher::new(index, self.context.clone())?;
        let compared: Vec<QueryWindow> =
            if adapter.is_software { spread(windows, SINGLE) } else { spread(windows, windows.len()) };
        let found = searcher.nearest(&compared, K)?;
        let (expected, native_ms) = recall::search(index, &compared);
        let sets = || expected.iter().flatten().zip(found.neighbours.iter().flatten());
        let identical = sets().filter(|(a, b)| a.as_slice() == b.as_slice()).count();
        let neighbours: usize = expected.iter().flatten().map(|set| set.as_slice().len()).sum();
        let mut comparison = Comparison {
            adapter: adapter.name.clone(),
            driver: adapter.driver.clone(),
            backend: adapter.backend.clone(),
            software: adapter.is_software,
            frames: index.rows(),
            classes: index.classes(),
            sets: sets().count(),
            identical,
            candidates_per_neighbour: found.candidates as f64 / neighbours.max(1) as f64,
            searched_by_engine: found.searched_by_index,
            engine_is_faster: None,
        };
        let row = |mode, engine, samples| Row::of(engine, "search", mode, index.rows(), index.classes(), samples);
        let mut rows = Vec::new();
        if !adapter.is_software {
            let native = row("batch", "native", native_ms);
            let all = row("all", ENGINE, times(&mut searcher, &spread(windows, SINGLE), 1)?);
            let batch = row("batch", ENGINE, times(&mut searcher, windows, BATCH)?);
            let ratio = |row: &Row| row.median_ms / native.median_ms;
            comparison.engine_is_faster = Some(Ratios { all: ratio(&all), batch: ratio(&batch) });
            rows = vec![native, all, batch];
        }
        print(&text(adapter, &comparison, &rows));
        Ok((rows, comparison))
    }
}

/// Returns at most `most` windows, evenly distributed.
fn spread(windows: &[QueryWindow], most: usize) -> Vec<QueryWindow> {
    windows.iter().step_by(windows.len().div_ceil(most.max(1)).max(1)).cloned().collect()
}

/// Returns the milliseconds per window in portions of `at_a_time`, including upload, readback and exact re-ranking.
fn times(searcher: &mut Searcher<&Index>, windows: &[QueryWindow], at_a_time: usize) -> Result<Vec<f64>, GpuError> {
    let one = |windows: &[QueryWindow]| {
        let started = Instant::now();
        searcher.nearest(windows, K)?;
        Ok(ms_since(started) / windows.len() as f64)
    };
    // Only whole portions are measured, unless there is only a shorter one.
    let portions = || windows.chunks(at_a_time).filter(|w| w.len() == at_a_time.min(windows.len()));
    let all: Vec<f64> = portions().take(WARM_UP).chain(portions()).map(one).collect::<Result<_, _>>()?;
    Ok(all[WARM_UP.min(all.len() / 2)..].to_vec())
}

/// Returns a text with its first letter as a capital.
fn capitalised(reason: &str) -> String {
    let mut letters = reason.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

/// Returns a description of the comparison, and one line per time.
fn text(adapter: &Adapter, comparison: &Comparison, rows: &[Row]) -> String {
    let Comparison { sets, identical, candidates_per_neighbour, .. } = comparison;
    let mut out = format!(
        "\nevery window by {adapter}: {identical} of {sets} neighbour sets are bit-identical to the engine's, \
         {candidates_per_neighbour:.2} candidates per neighbour\n"
    );
    for row in rows {
        let (engine, mode, ms) = (row.engine, row.mode, short(row.median_ms));
        let ratio = rows[0].median_ms / row.median_ms;
        let paper = PAPER_SEARCH_MS / row.median_ms;
        // Writing to a string cannot fail.
        let _ = writeln!(
            out,
            "{engine:<10}{mode:<6}{ms:>10} ms a window, {ratio:.3} × as fast as native, {paper:.2} × as the paper"
        );
    }
    if comparison.software {
        out += "times of an emulated GPU are not shown, as they would not be meaningful\n";
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_reason_is_capitalised() {
        let of = ["no adapter was found", "", "écran", "ßx"].map(capitalised);
        assert_eq!(of, ["No adapter was found", "", "Écran", "SSx"]);
    }
}
