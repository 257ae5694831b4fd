//! Exhaustive search: distances, selection, exact re-ranking.

mod graphics;
#[cfg(test)]
mod tests;

use crate::context::{Adapter, Context};
use crate::error::GpuError;
use crate::kernels::{distances, select};
use crate::windows::{Batch, table};
use graphics::{Graphics, Kernels};
use std::ops::Deref;
use strut_core::search::{Index, Metric, Neighbour, Neighbours, PackedWindows, Query, QueryWindow};

/// Greatest margin, m², for which a GPU's candidates are used. Human motion never reaches it; larger numbers approach
/// the limit of the number format.
const GREATEST_MARGIN: f32 = 1e6;

/// The exhaustive search of an index, which is borrowed or shared. Results are bit-identical to [`Index::nearest`].
#[derive(Debug)]
pub struct Searcher<I> {
    index: I,
    table: PackedWindows,
    /// `None` uses the CPU twins of the kernels.
    graphics: Option<Graphics>,
}

/// Results for several windows.
#[derive(Clone, Debug, Default)]
pub struct Found {
    /// For each window, for every class: the nearest windows by the full-body metric.
    pub neighbours: Vec<Vec<Neighbours>>,
    /// Number of windows that were compared again exactly.
    pub candidates: usize,
    /// Number of classes that the index searched instead, because there were more candidates than places, or numbers
    /// were too large.
    pub searched_by_index: usize,
}

impl<I: Deref<Target = Index>> Searcher<I> {
    /// Creates a searcher on a GPU.
    ///
    /// # Errors
    /// If windows are not [`WINDOW`](strut_core::search::WINDOW) frames long, or do not fit on the GPU.
    pub fn new(index: I, context: Context) -> Result<Self, GpuError> {
        let table = table(&index)?;
        let graphics = Some(Graphics::new(Kernels::new(context)?, &table)?);
        Ok(Self { index, table, graphics })
    }

    /// Creates a searcher with the kernels' twins, on the CPU.
    ///
    /// # Errors
    /// If windows are not [`WINDOW`](strut_core::search::WINDOW) frames long.
    pub fn without_graphics(index: I) -> Result<Self, GpuError> {
        Ok(Self { table: table(&index)?, index, graphics: None })
    }

    /// Returns the GPU.
    pub fn adapter(&self) -> Option<&Adapter> {
        self.graphics.as_ref().map(Graphics::adapter)
    }

    /// Returns the index.
    pub fn index(&self) -> &Index {
        &self.index
    }

    /// Runs [`Searcher::search`], and waits for it.
    ///
    /// # Errors
    /// Those of [`Searcher::search`].
    #[cfg(not(target_family = "wasm"))]
    pub fn nearest(&mut self, windows: &[QueryWindow], k: usize) -> Result<Found, GpuError> {
        pollster::block_on(self.search(windows, k))
    }

    /// Returns the `k` windows of every class that are nearest to each of several windows, none of which is empty.
    ///
    /// # Errors
    /// If a window is empty or has another length than the index's, or the GPU fails. After [`GpuError::Lost`] it
    /// always fails.
    pub async fn search(&mut self, windows: &[QueryWindow], k: usize) -> Result<Found, GpuError> {
        let queries: Vec<Prepared<'_>> =
            windows.iter().map(|window| (window, self.index.prepare(window, Metric::FullBody))).collect();
        let batch = Batch::new(&self.table, &self.index, &queries)?;
        let selected = self.select(&batch, k).await?;
        Ok(self.rank(&queries, &batch.margins, &selected, k))
    }

    /// Returns the candidates of every class for every query, [`select::WORDS`] each.
    async fn select(&mut self, batch: &Batch, k: usize) -> Result<Vec<u32>, GpuError> {
        let Self { table, graphics, .. } = self;
        if let Some(graphics) = graphics {
            return graphics.select(table, batch, k).await;
        }
        let classes = table.classes.len().max(1);
        let queries = batch.queries.iter().zip(batch.margins.chunks_exact(classes));
        let one = |(query, margins)| select::select(table, &distances::distances(table, query), margins, k);
        Ok(queries.flat_map(one).collect())
    }

    /// Returns the nearest candidates by the CPU's D.
    fn rank(&self, queries: &[Prepared<'_>], margins: &[f32], selected: &[u32], k: usize) -> Found {
        let classes = self.table.classes.len();
        let (mut found, mut scratch) = (Found::default(), self.index.scratch(k));
        for (q, (_, query)) in queries.iter().enumerate() {
            let mut of_query = vec![Neighbours::default(); classes];
            for (class, out) in of_query.iter_mut().enumerate() {
                let at = q * classes + class;
                let candidates = select::windows(&selected[at * select::WORDS..][..select::WORDS]);
                let Some(candidates) = candidates.filter(|_| margins[at] <= GREATEST_MARGIN) else {
                    self.index.nearest(query, &[class], k, &mut scratch, out);
                    found.searched_by_index += 1;
                    continue;
                };
                out.begin(k);
                found.candidates += candidates.len();
                for &window in candidates {
                    let row = self.table.windows[window as usize].end;
                    out.offer(Neighbour { distance: self.index.distance_to(query, row as usize), row });
                }
            }
            found.neighbours.push(of_query);
        }
        found
    }
}

/// A window, and the same window prepared for the index.
type Prepared<'a> = (&'a QueryWindow, Query<'a>);
