//! Recall and time of kd-trees, compared with the exact search.

use super::measure::{ms_since, percentile};
use serde::Serialize;
use std::fmt::Write;
use std::num::NonZero;
use std::time::Instant;
use strut_core::catalogue::Catalogue;
use strut_core::pose_vector::HeadingFilter;
use strut_core::search::{Index, Neighbours, QueryWindow};
use strut_demo::benchmark::Query;
use strut_evaluation::search::{ClassSearch, Recall};
use strut_tasks::search::Search;

/// Number of neighbours per class.
pub(super) const K: usize = 40;
/// Numbers of candidates of a kd-tree.
const CANDIDATES: [usize; 4] = [40, 80, 160, 320];
/// Distance between searched frames.
const STRIDE: usize = 5;

/// Results of one search method: the share of the [`K`] nearest windows of every class that it finds from a cold start.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct SearchRow {
    search: Search,
    frames: usize,
    classes: usize,
    /// Share of the nearest windows that are found.
    recall: f64,
    /// Median time for all classes, milliseconds.
    median_ms: f64,
    p95_ms: f64,
}

/// Measures the exact search and kd-trees of several sizes on the same windows.
pub(super) fn measure(db: &Catalogue, index: &Index, windows: &[QueryWindow]) -> Vec<SearchRow> {
    let (nearest, times) = search(index, windows);
    let row = |search: Search, found: &[Vec<Neighbours>], mut times: Vec<f64>| {
        let mut recall = Recall::default();
        nearest.iter().zip(found).for_each(|(nearest, found)| recall.add(nearest, found));
        times.sort_by(f64::total_cmp);
        let [median_ms, p95_ms] = [0.5, 0.95].map(|share| percentile(&times, share));
        let (frames, classes) = (db.frames(), index.classes());
        SearchRow { search, frames, classes, recall: recall.share(), median_ms, p95_ms }
    };
    let exact = row(Search::Exact, &nearest, times);
    let trees = CANDIDATES.into_iter().filter_map(NonZero::new).map(|candidates| Search::KdTree { candidates });
    let trees = trees.map(|trees| {
        let (found, times) = search(&trees.of(index.clone()), windows);
        row(trees, &found, times)
    });
    std::iter::once(exact).chain(trees).collect()
}

/// Returns one line per method.
pub(super) fn text(rows: &[SearchRow]) -> String {
    let mut out = format!("\n{:<13}{:>10}{:>19}\n", "cold search", "recall", "ms, all classes");
    for row in rows {
        // Writing to a string cannot fail.
        let _ = writeln!(
            out,
            "{:<13}{:>10.3}{:>10.2}{:>9.2}",
            row.search.to_string(),
            row.recall,
            row.median_ms,
            row.p95_ms
        );
    }
    out
}

/// Returns windows of motions at a fixed stride.
pub(super) fn all_windows(db: &Catalogue, queries: &[Query]) -> Vec<QueryWindow> {
    queries.iter().flat_map(|query| windows(db, query)).collect()
}

fn windows(db: &Catalogue, query: &Query) -> Vec<QueryWindow> {
    let (mut window, mut filter) = (QueryWindow::default(), HeadingFilter::default());
    let all = query.motion.poses.iter().map(|pose| {
        window.follow(pose, &db.proportions, db.rate_hz, &mut filter);
        window.clone()
    });
    all.skip(STRIDE).step_by(STRIDE).collect()
}

/// Searches every class for every window from a cold start. Returns the neighbours, and the milliseconds per window.
pub(super) fn search(index: &Index, windows: &[QueryWindow]) -> (Vec<Vec<Neighbours>>, Vec<f64>) {
    let mut search = ClassSearch::default();
    let one = |window| {
        search.forget();
        let started = Instant::now();
        let found = search.find(index, window, K);
        let ms = ms_since(started);
        (found.to_vec(), ms)
    };
    windows.iter().map(one).unzip()
}

#[cfg(test)]
mod tests {
    use super::*;
    use strut_demo::benchmark;

    #[test]
    fn more_candidates_find_more_of_the_nearest_and_the_exact_search_all() {
        let catalogue = Catalogue::new(benchmark::database(20_000).unwrap());
        let windows = all_windows(&catalogue, &benchmark::queries()[..1]);
        let rows = measure(&catalogue, catalogue.index(), &windows);
        let recalls: Vec<f64> = rows.iter().map(|row| row.recall).collect();
        assert!((recalls[0] - 1.0).abs() < f64::EPSILON);
        assert!(recalls[1] < 0.98, "{recalls:?}");
        assert!(recalls[1..].windows(2).all(|r| r[0] <= r[1]) && recalls[4] > 0.95, "{recalls:?}");
    }
}
