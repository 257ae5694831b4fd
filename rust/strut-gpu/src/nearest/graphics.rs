//! The kernels on a GPU: buffers, dispatches, readback.

use crate::context::{Adapter, Context};
use crate::error::GpuError;
use crate::kernels::{distances, select};
use crate::windows::{Batch, query_words, words};
use strut_core::search::{PACKED_TILE as TILE, PackedQuery, PackedRow, PackedWindow, PackedWindows, WINDOW};

/// Greatest number of queries of a slice, which is one submission: a whole number of tiles. A longer submission would
/// block drawing.
const SLICE: usize = 256;

/// The compiled kernels.
#[derive(Clone, Debug)]
pub(super) struct Kernels {
    pub(super) context: Context,
    distances: wgpu::ComputePipeline,
    select: wgpu::ComputePipeline,
}

impl Kernels {
    pub(super) fn new(context: Context) -> Result<Self, GpuError> {
        let [distances, select] = [distances::SHADER, select::SHADER].map(|shader| context.kernel(shader));
        context.check()?;
        Ok(Self { context, distances, select })
    }
}

/// A table on a GPU.
#[derive(Debug)]
pub(super) struct Graphics {
    pub(super) kernels: Kernels,
    rows: wgpu::Buffer,
    windows: wgpu::Buffer,
    /// Buffers of the present slice, kept for slices of the same size.
    slice: Option<Slice>,
}

/// Buffers of a slice of queries.
#[derive(Debug)]
struct Slice {
    queries: usize,
    rows: wgpu::Buffer,
    windows: wgpu::Buffer,
    margins: wgpu::Buffer,
    classes: wgpu::Buffer,
    #[cfg(test)]
    distances: wgpu::Buffer,
    found: wgpu::Buffer,
    reading: wgpu::Buffer,
    compare: wgpu::BindGroup,
    choose: wgpu::BindGroup,
}

impl Graphics {
    pub(super) fn new(kernels: Kernels, table: &PackedWindows) -> Result<Self, GpuError> {
        let context = &kernels.context;
        let (windows, limit) = (table.windows.len() as u64, context.workgroup_limit() * TILE as u64);
        if windows > limit {
            return Err(GpuError::TooMany { windows, limit });
        }
        let rows = context.storage(bytemuck::cast_slice(&table.rows))?;
        let windows = context.storage(bytemuck::cast_slice(&words(table.windows.iter().copied())))?;
        context.check()?;
        Ok(Self { kernels, rows, windows, slice: None })
    }

    pub(super) fn adapter(&self) -> &Adapter {
        self.kernels.context.adapter()
    }

    /// Returns the candidates of every class for every query, [`select::WORDS`] each.
    pub(super) async fn select(
        &mut self,
        table: &PackedWindows,
        batch: &Batch,
        k: usize,
    ) -> Result<Vec<u32>, GpuError> {
        let classes = table.classes.len();
        // Without windows there is nothing to bind.
        if table.windows.is_empty() {
            return Ok(vec![0; batch.queries.len() * classes * select::WORDS]);
        }
        let most = self.slice_of(table);
        let mut found = Vec::with_capacity(batch.queries.len() * classes * select::WORDS);
        for first in (0..batch.queries.len()).step_by(most) {
            let queries = first..batch.queries.len().min(first + most);
            let margins = &batch.margins[classes * queries.start..classes * queries.end];
            found.extend(self.select_slice(table, &batch.queries[queries], margins, k).await?);
        }
        Ok(found)
    }

    /// Returns the number of queries whose distances fit in a binding, in whole tiles.
    fn slice_of(&self, table: &PackedWindows) -> usize {
        let of_a_query = 4 * table.windows.len() as u64;
        let most = (self.kernels.context.binding_limit() / of_a_query) as usize;
        (most.min(SLICE) / TILE * TILE).max(TILE)
    }

