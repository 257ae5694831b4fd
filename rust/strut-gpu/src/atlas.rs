//! Pictures of all distances between some windows and those of a database.
//!
//! All arrays are plain numbers from [`strut_core::search::Atlas`], so that drawing does not need the database.

use crate::context::{Adapter, Context};
use crate::error::GpuError;
use crate::kernels::atlas::{EMPTY, SHADER};
use std::ops::Range;
use strut_core::search::{PACKED_ROW, PACKED_TILE, PACKED_WINDOW, TRAVEL, WINDOW};

/// Number of words of a query's rows.
const QUERY_ROWS: usize = WINDOW * PACKED_ROW;
/// Index of the word with a window's last row.
const END: usize = TRAVEL + 1;
/// Line of windows that are on no line.
const NO_LINE: u32 = u32::MAX;

/// Draws pictures of a database on a GPU.
#[derive(Debug)]
pub struct Painter {
    context: Context,
    kernel: wgpu::ComputePipeline,
    rows: wgpu::Buffer,
    windows: wgpu::Buffer,
    lines: wgpu::Buffer,
    /// Number of windows, padding included.
    count: usize,
    /// Tiles of windows that are on lines.
    tiles: Range<usize>,
    height: usize,
    /// Buffers for the present columns, kept for the same number of columns.
    slice: Option<Slice>,
}

/// Buffers of a number of columns.
#[derive(Debug)]
struct Slice {
    columns: usize,
    rows: wgpu::Buffer,
    windows: wgpu::Buffer,
    view: wgpu::Buffer,
    picture: wgpu::Buffer,
    reading: wgpu::Buffer,
    bindings: wgpu::BindGroup,
}

impl Painter {
    /// Creates a painter for a database's rows ([`PACKED_ROW`] numbers each) and windows ([`PACKED_WINDOW`] words each,
    /// in whole tiles).
    ///
    /// # Errors
    /// If the arrays do not have this form, or do not fit on the GPU.
    pub fn new(context: Context, rows: &[f32], windows: &[u32]) -> Result<Self, GpuError> {
        let count = windows.len() / PACKED_WINDOW;
        let frames = rows.len() / PACKED_ROW;
        let has_row = |window: &[u32]| (WINDOW - 1..frames).contains(&(window[END] as usize));
        let fits = rows.len().is_multiple_of(PACKED_ROW) && windows.len().is_multiple_of(PACKED_TILE * PACKED_WINDOW);
        if !fits || count == 0 || !windows.chunks_exact(PACKED_WINDOW).all(has_row) {
            return Err(GpuError::Malformed("windows and their rows"));
        }
        let (tiles, limit) = ((count / PACKED_TILE) as u64, context.workgroup_limit());
        if tiles > limit {
            let tile = PACKED_TILE as u64;
            return Err(GpuError::TooMany { windows: tile * tiles, limit: tile * limit });
        }
        let kernel = context.kernel(SHADER);
        let rows = context.storage(bytemuck::cast_slice(rows))?;
        let windows = context.storage(bytemuck::cast_slice(windows))?;
        let lines = context.storage(bytemuck::cast_slice(&vec![NO_LINE; count]))?;
        context.check()?;
        Ok(Self { context, kernel, rows, windows, lines, count, tiles: 0..0, height: 1, slice: None })
    }

    /// Returns the GPU.
    pub fn adapter(&self) -> &Adapter {
        self.context.adapter()
    }

    /// Simulates device loss.
    pub fn destroy(&self) {
        self.context.destroy();
    }

