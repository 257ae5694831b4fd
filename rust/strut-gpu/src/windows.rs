//! Windows as a graphics processor reads them, and how far its distances may be off.

use crate::error::GpuError;
use crate::rounding;
use strut_core::search::{BodyPart, Index, PackedQuery, PackedWindow, PackedWindows, Query, QueryWindow, WINDOW};

/// Words of [`PackedWindow::words`], window by window.
pub(crate) type Words = [u32; strut_core::search::PACKED_WINDOW];

/// All windows of an index.
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

/// Windows to be compared with a table's.
#[derive(Clone, Debug)]
pub(crate) struct Batch {
    pub(crate) queries: Vec<PackedQuery>,
    /// How much farther than the k-th nearest a candidate may seem: for each query, of every class, m².
    pub(crate) margins: Vec<f32>,
}

impl Batch {
    /// Windows of `index` to be compared with all of its `table`.
    ///
    /// # Errors
    /// If one has another length than [`WINDOW`], which an empty one has.
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

/// Windows as the shaders read them.
pub(crate) fn words(windows: impl IntoIterator<Item = PackedWindow>) -> Vec<Words> {
    windows.into_iter().map(|window| window.words()).collect()
}

/// Queries as the shaders read them: their rows one after the other, and their windows, whose last rows are among these.
pub(crate) fn query_words(queries: &[PackedQuery]) -> (Vec<strut_core::search::PackedRow>, Vec<Words>) {
    let rows = queries.iter().flat_map(|query| query.rows).collect();
    let end = |q: usize| (q * WINDOW + WINDOW - 1) as u32;
    (rows, words(queries.iter().enumerate().map(|(q, query)| PackedWindow { end: end(q), ..query.window })))
}
