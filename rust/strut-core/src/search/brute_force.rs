//! Compares all windows of a class: the definition that the search must match.

use super::index::{Index, Query};
use super::metric::{LENGTH, WINDOW};
use super::neighbours::{Neighbour, Neighbours};

impl Index {
    /// [`Index::nearest`] without any pruning.
    ///
    /// # Panics
    /// If a class does not exist.
    pub fn nearest_by_brute_force(&self, query: &Query<'_>, classes: &[usize], k: usize, out: &mut Neighbours) {
        if self.windows.length == WINDOW {
            self.compare_all::<WINDOW>(query, classes, k, out);
        } else {
            self.compare_all::<LENGTH>(query, classes, k, out);
        }
    }

    fn compare_all<const S: usize>(&self, query: &Query<'_>, classes: &[usize], k: usize, out: &mut Neighbours) {
        out.begin(k);
        for &class in classes {
            for last in self.windows.of_class(class) {
                let distance = self.distance::<S>(query, last);
                out.offer(Neighbour { distance, row: last as u32 });
            }
        }
    }
}