    async fn select_slice(
        &mut self,
        table: &PackedWindows,
        queries: &[PackedQuery],
        margins: &[f32],
        k: usize,
    ) -> Result<Vec<u32>, GpuError> {
        let padded = queries.len().next_multiple_of(TILE);
        let slice = match self.slice.take().filter(|slice| slice.queries >= padded) {
            Some(slice) => slice,
            None => self.make_slice(table, padded)?,
        };
        let slice = self.slice.insert(slice);
        let context = &self.kernels.context;
        let (rows, windows) = query_words(queries);
        context.write(&slice.rows, bytemuck::cast_slice(&rows));
        context.write(&slice.windows, bytemuck::cast_slice(&windows));
        context.write(&slice.margins, bytemuck::cast_slice(margins));
        let classes: Vec<[u32; 4]> = table.classes.iter().map(|class| select::words(class, k)).collect();
        context.write(&slice.classes, bytemuck::cast_slice(&classes));
        let tiles = [table.windows.len() / TILE, padded / TILE].map(|n| n as u32);
        let groups = [classes.len(), queries.len()].map(|n| n as u32);
        let passes = [(&self.kernels.distances, &slice.compare, tiles), (&self.kernels.select, &slice.choose, groups)];
        let found = classes.len() * queries.len() * select::WORDS;
        context.run(&passes, [&slice.found, &slice.reading], found).await
    }

    /// Returns every distance, a row of all windows per query, of the last batch, which must fit in one slice.
    #[cfg(test)]
    pub(super) fn distances(&mut self, table: &PackedWindows, batch: &Batch) -> Result<Vec<f32>, GpuError> {
        pollster::block_on(self.select(table, batch, 1))?;
        let words = batch.queries.len() * table.windows.len();
        let reading = self
            .kernels
            .context
            .buffer(4 * words as u64, wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST)?;
        let distances = self.slice.as_ref().map(|slice| &slice.distances);
        let found = distances.map_or(Ok(Vec::new()), |distances| {
            pollster::block_on(self.kernels.context.run(&[], [distances, &reading], words))
        })?;
        Ok(found.into_iter().map(f32::from_bits).collect())
    }

    /// Creates buffers for a number of queries. The padding of the last tile keeps old contents; its distances are
    /// never read.
    fn make_slice(&self, table: &PackedWindows, queries: usize) -> Result<Slice, GpuError> {
        use wgpu::BufferUsages as Usage;
        let context = &self.kernels.context;
        let storage = |words: usize| context.buffer(4 * words as u64, Usage::STORAGE | Usage::COPY_DST);
        let classes = table.classes.len();
        let rows = storage(queries * WINDOW * size_of::<PackedRow>() / 4)?;
        // Padding refers to existing rows.
        let windows = context.storage(bytemuck::cast_slice(&words(vec![PackedWindow::PADDING; queries])))?;
        let (margins, class_table) = (storage(queries * classes)?, storage(classes * 4)?);
        let distance_bytes = 4 * (queries * table.windows.len()) as u64;
        let distances = context.buffer(distance_bytes, Usage::STORAGE | Usage::COPY_SRC)?;
        let found_bytes = 4 * (queries * classes * select::WORDS) as u64;
        let found = context.buffer(found_bytes, Usage::STORAGE | Usage::COPY_SRC)?;
        let reading = context.buffer(found_bytes, Usage::MAP_READ | Usage::COPY_DST)?;
        let stride = context.buffer(16, Usage::UNIFORM | Usage::COPY_DST)?;
        context.write(&stride, bytemuck::cast_slice(&[table.windows.len() as u32, 0, 0, 0]));
        let compare = context.bind(&self.kernels.distances, &[&self.rows, &self.windows, &rows, &windows, &distances]);
        let choose = context.bind(&self.kernels.select, &[&distances, &class_table, &margins, &found, &stride]);
        Ok(Slice {
            queries,
            rows,
            windows,
            margins,
            classes: class_table,
            #[cfg(test)]
            distances,
            found,
            reading,
            compare,
            choose,
        })
    }
}
