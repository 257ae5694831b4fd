//! Every distance at once for JavaScript; no algorithm. A package of its own: visitors load it who have a graphics processor.
//!
//! Objects, arrays, errors and panics are as in [`strut_wasm_common`]. There is no database: all arrays are what the engine's
//! own package gives, as plain numbers. Only the benchmark's build has one, to compare searches.

#[cfg(feature = "bench")]
mod yardstick;

use strut_gpu::{Context, GpuError};
pub use strut_wasm_common::EngineError;
use wasm_bindgen::prelude::wasm_bindgen;
#[cfg(feature = "bench")]
pub use yardstick::Yardstick;

/// Draws pictures of a database by the fastest graphics processor.
#[wasm_bindgen]
pub struct Painter {
    painter: strut_gpu::Painter,
}

#[wasm_bindgen]
impl Painter {
    /// Of a database's rows and windows, 60 numbers and 12 words each.
    ///
    /// # Errors
    /// If there is no graphics processor, or they do not fit it or each other.
    pub async fn open(rows: Vec<f32>, windows: Vec<u32>) -> Result<Self, EngineError> {
        let context = Context::open().await.map_err(graphics)?;
        Ok(Self { painter: strut_gpu::Painter::new(context, &rows, &windows).map_err(graphics)? })
    }

    /// Name of the graphics processor; empty where the browser does not tell.
    pub fn adapter(&self) -> String {
        self.painter.adapter().name.clone()
    }

    /// Takes the line of each window, below `height`, or the largest number for none.
    ///
    /// # Errors
    /// If they are none, or the graphics processor has stopped.
    #[wasm_bindgen(js_name = setLines)]
    pub fn set_lines(&mut self, lines: &[u32], height: usize) -> Result<(), EngineError> {
        self.painter.set_lines(lines, height).map_err(graphics)
    }

    /// Bits of the least D of each line, a column after the other: of queries' rows and windows, 300 numbers and 12 words each.
    ///
    /// # Errors
    /// If they do not fit each other, or the graphics processor has stopped.
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
