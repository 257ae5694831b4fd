//! Handle of the paper's exhaustive search, for comparison with the engine's.

use crate::common::{EngineError, poses_of};
use crate::gpu::graphics;
use std::rc::Rc;
use strut_core::humanoid::Proportions;
use strut_core::pose_vector::HeadingFilter;
use strut_core::search::{Index, Neighbours, QueryWindow};
use strut_evaluation::search::ClassSearch;
use strut_formats::strutdb;
use strut_gpu::{Context, Searcher};
use wasm_bindgen::prelude::wasm_bindgen;

/// Number of neighbours per class.
const K: usize = 40;
/// Distance between searched frames, as in `strut bench`.
const STRIDE: usize = 5;

/// Searches all classes of a database for the neighbours of the same windows, on the GPU and with the engine.
#[wasm_bindgen]
pub struct Yardstick {
    searcher: Searcher<Rc<Index>>,
    engine: ClassSearch,
    proportions: Proportions,
    rate_hz: f32,
    windows: Vec<QueryWindow>,
    /// The GPU's last result for each window.
    found: Vec<Vec<Neighbours>>,
    /// Number of windows that were compared again exactly, and number of neighbours, over all searches so far.
    candidates: usize,
    neighbours: usize,
}

#[wasm_bindgen]
impl Yardstick {
    /// Opens the database of a `.strutdb` file on the fastest GPU.
    ///
    /// # Errors
    /// If there is no GPU, the database does not fit on it, or the bytes are invalid.
    pub async fn open(bytes: Vec<u8>) -> Result<Self, EngineError> {
        let database = strutdb::read(&bytes).map_err(|e| EngineError::bad_file(e, ""))?.database;
        let context = Context::open().await.map_err(graphics)?;
        let searcher = Searcher::new(Rc::new(Index::build(&database)), context).map_err(graphics)?;
        Ok(Self {
            searcher,
            engine: ClassSearch::default(),
            proportions: database.proportions,
            rate_hz: database.rate_hz,
            windows: Vec::new(),
            found: Vec::new(),
            candidates: 0,
            neighbours: 0,
        })
    }

    /// Adds windows of a motion at the database's rate, at a fixed stride.
    ///
    /// # Errors
    /// If the array is not a whole number of poses.
    pub fn add(&mut self, poses: &[f32]) -> Result<(), EngineError> {
        let (mut window, mut filter) = (QueryWindow::default(), HeadingFilter::default());
        for (frame, pose) in poses_of(poses)?.enumerate() {
            window.follow(&pose, &self.proportions, self.rate_hz, &mut filter);
            if frame > 0 && frame.is_multiple_of(STRIDE) {
                self.windows.push(window.clone());
            }
        }
        self.found.resize_with(self.windows.len(), Vec::new);
        Ok(())
    }

    /// Returns the number of added windows.
    pub fn windows(&self) -> usize {
        self.windows.len()
    }

    /// Returns the number of searched classes.
    pub fn classes(&self) -> usize {
        self.searcher.index().classes()
    }

    /// Searches for some windows together on the GPU, including upload, readback and exact re-ranking.
    ///
    /// # Errors
    /// If there are no such windows, or the GPU has stopped.
    pub async fn search(&mut self, first: usize, count: usize) -> Result<(), EngineError> {
        let no_such = || EngineError::bad_input("there are no such windows");
        let windows = first.checked_add(count).and_then(|end| self.windows.get(first..end)).ok_or_else(no_such)?;
        let found = self.searcher.search(windows, K).await.map_err(graphics)?;
        self.candidates += found.candidates;
        self.neighbours += found.neighbours.iter().flatten().map(|set| set.as_slice().len()).sum::<usize>();
        for (place, neighbours) in self.found[first..].iter_mut().zip(found.neighbours) {
            *place = neighbours;
        }
        Ok(())
    }

    /// Searches for a window with the engine, from a cold start.
    ///
    /// # Errors
    /// If there is no such window.
    #[wasm_bindgen(js_name = searchByEngine)]
    pub fn search_by_engine(&mut self, window: usize) -> Result<(), EngineError> {
        self.expected(window).map(|_| ())
    }

    /// Returns the number of classes of a window in which the engine and the GPU found bit-identical neighbours.
    ///
    /// # Errors
    /// If there is no such window.
    pub fn identical(&mut self, window: usize) -> Result<usize, EngineError> {
        let found = self.found.get(window).cloned().unwrap_or_default();
        let expected = self.expected(window)?;
        Ok(expected.iter().zip(&found).filter(|(a, b)| a.as_slice() == b.as_slice()).count())
    }

    /// Returns the number of windows that were compared again exactly per neighbour, over all searches so far.
    #[wasm_bindgen(js_name = candidatesPerNeighbour)]
    pub fn candidates_per_neighbour(&self) -> f64 {
        self.candidates as f64 / self.neighbours.max(1) as f64
    }
}

impl Yardstick {
    /// Finds the nearest windows of every class with the engine, from a cold start.
    fn expected(&mut self, window: usize) -> Result<&[Neighbours], EngineError> {
        let queried = self.windows.get(window).ok_or_else(|| EngineError::bad_input("there is no such window"))?;
        self.engine.forget();
        Ok(self.engine.find(self.searcher.index(), queried, K))
    }
}
