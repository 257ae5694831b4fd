//! Pictures of a GPU, compared with the CPU twin of the kernel and with the engine's own.

use super::*;
use crate::kernels::atlas::picture;
use crate::rounding;
use crate::test_data;
use crate::windows::{query_words, words};
use proptest::prelude::*;
use strut_core::search::{Atlas, AtlasView, BodyPart, Index, PackedQuery, PackedWindows};

fn painter(context: &Context, table: &PackedWindows) -> Painter {
    let windows = words(table.windows.iter().copied());
    Painter::new(context.clone(), table.rows.as_flattened(), windows.as_flattened()).unwrap()
}

fn drawn(painter: &mut Painter, queries: &[PackedQuery]) -> Vec<u32> {
    let (rows, windows) = query_words(queries);
    pollster::block_on(painter.draw(rows.as_flattened(), windows.as_flattened())).unwrap()
}

/// Returns the greatest difference of two pictures of `height` lines, relative to the bound.
fn greatest_difference(a: &[u32], b: &[u32], table: &PackedWindows, queries: &[PackedQuery], height: usize) -> f32 {
    let greatest = table.classes.iter().fold(0.0, |greatest: f32, class| greatest.max(class.greatest));
    let mut share: f32 = 0.0;
    assert_eq!((a.len(), b.len()), (queries.len() * height, queries.len() * height));
    for (i, (a, b)) in a.iter().zip(b).enumerate() {
        let bound = rounding::bound(queries[i / height].window.norm, greatest);
        if a != b {
            share = share.max((f32::from_bits(*a) - f32::from_bits(*b)).abs() / bound);
        }
    }
    share
}

fn view(part: BodyPart, windows: [usize; 2], height: usize) -> AtlasView {
    AtlasView { part, windows, height }
}

#[test]
fn pictures_are_those_of_the_twin() {
    let Some(context) = test_data::context() else { return };
    let mut runner = proptest::test_runner::TestRunner::new(ProptestConfig::with_cases(12));
    let views = (0usize..60, 1usize..60, 1usize..40, prop::sample::select(BodyPart::ALL.to_vec()));
    runner
        .run(&(test_data::random_database(), test_data::random_windows(), views), |(db, windows, views)| {
            let (first, count, height, part) = views;
            let index = Index::build(&db);
            let mut atlas = Atlas::new(&index, windows);
            atlas.set_view(view(part, [first, first + count], height));
            let height = atlas.view().height;
            let (queries, lines) = (atlas.packed_columns(&index), atlas.packed_lines());
            let table = atlas.packed(&index);
            let mut painter = painter(&context, table);
            painter.set_lines(&lines, height).unwrap();
            let found = drawn(&mut painter, &queries);
            let twin = picture(table, &queries, &lines, height);
            let difference = greatest_difference(&found, &twin, table, &queries, height);
            prop_assert!(difference <= 1.0, "{} times the bound", difference);

            // Lines that are shifted by one window give another picture.
            let mut shifted = lines.clone();
            shifted.rotate_right(1);
            if height > 1 && picture(table, &queries, &shifted, height) != twin {
                let other =
                    greatest_difference(&found, &picture(table, &queries, &shifted, height), table, &queries, height);
                prop_assert!(other > 1.0 || other.is_nan());
            }
            Ok(())
        })
        .unwrap();
}

/// Returns the grey level of D: from the least of the column to 3.2 times its root.
fn grey(d: f32, least: f32) -> f32 {
    ((d / least).sqrt() - 1.0) / 2.2 * 255.0
}

/// Returns the columns of the engine's own picture.
fn of_the_engine(atlas: &mut Atlas, index: &Index) -> Vec<f32> {
    let height = atlas.view().height;
    let mut all = vec![0.0; atlas.columns() * height];
    for (column, out) in all.chunks_exact_mut(height).enumerate() {
        atlas.draw(index, column, out);
    }
    all
}

#[test]
fn pictures_are_those_of_the_engine_within_a_grey_level() {
    let Some(context) = test_data::context() else { return };
    let index = test_data::index();
    let mut atlas = Atlas::new(index, test_data::foreign_windows());
    let all = *atlas.firsts().last().unwrap();
    for part in BodyPart::ALL {
        atlas.set_view(view(part, [0, all], 1));
        let least = of_the_engine(&mut atlas, index);
        let queries = atlas.packed_columns(index);
        let mut painter = painter(&context, atlas.packed(index));
        for (windows, height) in [([0, all], 200), ([all / 3, all / 3 + 150], 150), ([all - 1, all], 1)] {
            atlas.set_view(view(part, windows, height));
            painter.set_lines(&atlas.packed_lines(), height).unwrap();
            let (own, found) = (of_the_engine(&mut atlas, index), drawn(&mut painter, &queries));
            assert_eq!(own.len(), found.len());
            for (i, (own, found)) in own.iter().zip(&found).enumerate() {
                let [own, found] = [*own, f32::from_bits(*found)].map(|d| grey(d, least[i / height]));
                assert!(own.is_finite() && (own - found).abs() < 0.5, "{part:?}: {own} and {found}");
            }
        }
    }
}

#[test]
fn a_lost_device_is_said_to_be_lost() {
    let Some(context) = test_data::own_context() else { return };
    let index = test_data::index();
    let mut atlas = Atlas::new(index, test_data::foreign_windows());
    let queries = atlas.packed_columns(index);
    let mut painter = painter(&context, atlas.packed(index));
    painter.set_lines(&atlas.packed_lines(), 1).unwrap();
    assert_eq!(drawn(&mut painter, &queries).len(), queries.len());
    painter.destroy();
    let (rows, windows) = query_words(&queries);
    for _ in 0..2 {
        let result = pollster::block_on(painter.draw(rows.as_flattened(), windows.as_flattened()));
        assert!(matches!(result, Err(GpuError::Lost(_))), "{result:?}");
    }
}

#[test]
fn arrays_that_do_not_fit_each_other_are_refused() {
    let Some(context) = test_data::context() else { return };
    let index = test_data::index();
    let table = PackedWindows::new(index, BodyPart::Whole);
    let windows = words(table.windows.iter().copied());
    let (rows, windows) = (table.rows.as_flattened(), windows.as_flattened());
    for (rows, windows) in
        [(&rows[1..], windows), (rows, &windows[12..]), (&rows[..600], windows), (rows, &windows[..0])]
    {
        assert!(matches!(Painter::new(context.clone(), rows, windows), Err(GpuError::Malformed(_))));
    }
    let mut painter = painter(&context, &table);
    let mut lines = vec![0; table.windows.len()];
    assert!(painter.set_lines(&lines[1..], 1).is_err() && painter.set_lines(&lines, 0).is_err());
    lines[5] = 7;
    assert!(painter.set_lines(&lines, 7).is_err() && painter.set_lines(&lines, 9).is_err());
    let query = table.query(&test_data::foreign_windows()[0]).unwrap();
    let (rows, windows) = query_words(&[query]);
    let draw = |painter: &mut Painter, rows: &[f32], windows: &[u32]| pollster::block_on(painter.draw(rows, windows));
    assert!(draw(&mut painter, &rows.as_flattened()[60..], windows.as_flattened()).is_err());
    assert!(draw(&mut painter, rows.as_flattened(), &windows.as_flattened()[1..]).is_err());
    // No window is on a line.
    assert_eq!(draw(&mut painter, rows.as_flattened(), windows.as_flattened()).unwrap(), [EMPTY]);
}
