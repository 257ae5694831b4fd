//! Recall and time of kd-trees, beside the exact search.

use super::measure::{ms_since, percentile};
use crate::search::Search;
use serde::Serialize;
use std::fmt::Write;
use std::num::NonZero;
use std::time::Instant;
use strut_core::catalogue::Catalogue;
use strut_core::pose_vector::HeadingFilter;
use strut_core::search::{Index, Metric, Neighbours, QueryWindow, Scratch};
use strut_demo::benchmark::Query;

/// Neighbours that are looked for in every class.
const K: usize = 40;
/// Candidates of a kd-tree.
const CANDIDATES: [usize; 4] = [40, 80, 160, 320];
/// Frames between two that are searched.
const STRIDE: usize = 5;

/// One way to search: what it finds of the [`K`] nearest windows of every class, from a cold start.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct SearchRow {
    search: Search,
    frames: usize,
    classes: usize,
    /// Share of the nearest windows that are found.
    recall: f64,
    /// Milliseconds for all classes.
    median_ms: f64,
    p95_ms: f64,
}

/// The exact search and kd-trees of several sizes on the same windows.
pub(super) fn measure(db: &Catalogue, index: &Index, queries: &[Query]) -> Vec<SearchRow> {
    let windows: Vec<QueryWindow> = queries.iter().flat_map(|query| windows(db, query)).collect();
    let (exact, times) = search(index, &windows);
    let trees = CANDIDATES.into_iter().filter_map(NonZero::new).map(|candidates| Search::KdTree { candidates });
    let found = trees.map(|trees| {
        let (found, times) = search(&trees.of(index.clone()), &windows);
        (trees, found, times)
    });
    let found: Vec<_> = found.collect();
    std::iter::once((Search::Exact, exact.clone(), times))
        .chain(found)
        .map(|(search, found, mut times)| {
            times.sort_by(f64::total_cmp);
            let [median_ms, p95_ms] = [0.5, 0.95].map(|share| percentile(&times, share));
            SearchRow {
                search,
                frames: db.frames(),
                classes: index.classes(),
                recall: share_found(&exact, &found),
                median_ms,
                p95_ms,
            }
        })
        .collect()
}

/// A line each.
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

/// Windows of a motion, here and there.
fn windows(db: &Catalogue, query: &Query) -> Vec<QueryWindow> {
    let (mut window, mut filter) = (QueryWindow::default(), HeadingFilter::default());
    let all = query.motion.poses.iter().map(|pose| {
        window.follow(pose, &db.proportions, db.rate_hz, &mut filter);
        window.clone()
    });
    all.skip(STRIDE).step_by(STRIDE).collect()
}

/// The rows found in every class for every window, sorted, and the milliseconds that each window took.
fn search(index: &Index, windows: &[QueryWindow]) -> (Vec<Vec<u32>>, Vec<f64>) {
    let (mut scratch, mut rows, mut times) = (Scratch::default(), Vec::new(), Vec::new());
    for window in windows {
        let mut found = vec![Neighbours::default(); index.classes()];
        let started = Instant::now();
        let query = index.prepare(window, Metric::FullBody);
        for (class, found) in found.iter_mut().enumerate() {
            index.nearest(&query, &[class], K, &mut scratch, found);
        }
        times.push(ms_since(started));
        rows.extend(found.iter().map(|found| {
            let mut rows: Vec<u32> = found.as_slice().iter().map(|n| n.row).collect();
            rows.sort_unstable();
            rows
        }));
    }
    (rows, times)
}

/// Share of the first rows that are among the second, list by list.
fn share_found(exact: &[Vec<u32>], found: &[Vec<u32>]) -> f64 {
    let hits =
        |(exact, found): (&Vec<u32>, &Vec<u32>)| exact.iter().filter(|&r| found.binary_search(r).is_ok()).count();
    let all: usize = exact.iter().map(Vec::len).sum();
    exact.iter().zip(found).map(hits).sum::<usize>() as f64 / all.max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use strut_demo::benchmark;

    #[test]
    fn more_candidates_find_more_of_the_nearest_and_the_exact_search_all() {
        let catalogue = Catalogue::new(benchmark::database(20_000).unwrap());
        let rows = measure(&catalogue, catalogue.index(), &benchmark::queries()[..1]);
        let recalls: Vec<f64> = rows.iter().map(|row| row.recall).collect();
        assert!((recalls[0] - 1.0).abs() < f64::EPSILON);
        assert!(recalls[1] < 0.98, "{recalls:?}");
        assert!(recalls[1..].windows(2).all(|r| r[0] <= r[1]) && recalls[4] > 0.95, "{recalls:?}");
    }
}
