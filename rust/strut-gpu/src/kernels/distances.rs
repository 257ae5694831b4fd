//! Every D between the queries of a batch and the windows of a table; twin of `distances.wgsl`.

use crate::windows::{Batch, JOINTS, ROW, Row, Table, Window};
use strut_core::search::WINDOW;

pub(crate) const SHADER: &str = include_str!("distances.wgsl");

/// D, m², between a query and every window of a table, padding included. As in the shader, a root of 0 becomes 10⁻¹⁵.
pub(crate) fn distances(table: &Table, batch: &Batch, query: usize) -> Vec<f32> {
    let window = &batch.windows[query];
    let rows = rows_of(&batch.rows, window);
    table.windows.iter().map(|other| distance(window, rows, other, rows_of(&table.rows, other))).collect()
}

fn rows_of<'a>(rows: &'a [Row], window: &Window) -> &'a [Row] {
    let end = window.end as usize;
    rows.get(end + 1 - WINDOW..=end).unwrap_or_default()
}

fn distance(a: &Window, a_rows: &[Row], b: &Window, b_rows: &[Row]) -> f32 {
    let (ax, az) = a.travel.split_at(WINDOW - 1);
    let (bx, bz) = b.travel.split_at(WINDOW - 1);
    let mut h = 0.0;
    let mut re = dot(ax, bx) + dot(az, bz);
    let mut im = dot(ax, bz) - dot(az, bx);
    for (a, b) in a_rows.iter().zip(b_rows) {
        let [(ay, ax, az), (by, bx, bz)] = [a, b].map(parts);
        h += dot(ay, by);
        re += dot(ax, bx) + dot(az, bz);
        im += dot(ax, bz) - dot(az, bx);
    }
    let turned = (re * re + im * im).max(1e-30).sqrt();
    (a.norm + b.norm - 2.0 * (h + turned)).max(0.0).abs()
}

/// Heights, x and z.
fn parts(row: &Row) -> (&[f32], &[f32], &[f32]) {
    (&row[..JOINTS], &row[JOINTS..2 * JOINTS], &row[2 * JOINTS..ROW])
}

/// In four sums, as the shader's vectors.
fn dot(a: &[f32], b: &[f32]) -> f32 {
    let mut sums = [0.0; 4];
    for (a, b) in a.chunks_exact(4).zip(b.chunks_exact(4)) {
        for ((sum, a), b) in sums.iter_mut().zip(a).zip(b) {
            *sum += a * b;
        }
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3])
}
