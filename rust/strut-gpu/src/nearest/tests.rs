//! Both variants of the exhaustive search, compared with the index.

use super::{Found, Graphics, Kernels, Prepared, Searcher};
use crate::error::GpuError;
use crate::kernels::{distances, select};
use crate::rounding;
use crate::test_data;
use crate::windows::{Batch, table};
use proptest::prelude::*;
use strut_core::search::{Index, Metric, Neighbours, PackedWindows, QueryWindow};

const K: usize = 40;

/// Returns a searcher on the GPU, if there is one.
fn with_graphics(index: &Index) -> Option<Searcher<&Index>> {
    let mut searcher = Searcher::without_graphics(index).unwrap();
    searcher.graphics = Some(Graphics::new(kernels()?, &searcher.table).unwrap());
    Some(searcher)
}

fn kernels() -> Option<Kernels> {
    Some(Kernels::new(test_data::context()?).unwrap())
}

fn prepared<'a>(index: &Index, windows: &'a [QueryWindow]) -> Vec<Prepared<'a>> {
    windows.iter().map(|window| (window, index.prepare(window, Metric::FullBody))).collect()
}

/// Returns the number of sets that differ from those of the index.
fn differing(index: &Index, windows: &[QueryWindow], found: &Found) -> usize {
    let (mut scratch, mut expected, mut differing) = (index.scratch(K), Neighbours::default(), 0);
    for ((_, query), of_query) in prepared(index, windows).iter().zip(&found.neighbours) {
        for (class, found) in of_query.iter().enumerate() {
            index.nearest(query, &[class], K, &mut scratch, &mut expected);
            differing += usize::from(found.as_slice() != expected.as_slice());
        }
    }
    differing
}

/// Returns the results of a searcher that trusts the GPU's order.
fn without_margin(searcher: &mut Searcher<&Index>, windows: &[QueryWindow]) -> Found {
    let queries = prepared(searcher.index, windows);
    let mut batch = Batch::new(&searcher.table, searcher.index, &queries).unwrap();
    batch.margins.fill(0.0);
    let selected = pollster::block_on(searcher.select(&batch, K)).unwrap();
    searcher.rank(&queries, &batch.margins, &selected, K)
}

/// Checks that the sets of a searcher are the index's, with only a few more candidates than neighbours.
fn check_sets(mut searcher: Searcher<&Index>) {
    let (index, windows) = (searcher.index, test_data::foreign_windows());
    let found = searcher.nearest(&windows, K).unwrap();
    assert_eq!(differing(index, &windows, &found), 0);
    assert_eq!(found.searched_by_index, 0);
    let neighbours: usize = found.neighbours.iter().flatten().map(|n| n.as_slice().len()).sum();
    assert_eq!(neighbours, windows.len() * index.classes() * K);
    let share = found.candidates as f64 / neighbours as f64;
    assert!((1.0..=1.2).contains(&share), "{share} candidates a neighbour");
    // One window, and none.
    let one = searcher.nearest(&windows[3..4], K).unwrap();
    assert_eq!(differing(index, &windows[3..4], &one), 0);
    assert!(searcher.nearest(&[], K).unwrap().neighbours.is_empty());
    assert_eq!(searcher.nearest(&[QueryWindow::default()], K).unwrap_err(), GpuError::WindowLength(0));
}

/// Checks that windows that differ by micrometres are found only with the margin.
fn check_near_copies(index: &Index, mut searcher: Searcher<&Index>) {
    let windows = test_data::foreign_windows();
    let found = searcher.nearest(&windows, K).unwrap();
    assert_eq!(differing(index, &windows, &found), 0);
    assert_eq!(found.searched_by_index, 0, "the windows were to fit the places");
    assert!(differing(index, &windows, &without_margin(&mut searcher, &windows)) > 0);
}

/// Returns an index of near copies, as many as there are places.
fn near_copies() -> Index {
    Index::build(&test_data::trembling(&[select::PLACES]))
}

#[test]
fn twins_find_what_the_index_finds() {
    check_sets(Searcher::without_graphics(test_data::index()).unwrap());
}

#[test]
fn a_graphics_processor_finds_what_the_index_finds() {
    let Some(searcher) = with_graphics(test_data::index()) else { return };
    check_sets(searcher);
}

