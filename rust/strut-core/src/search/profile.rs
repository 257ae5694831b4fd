//! D of every window of a class, for windows of any length: what a search finds the least of.

use super::index::Index;
use super::metric::{LENGTH, MAX_WINDOW, Metric, QueryWindow};
use super::neighbours::Neighbour;
use super::windows::Windows;

/// The windows of one length, compared by all joints.
#[derive(Clone, Debug)]
pub struct Profile {
    windows: Windows,
    norms: Vec<f32>,
}

impl Profile {
    /// The windows of `length` frames in an index's rows; the nearest of 1 to [`MAX_WINDOW`] is taken.
    pub fn new(index: &Index, length: usize) -> Self {
        let windows = index.windows.with_length(length.clamp(1, MAX_WINDOW));
        Self { norms: windows.norms(Metric::FullBody), windows }
    }

    /// Frames of a window.
    pub fn window_length(&self) -> usize {
        self.windows.length
    }

    /// D between a query of as many frames and every window of a class, in the order of rows.
    ///
    /// # Panics
    /// If there is no such class.
    pub fn distances<'a>(&'a self, query: &'a QueryWindow, class: usize) -> impl Iterator<Item = Neighbour> + 'a {
        let window = query.centred(Metric::FullBody);
        self.windows.of_class(class).map(move |last| {
            let frames = self.windows.points::<LENGTH>(last);
            let distance = window.distance::<LENGTH>(Metric::FullBody, frames, self.norms[last]);
            Neighbour { distance, row: last as u32 }
        })
    }
}
