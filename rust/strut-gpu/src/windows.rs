//! Windows in the format of the shaders, and the margins of their distances.

use crate::error::GpuError;
use crate::rounding;
use strut_core::search::{BodyPart, Index, PackedQuery, PackedWindow, PackedWindows, Query, QueryWindow, WINDOW};

/// Words of a window; see [`PackedWindow::words`].
pub(crate) type Words = [u32; strut_core::search::PACKED_WINDOW];

/// Returns all windows of an index.
///
/// # Errors
/// If they have a length other than [`WINDOW`].
pub(crate) fn table(index: &Index) -> Result<PackedWindows, GpuError> {
    if index.window_length() == WINDOW {
        Ok(PackedWindows::new(index, BodyPart::Whole))
    } else {
        Err(GpuError::WindowLength(index.window_length()))
    }
}

/// Windows that are compared with a table's.
#[derive(Clone, Debug)]
pub(crate) struct Batch {
    pub(crate) queries: Vec<PackedQuery>,
    /// Distance by which a candidate may exceed the k-th nearest: for each query, of every class, m².
    pub(crate) margins: Vec<f32>,
}

impl Batch {
    /// Prepares windows for the comparison with all windows of the `table` of `index`.
    ///
    /// # Errors
    /// If a window has another length than [`WINDOW`], as an empty one has.
    pub(crate) fn new(
        table: &PackedWindows,
        index: &Index,
        queries: &[(&QueryWindow, Query<'_>)],
    ) -> Result<Self, GpuError> {
        let mut batch = Self { queries: Vec::new(), margins: Vec::new() };
        for (window, query) in queries {
            let packed = table.query(window).ok_or_else(|| GpuError::WindowLength(window.positions().count()))?;
            let norm = packed.window.norm;
            let margins = table.classes.iter().enumerate();
            batch
                .margins
                .extend(margins.map(|(c, class)| rounding::margin(norm, class.greatest, index.rounding(query, c))));
            batch.queries.push(packed);
        }
        Ok(batch)
    }
}

/// Returns windows in the format of the shaders.
pub(crate) fn words(windows: impl IntoIterator<Item = PackedWindow>) -> Vec<Words> {
    windows.into_iter().map(|window| window.words()).collect()
}

/// Returns queries in the format of the shaders: all rows, and the windows, whose last rows are indices of these.
pub(crate) fn query_words(queries: &[PackedQuery]) -> (Vec<strut_core::search::PackedRow>, Vec<Words>) {
    let rows = queries.iter().flat_map(|query| query.rows).collect();
    let end = |q: usize| (q * WINDOW + WINDOW - 1) as u32;
    (rows, words(queries.iter().enumerate().map(|(q, query)| PackedWindow { end: end(q), ..query.window })))
}
