//! Handle of a search by kd-trees beside the exact one.

use crate::database::Database;
use crate::input::Input;
use std::num::NonZero;
use std::sync::Arc;
use strut_core::humanoid::Pose;
use strut_core::pose_vector::HeadingFilter;
use strut_core::search::{ClassSearch, Index, Neighbours, QueryWindow, Recall};
use strut_core::transfer::Model;
use strut_wasm_common::EngineError;
use wasm_bindgen::prelude::wasm_bindgen;

/// The windows of an input on their way through both searches, in portions: [`Self::take`], either search, and
/// [`Self::count`]. Each search is a call of its own, so that its time can be taken.
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
    /// By the exact search.
    nearest: Found,
    /// By kd-trees.
    found: Found,
    recall: Recall,
}

#[derive(Default)]
struct Found {
    search: ClassSearch,
    /// Of each window of the portion.
    windows: Vec<Vec<Neighbours>>,
}

#[wasm_bindgen]
impl SearchComparison {
    /// The search for the nearest `neighbours` of every class, exactly and among so many `candidates` of its kd-tree.
    ///
    /// # Errors
    /// If there are no candidates.
    #[wasm_bindgen(constructor)]
    pub fn new(database: &Database, input: &Input, neighbours: usize, candidates: usize) -> Result<Self, EngineError> {
        let candidates = NonZero::new(candidates)
            .ok_or_else(|| EngineError::bad_input(String::from("at least one candidate was expected")))?;
        let model = Arc::clone(database.model());
        Ok(Self {
            trees: model.index().clone().with_kd_trees(candidates),
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

    /// Takes the windows of up to `frames` more frames, and gives how many.
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

    /// Searches the portion by kd-trees.
    #[wasm_bindgen(js_name = searchTrees)]
    pub fn search_trees(&mut self) {
        self.found.find(&self.trees, &self.portion, self.neighbours);
    }

    /// Counts what both have found in the portion.
    pub fn count(&mut self) {
        for (nearest, found) in self.nearest.windows.iter().zip(&self.found.windows) {
            self.recall.add(nearest, found);
        }
    }

    /// Share of the nearest windows that kd-trees have found so far, 0 to 1.
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
