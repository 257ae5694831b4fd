//! Exhaustive distance computation on the GPU. Its package is loaded only where there is a GPU.
//!
//! There is no database: all arrays are plain numbers from the engine's own package. Only the benchmark's build has a
//! database, to compare searches.

#[cfg(feature = "gpu-bench")]
mod yardstick;

use crate::common::EngineError;
use strut_gpu::{Context, GpuError};
use wasm_bindgen::prelude::wasm_bindgen;
#[cfg(feature = "gpu-bench")]
pub use yardstick::Yardstick;

/// Draws atlas pictures of a database on the fastest GPU.
#[wasm_bindgen]
pub struct Painter {
    painter: strut_gpu::Painter,
}

#[wasm_bindgen]
impl Painter {
    /// Opens the GPU for a database's rows and windows, 60 numbers and 12 words each.
    ///
    /// # Errors
    /// If there is no GPU, the data do not fit on it, or rows and windows do not match.
    pub async fn open(rows: Vec<f32>, windows: Vec<u32>) -> Result<Self, EngineError> {
        let context = Context::open().await.map_err(graphics)?;
        Ok(Self { painter: strut_gpu::Painter::new(context, &rows, &windows).map_err(graphics)? })
    }

    /// Returns the name of the GPU; empty if the browser does not report it.
    pub fn adapter(&self) -> String {
        self.painter.adapter().name.clone()
    }

    /// Sets the line of each window, below `height`, or the largest number for none.
    ///
    /// # Errors
    /// If the lines are invalid, or the GPU has stopped.
    #[wasm_bindgen(js_name = setLines)]
    pub fn set_lines(&mut self, lines: &[u32], height: usize) -> Result<(), EngineError> {
        self.painter.set_lines(lines, height).map_err(graphics)
    }

    /// Returns the bits of the least D of each line, column by column, for the rows and windows of queries: 300 numbers
    /// and 12 words each.
    ///
    /// # Errors
    /// If rows and windows do not match, or the GPU has stopped.
    pub async fn draw(&mut self, rows: Vec<f32>, windows: Vec<u32>) -> Result<Vec<u32>, EngineError> {
        self.painter.draw(&rows, &windows).await.map_err(graphics)
    }
}

fn graphics(error: GpuError) -> EngineError {
    match error {
        GpuError::Malformed(_) | GpuError::TooLarge { .. } | GpuError::TooMany { .. } => EngineError::bad_input(error),
        _ => EngineError::without_graphics(error),
    }
}
