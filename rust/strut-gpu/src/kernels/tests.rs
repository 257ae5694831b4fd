//! The CPU twins, compared with their definitions.

use super::{distances, select};
use crate::rounding;
use crate::test_data;
use crate::windows::{Batch, table};
use proptest::prelude::*;
use strut_core::search::{
    Index, Metric, PACKED_JOINTS as JOINTS, PackedClass as Class, PackedRow as Row, PackedWindows, QueryWindow,
    RawPoints, WINDOW,
};

/// D of two windows in double precision, directly from the positions: both centred, Σ|y − y'|² + |z|² + |z'|² − 2|⟨z,
/// z'⟩|.
fn definition(a: &[RawPoints], b: &[RawPoints]) -> f64 {
    let weights = Index::joint_weights();
    let centred = |frames: &[RawPoints]| -> Vec<(f64, [f64; 3])> {
        let all: Vec<(f64, [f64; 3])> =
            frames.iter().flat_map(|frame| weights.iter().zip(frame).map(|(w, p)| (w / WINDOW as f64, *p))).collect();
        let total: f64 = all.iter().map(|(w, _)| w).sum();
        let [x, z] = [1, 2].map(|axis| all.iter().map(|(w, p)| w * p[axis]).sum::<f64>() / total);
        all.iter().map(|(w, p)| (*w, [p[0], p[1] - x, p[2] - z])).collect()
    };
    let (mut sum, mut re, mut im) = (0.0, 0.0, 0.0);
    for ((w, a), (_, b)) in centred(a).iter().zip(&centred(b)) {
        sum += w * ((a[0] - b[0]) * (a[0] - b[0]) + a[1] * a[1] + a[2] * a[2] + b[1] * b[1] + b[2] * b[2]);
        re += w * (a[1] * b[1] + a[2] * b[2]);
        im += w * (a[1] * b[2] - a[2] * b[1]);
    }
    (sum - 2.0 * (re * re + im * im).sqrt()).max(0.0)
}

/// Returns the greatest error of the twin's distances from a batch of windows to an index's, relative to its bound.
fn greatest_error(index: &Index, table: &PackedWindows, windows: &[QueryWindow], batch: &Batch) -> f64 {
    let mut greatest: f64 = 0.0;
    for (q, window) in windows.iter().enumerate() {
        let positions: Vec<RawPoints> = window.positions().collect();
        let found = distances::distances(table, &batch.queries[q]);
        for class in &table.classes {
            let bound = f64::from(rounding::bound(batch.queries[q].window.norm, class.greatest));
            for (w, d) in class.windows().zip(&found[class.windows()]) {
                let end = table.windows[w].end as usize;
                let stored: Vec<RawPoints> = (end + 1 - WINDOW..=end).map(|row| index.positions(row)).collect();
                greatest = greatest.max((f64::from(*d) - definition(&positions, &stored)).abs() / bound);
            }
        }
    }
    greatest
}

/// Reverses the centring of rows.
fn without_centring<'a>(rows: impl Iterator<Item = &'a mut Row>, positions: impl Iterator<Item = RawPoints>) {
    let weights = Index::joint_weights();
    for (row, positions) in rows.zip(positions) {
        for axis in [1, 2] {
            let mean: f64 = weights.iter().zip(&positions).map(|(w, p)| w * p[axis]).sum();
            for (v, w) in row[axis * JOINTS..][..JOINTS].iter_mut().zip(weights) {
                *v += ((w / WINDOW as f64).sqrt() * mean) as f32;
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]
    #[test]
    fn distances_are_those_of_the_definition(db in test_data::random_database(), windows in test_data::random_windows()) {
        let index = Index::build(&db);
        let mut table = table(&index).unwrap();
        let queries: Vec<_> = windows.iter().map(|window| (window, index.prepare(window, Metric::FullBody))).collect();
        let mut batch = Batch::new(&table, &index, &queries).unwrap();
        let error = greatest_error(&index, &table, &windows, &batch);
        prop_assert!(error <= 1.0, "{} times the bound", error);

        without_centring(table.rows.iter_mut(), (0..index.rows()).map(|row| index.positions(row)));
        without_centring(batch.queries.iter_mut().flat_map(|query| &mut query.rows), windows.iter().flat_map(QueryWindow::positions));
        prop_assert!(greatest_error(&index, &table, &windows, &batch) > 1.0);
    }

    #[test]
    fn the_nearest_and_those_within_the_margin_are_selected(
        mut all in prop::collection::vec((0u16..300).prop_map(|d| f32::from(d) / 256.0), 0..300), k in 0usize..50,
        margin in 0.0f32..0.2,
    ) {
        let mut table = table(test_data::index()).unwrap();
        let count = all.len();
        table.classes = vec![Class { first: 0, count, greatest: 1.0 }];
        let found = select::select(&table, &all, &[margin], k);
        let selected = select::windows(&found).map(<[u32]>::to_vec);
        let distance_of = all.clone();
        all.sort_by(f32::total_cmp);
        let limit = all.get(k.min(count).wrapping_sub(1)).map_or(-1.0, |kth| kth + margin);
        let expected: Vec<u32> =
            (0..count as u32).filter(|&w| distance_of[w as usize] <= limit).collect();
        prop_assert_eq!(found.len(), select::WORDS);
        prop_assert_eq!(selected, (expected.len() <= select::PLACES).then_some(expected));
    }
}