#[test]
fn twins_need_the_margin() {
    let index = near_copies();
    check_near_copies(&index, Searcher::without_graphics(&index).unwrap());
}

#[test]
fn a_graphics_processor_needs_the_margin() {
    let index = near_copies();
    let Some(searcher) = with_graphics(&index) else { return };
    check_near_copies(&index, searcher);
}

#[test]
fn the_index_searches_where_more_seem_near_than_there_are_places_for() {
    let many = Index::build(&test_data::trembling(&[select::PLACES + 1, 5]));
    let windows = &test_data::foreign_windows()[..3];
    let searchers = std::iter::once(Searcher::without_graphics(&many).unwrap()).chain(with_graphics(&many));
    for mut searcher in searchers {
        let found = searcher.nearest(windows, K).unwrap();
        assert_eq!(differing(&many, windows, &found), 0);
        assert_eq!(found.searched_by_index, windows.len());
        // A class may have fewer windows than requested.
        assert_eq!(found.neighbours[0][1].as_slice().len(), 5);
    }
}

/// Returns the greatest difference between a GPU's distances and the twin's, relative to the bound.
fn greatest_difference(graphics: &mut Graphics, table: &PackedWindows, batch: &Batch) -> f32 {
    let found = graphics.distances(table, batch).unwrap();
    let mut greatest: f32 = 0.0;
    for (q, found) in found.chunks_exact(table.windows.len()).enumerate() {
        let twin = distances::distances(table, &batch.queries[q]);
        for class in &table.classes {
            let bound = rounding::bound(batch.queries[q].window.norm, class.greatest);
            for (found, twin) in found[class.windows()].iter().zip(&twin[class.windows()]) {
                greatest = greatest.max((found - twin).abs() / bound);
            }
        }
    }
    greatest
}

#[test]
fn kernels_compute_what_their_twins_compute() {
    let Some(kernels) = kernels() else { return };
    let mut runner = proptest::test_runner::TestRunner::new(ProptestConfig::with_cases(16));
    runner
        .run(&(test_data::random_database(), test_data::random_windows(), 1usize..60), |(db, windows, k)| {
            let index = Index::build(&db);
            let table = table(&index).unwrap();
            let batch = Batch::new(&table, &index, &prepared(&index, &windows)).unwrap();
            let mut graphics = Graphics::new(kernels.clone(), &table).unwrap();
            let difference = greatest_difference(&mut graphics, &table, &batch);
            prop_assert!(difference <= 1.0, "{} times the bound", difference);

            // Selection is exact for the given distances.
            let selected = pollster::block_on(graphics.select(&table, &batch, k)).unwrap();
            let all = graphics.distances(&table, &batch).unwrap();
            for (q, all) in all.chunks_exact(table.windows.len()).enumerate() {
                let margins = &batch.margins[q * table.classes.len()..][..table.classes.len()];
                let twin = select::select(&table, all, margins, k);
                for (c, twin) in twin.chunks_exact(select::WORDS).enumerate() {
                    let found = &selected[(q * table.classes.len() + c) * select::WORDS..][..select::WORDS];
                    let sorted = |found| {
                        select::windows(found).map(|windows: &[u32]| {
                            let mut windows = windows.to_vec();
                            windows.sort_unstable();
                            windows
                        })
                    };
                    prop_assert_eq!(sorted(found), sorted(twin));
                }
            }
            Ok(())
        })
        .unwrap();
}

#[test]
fn a_lost_device_is_said_to_be_lost_and_remains_so() {
    let Some(context) = test_data::own_context() else { return };
    let mut searcher = Searcher::new(test_data::index(), context).unwrap();
    let windows = test_data::foreign_windows();
    assert!(searcher.nearest(&windows[..2], K).is_ok());
    searcher.graphics.as_ref().unwrap().kernels.context.destroy();
    for _ in 0..2 {
        assert!(matches!(searcher.nearest(&windows, K), Err(GpuError::Lost(_))));
    }
}

#[test]
fn windows_of_another_length_are_refused() {
    let index = Index::with_window(test_data::database(), 7);
    assert_eq!(Searcher::without_graphics(&index).unwrap_err(), GpuError::WindowLength(7));
}
