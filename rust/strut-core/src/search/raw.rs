//! Data for implementing the search elsewhere and for comparing it: positions, windows, D, and bounds of the rounding
//! error of a computed D.

use super::index::{Index, Query};
use super::metric::{LENGTH, Metric, QueryWindow, WINDOW};
use super::points::{FramePoints, POINTS, point_roots};

/// Positions of the joints of [`JOINT_WEIGHTS`](super::JOINT_WEIGHTS) in one frame: height, x and z, metres.
pub type RawPoints = [[f64; 3]; POINTS];

impl Index {
    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.windows.rows()
    }

    /// Weights of joints in the full-body metric, with the precision that the computation uses; they sum to 1 except
    /// for rounding.
    pub fn joint_weights() -> [f64; POINTS] {
        point_roots().map(|root| f64::from(root) * f64::from(root))
    }

    /// Positions of the joints at a row, in its clip's frame of reference.
    ///
    /// # Panics
    /// If the row does not exist.
    pub fn positions(&self, row: usize) -> RawPoints {
        raw(&FramePoints(self.windows.points_of_row(row)))
    }

    /// Rows at which the windows of a class end, ascending.
    ///
    /// # Panics
    /// If the class does not exist.
    pub fn window_ends(&self, class: usize) -> impl Iterator<Item = usize> + '_ {
        self.windows.of_class(class)
    }

    /// D between a query and the window that ends at a row, m²: bit-identical to the value by which [`Index::nearest`]
    /// orders windows.
    ///
    /// # Panics
    /// If no window ends there.
    pub fn distance_to(&self, query: &Query<'_>, row: usize) -> f32 {
        if self.window_length() == WINDOW {
            self.distance::<WINDOW>(query, row)
        } else {
            self.distance::<LENGTH>(query, row)
        }
    }

    /// Bound on the rounding error of [`Index::distance_to`] for the windows of a class, m².
    ///
    /// # Panics
    /// If the class does not exist.
    pub fn rounding(&self, query: &Query<'_>, class: usize) -> f32 {
        self.margins(query, class).rounding()
    }
}

impl QueryWindow {
    /// Positions of the joints in its frames, relative to the newest hips; missing frames are extrapolated. An empty
    /// window has none.
    pub fn positions(&self) -> impl Iterator<Item = RawPoints> {
        let frames = self.centred(Metric::FullBody).frames;
        (frames > 0).then(|| self.frame_points()).into_iter().flatten().take(frames).map(|points| raw(&points))
    }
}

/// Positions without the weights that are multiplied into points.
fn raw(points: &FramePoints) -> RawPoints {
    let roots = point_roots();
    std::array::from_fn(|i| points.get(i).map(|v| f64::from(v) / f64::from(roots[i])))
}
