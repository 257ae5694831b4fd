//! Share of the nearest windows that an approximate search finds, compared with the exact search.

use strut_core::search::{Index, Metric, Neighbours, QueryWindow, Scratch};

/// Search of a stream of windows in every class. As in the engine, the result for a window speeds up the exact search
/// for the next; the results do not depend on it.
#[derive(Clone, Debug, Default)]
pub struct ClassSearch {
    scratch: Scratch,
    found: Vec<Neighbours>,
}

impl ClassSearch {
    /// Finds the `k` windows of each class that are nearest by the full-body metric.
    pub fn find(&mut self, index: &Index, window: &QueryWindow, k: usize) -> &[Neighbours] {
        self.found.resize_with(index.classes(), Neighbours::default);
        let query = index.prepare(window, Metric::FullBody);
        for (class, found) in self.found.iter_mut().enumerate() {
            index.nearest(&query, &[class], k, &mut self.scratch, found);
        }
        &self.found
    }

    /// Discards the last result before the next search, as after a seek.
    pub fn forget(&mut self) {
        self.found.iter_mut().for_each(|found| found.begin(0));
    }
}

/// Share of the nearest windows that a search finds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Recall {
    found: usize,
    nearest: usize,
}

impl Recall {
    /// Adds the lists found for a window and the lists of its nearest windows.
    pub fn add(&mut self, nearest: &[Neighbours], found: &[Neighbours]) {
        for (nearest, found) in nearest.iter().zip(found) {
            self.nearest += nearest.as_slice().len();
            self.found += nearest.as_slice().iter().filter(|n| found.as_slice().contains(n)).count();
        }
    }

    /// Share of 0 to 1; 1 if there was nothing to find.
    pub fn share(&self) -> f64 {
        if self.nearest == 0 { 1.0 } else { self.found as f64 / self.nearest as f64 }
    }
}