    /// Sets the line of each window, below `height` and ascending by ones, or the largest number for none.
    ///
    /// # Errors
    /// If the lines do not have this form, or the GPU fails.
    pub fn set_lines(&mut self, lines: &[u32], height: usize) -> Result<(), GpuError> {
        let tiles: Vec<&[u32]> = lines.chunks_exact(PACKED_TILE).collect();
        let on_lines = |tile: &[u32]| tile.iter().copied().filter(|line| *line != NO_LINE).collect::<Vec<_>>();
        let fits = |tile: &&[u32]| {
            let lines = on_lines(tile);
            lines.iter().all(|line| (*line as usize) < height)
                && lines.windows(2).all(|of| of[1].wrapping_sub(of[0]) < 2)
        };
        if lines.len() != self.count || height == 0 || !tiles.iter().all(fits) {
            return Err(GpuError::Malformed("lines"));
        }
        let has = |tile: &&[u32]| !on_lines(tile).is_empty();
        let first = tiles.iter().position(has).unwrap_or(0);
        self.tiles = first..tiles.iter().rposition(has).map_or(first, |last| last + 1);
        self.context.write(&self.lines, bytemuck::cast_slice(lines));
        self.height = height;
        self.slice = None;
        self.context.check()
    }

    /// Returns the bits of the least D of each line, column by column, for the rows ([`WINDOW`] times [`PACKED_ROW`]
    /// numbers each) and windows ([`PACKED_WINDOW`] words each) of queries. They are one submission.
    ///
    /// # Errors
    /// If the arrays do not have this form, or the GPU fails. After [`GpuError::Lost`] it always fails.
    pub async fn draw(&mut self, rows: &[f32], windows: &[u32]) -> Result<Vec<u32>, GpuError> {
        let columns = windows.len() / PACKED_WINDOW;
        if rows.len() != columns * QUERY_ROWS || !windows.len().is_multiple_of(PACKED_WINDOW) {
            return Err(GpuError::Malformed("queries and their rows"));
        }
        if self.tiles.is_empty() || columns == 0 {
            return Ok(vec![EMPTY; columns * self.height]);
        }
        let padded = columns.next_multiple_of(PACKED_TILE);
        let slice = match self.slice.take().filter(|slice| slice.columns >= padded) {
            Some(slice) => slice,
            None => self.make_slice(padded)?,
        };
        let context = &self.context;
        context.write(&slice.rows, bytemuck::cast_slice(rows));
        let mut windows = windows.to_vec();
        for (column, window) in windows.chunks_exact_mut(PACKED_WINDOW).enumerate() {
            window[END] = (column * WINDOW + WINDOW - 1) as u32;
        }
        context.write(&slice.windows, bytemuck::cast_slice(&windows));
        context.write(&slice.picture, bytemuck::cast_slice(&vec![EMPTY; padded * self.height]));
        let view = [self.tiles.start as u32, self.height as u32, 0, 0];
        context.write(&slice.view, bytemuck::cast_slice(&view));
        let groups = [self.tiles.len() as u32, (padded / PACKED_TILE) as u32];
        let passes = [(&self.kernel, &slice.bindings, groups)];
        let found = context.run(&passes, [&slice.picture, &slice.reading], columns * self.height).await?;
        self.slice = Some(slice);
        Ok(found)
    }

    /// Creates buffers for a number of columns. The padding of the last tile keeps old contents; its pixels are never
    /// read.
    fn make_slice(&self, columns: usize) -> Result<Slice, GpuError> {
        use wgpu::BufferUsages as Usage;
        let context = &self.context;
        let rows = context.buffer(4 * (columns * QUERY_ROWS) as u64, Usage::STORAGE | Usage::COPY_DST)?;
        // Padding refers to existing rows.
        let padding = strut_core::search::PackedWindow::PADDING.words();
        let windows = context.storage(bytemuck::cast_slice(&vec![padding; columns]))?;
        let view = context.buffer(16, Usage::UNIFORM | Usage::COPY_DST)?;
        let bytes = 4 * (columns * self.height) as u64;
        let picture = context.buffer(bytes, Usage::STORAGE | Usage::COPY_SRC | Usage::COPY_DST)?;
        let reading = context.buffer(bytes, Usage::MAP_READ | Usage::COPY_DST)?;
        let buffers = [&self.rows, &self.windows, &rows, &windows, &self.lines, &picture, &view];
        let bindings = context.bind(&self.kernel, &buffers);
        Ok(Slice { columns, rows, windows, view, picture, reading, bindings })
    }
}

#[cfg(test)]
mod tests;
