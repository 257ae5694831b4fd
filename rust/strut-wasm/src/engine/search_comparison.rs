//! Handle of a comparison of kd-tree search and exact search.

use crate::common::EngineError;
use crate::engine::database::Database;
use crate::engine::input::Input;
use std::num::NonZero;
use std::sync::Arc;
use strut_core::humanoid::Pose;
use strut_core::pose_vector::HeadingFilter;
use strut_core::search::{Index, Neighbours, QueryWindow};
use strut_core::transfer::Model;
use strut_evaluation::search::{ClassSearch, Recall, with_kd_trees};
use wasm_bindgen::prelude::wasm_bindgen;

/// Comparison of the two searches on the windows of an input, in portions: [`Self::take`], both searches, and
/// [`Self::count`]. Each search is a separate call, so that its time can be measured.
#[wasm_bindgen]
pub struct SearchComparison {
    model: Arc<Model>,
    trees: Index,
    neighbours: usize,
    poses: Vec<Pose>,
    done: usize,
    window: QueryWindow,
    filter: HeadingFilter,
    portion: Vec<QueryWindow>,
    /// Results of the exact search.
    nearest: Found,
    /// Results of the kd-trees.
    found: Found,
    recall: Recall,
}

#[derive(Default)]
struct Found {
    search: ClassSearch,
    /// Neighbours of each window of the portion.
    windows: Vec<Vec<Neighbours>>,
}

#[wasm_bindgen]
impl SearchComparison {
    /// Creates a comparison of the nearest `neighbours` of every class, found exactly and among `candidates` of its
    /// kd-tree.
    ///
    /// # Errors
    /// If there are no candidates.
    #[wasm_bindgen(constructor)]
    pub fn new(database: &Database, input: &Input, neighbours: usize, candidates: usize) -> Result<Self, EngineError> {
        let candidates = NonZero::new(candidates)
            .ok_or_else(|| EngineError::bad_input(String::from("at least one candidate was expected")))?;
        let model = Arc::clone(database.model());
        Ok(Self {
            trees: with_kd_trees(model.index().clone(), candidates),
            model,
            neighbours,
            poses: input.humanoid().poses.clone(),
            done: 0,
            window: QueryWindow::default(),
            filter: HeadingFilter::default(),
            portion: Vec::new(),
            nearest: Found::default(),
            found: Found::default(),
            recall: Recall::default(),
        })
    }

    /// Adds the windows of up to `frames` more frames, and returns their number.
    pub fn take(&mut self, frames: usize) -> usize {
        let db = self.model.catalogue();
        self.portion.clear();
        for pose in self.poses.iter().skip(self.done).take(frames) {
            self.window.follow(pose, &db.proportions, db.rate_hz, &mut self.filter);
            self.portion.push(self.window.clone());
        }
        self.done += self.portion.len();
        self.portion.len()
    }

    /// Searches the portion exactly.
    #[wasm_bindgen(js_name = searchExactly)]
    pub fn search_exactly(&mut self) {
        self.nearest.find(self.model.index(), &self.portion, self.neighbours);
    }

    /// Searches the portion with kd-trees.
    #[wasm_bindgen(js_name = searchTrees)]
    pub fn search_trees(&mut self) {
        self.found.find(&self.trees, &self.portion, self.neighbours);
    }

    /// Counts the neighbours of the portion that both searches found.
    pub fn count(&mut self) {
        for (nearest, found) in self.nearest.windows.iter().zip(&self.found.windows) {
            self.recall.add(nearest, found);
        }
    }

    /// Returns the share of the nearest windows that kd-trees have found so far, 0 to 1.
    pub fn recall(&self) -> f64 {
        self.recall.share()
    }
}

impl Found {
    fn find(&mut self, index: &Index, windows: &[QueryWindow], neighbours: usize) {
        self.windows.clear();
        self.windows.extend(windows.iter().map(|window| self.search.find(index, window, neighbours).to_vec()));
    }
}
