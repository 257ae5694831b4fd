//! D of every window of a class, for windows of any length: the values that a search minimises.

use super::index::Index;
use super::metric::{LENGTH, MAX_WINDOW, Metric, QueryWindow};
use super::neighbours::Neighbour;
use super::windows::Windows;

/// Windows of one length, compared by all joints.
#[derive(Clone, Debug)]
pub struct Profile {
    windows: Windows,
    norms: Vec<f32>,
}

impl Profile {
    /// Windows of `length` frames, clamped to 1 to [`MAX_WINDOW`], in the rows of an index.
    pub fn new(index: &Index, length: usize) -> Self {
        let windows = index.windows.with_length(length.clamp(1, MAX_WINDOW));
        Self { norms: windows.norms(Metric::FullBody), windows }
    }

    /// Number of frames of a window.
    pub fn window_length(&self) -> usize {
        self.windows.length
    }

    /// D between a query of the same length and every window of a class, in the order of rows.
    ///
    /// # Panics
    /// If the class does not exist.
    pub fn distances<'a>(&'a self, query: &'a QueryWindow, class: usize) -> impl Iterator<Item = Neighbour> + 'a {
        let window = query.centred(Metric::FullBody);
        self.windows.of_class(class).map(move |last| {
            let frames = self.windows.points::<LENGTH>(last);
            let distance = window.distance::<LENGTH>(Metric::FullBody, frames, self.norms[last]);
            Neighbour { distance, row: last as u32 }
        })
    }
}
