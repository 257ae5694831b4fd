//! Exact search for the stored windows that resemble the last frames of the input.
//!
//! A window ends at a row and holds it and the rows before it in the same clip, [`WINDOW`] in all; the first
//! rows of a clip end no window. Rows are kept once, in a frame of reference of their clip that is rebuilt by
//! integrating the rows' velocities and heading rates, so that overlapping windows share them.

#[cfg(test)]
mod brute_force;
mod lanes;
mod metric;
mod neighbours;
mod path_bound;

pub use metric::{JOINT_WEIGHTS, MAX_WINDOW, Metric, QueryWindow, WINDOW};
pub use neighbours::{Neighbour, Neighbours};

use crate::database::Database;
use crate::pose_vector::{HEADING_RATE, Placement};
use metric::{FramePoints, GroundRow, HeightRow, LENGTH, frames_of, window_norm};
use path_bound::{limit_from_last, step_length};
use std::ops::Range;

/// All windows of a database, ready to be searched.
#[derive(Clone, Debug)]
pub struct Index {
    /// Frames of a window.
    length: usize,
    heights: Vec<HeightRow>,
    ground: Vec<GroundRow>,
    /// |y|² + |z|² of the window that ends at each row; unused where none does.
    full_norms: Vec<f32>,
    lower_norms: Vec<f32>,
    /// Path length from the first window of the clip to the one that ends at each row, metres.
    full_path: Vec<f32>,
    lower_path: Vec<f32>,
    /// Rows of each clip.
    clips: Vec<Range<usize>>,
    /// Clips of each class.
    classes: Vec<Range<usize>>,
}

/// Working memory of a query; keep one per stream of queries.
#[derive(Clone, Debug, Default)]
pub struct Scratch {
    found: Neighbours,
}

impl Index {
    /// The windows of a database. One pass over the rows; 250 bytes a row.
    pub fn build(db: &Database) -> Self {
        Self::with_window(db, WINDOW)
    }

    /// The windows of `length` frames; the nearest of 1 to [`MAX_WINDOW`] is taken.
    pub fn with_window(db: &Database, length: usize) -> Self {
        let length = length.clamp(1, MAX_WINDOW);
        let mut index = Self {
            length,
            heights: Vec::with_capacity(db.frames()),
            ground: Vec::with_capacity(db.frames()),
            full_norms: vec![0.0; db.frames()],
            lower_norms: vec![0.0; db.frames()],
            full_path: vec![0.0; db.frames()],
            lower_path: vec![0.0; db.frames()],
            clips: db.clips.iter().map(crate::database::Clip::rows).collect(),
            classes: db.classes().iter().map(|c| c.clips.clone()).collect(),
        };
        for (clip, rows) in db.clips.iter().map(|c| (c, c.rows())) {
            let points: Vec<FramePoints> = clip_points(db, clip.rows()).collect();
            for last in index.windows_of_clip(&rows) {
                let end = last + 1 - rows.start;
                let frames = &points[end - length..end];
                index.full_norms[last] = window_norm(frames, Metric::FullBody);
                index.lower_norms[last] = window_norm(frames, Metric::LowerBody);
            }
            index.heights.extend(points.iter().map(|p| p.height));
            index.ground.extend(points.iter().map(|p| p.ground));
            index.measure_paths(rows, &points);
        }
        index
    }

    /// Fills in the path lengths of a clip, whose points and norms are there already.
    fn measure_paths(&mut self, rows: Range<usize>, points: &[FramePoints]) {
        let windows = self.windows_of_clip(&rows);
        for last in windows.start..windows.end.saturating_sub(1) {
            let end = last + 1 - rows.start;
            let query = QueryWindow::from_points(&points[end - self.length..end]);
            let full = step_length(self.distance::<LENGTH>(&query, Metric::FullBody, last + 1));
            let lower = step_length(self.distance::<LENGTH>(&query, Metric::LowerBody, last + 1));
            self.full_path[last + 1] = self.full_path[last] + full;
            self.lower_path[last + 1] = self.lower_path[last] + lower;
        }
    }

    /// Frames of a window.
    pub fn window_length(&self) -> usize {
        self.length
    }

    /// Number of classes.
    pub fn classes(&self) -> usize {
        self.classes.len()
    }

    /// Number of windows of a class.
    ///
    /// # Panics
    /// If there is no such class.
    pub fn windows_in_class(&self, class: usize) -> usize {
        self.clips[self.classes[class].clone()].iter().map(|c| self.windows_of_clip(c).len()).sum()
    }

    /// The `k` windows of a class that are nearest by the full-body metric; fewer if the class has fewer.
    ///
    /// # Panics
    /// If there is no such class.
    pub fn query(&self, query: &QueryWindow, class: usize, k: usize, scratch: &mut Scratch, out: &mut Neighbours) {
        self.query_classes(query, Metric::FullBody, &[class], k, scratch, out);
    }

    /// The `k` nearest windows of several classes together by either metric.
    ///
    /// `query` is as long as [`Index::window_length`].
    /// What `out` holds beforehand is taken as the result for the frame before: if it is, the search is
    /// faster; the result does not depend on it.
    ///
    /// # Panics
    /// If there is no such class.
    pub fn query_classes(
        &self,
        query: &QueryWindow,
        metric: Metric,
        classes: &[usize],
        k: usize,
        scratch: &mut Scratch,
        out: &mut Neighbours,
    ) {
        if self.length == WINDOW || LENGTH == WINDOW {
            self.query_sized::<WINDOW>(query, metric, classes, k, scratch, out);
        } else {
            self.query_sized::<LENGTH>(query, metric, classes, k, scratch, out);
        }
    }

    /// [`Index::query_classes`] with windows of `S` frames.
    fn query_sized<const S: usize>(
        &self,
        query: &QueryWindow,
        metric: Metric,
        classes: &[usize],
        k: usize,
        scratch: &mut Scratch,
        out: &mut Neighbours,
    ) {
        scratch.found.begin(k);
        let limit = limit_from_last::<S>(self, query, metric, classes, out, &mut scratch.found);
        scratch.found.begin(k);
        for &class in classes {
            path_bound::offer_class::<S>(self, query, metric, class, limit, &mut scratch.found);
        }
        std::mem::swap(&mut scratch.found, out);
    }

    /// D between the query and the window that ends at row `last`.
    #[inline]
    fn distance<const S: usize>(&self, query: &QueryWindow, metric: Metric, last: usize) -> f32 {
        let (height, ground) = self.window::<S>(last);
        query.distance::<S>(metric, height, ground, self.norms(metric)[last])
    }

    /// The points of the window that ends at row `last`, one of [`Index::windows_of_clip`].
    #[inline]
    fn window<const S: usize>(&self, last: usize) -> (&[HeightRow], &[GroundRow]) {
        let frames = frames_of::<S>(self.length);
        let first = last + 1 - frames;
        (&self.heights[first..][..frames], &self.ground[first..][..frames])
    }

    /// Rows of a clip at which a window ends; never its first, which has no row before it to regress on.
    fn windows_of_clip(&self, clip: &Range<usize>) -> Range<usize> {
        (clip.start + frames_of::<LENGTH>(self.length).max(2) - 1).min(clip.end)..clip.end
    }

    fn norms(&self, metric: Metric) -> &[f32] {
        match metric {
            Metric::FullBody => &self.full_norms,
            Metric::LowerBody => &self.lower_norms,
        }
    }

    fn path(&self, metric: Metric) -> &[f32] {
        match metric {
            Metric::FullBody => &self.full_path,
            Metric::LowerBody => &self.lower_path,
        }
    }
}

/// The points of a clip in a frame of reference with the middle of the path at the origin: small numbers
/// leave more digits to the differences.
fn clip_points(db: &Database, rows: Range<usize>) -> impl Iterator<Item = FramePoints> + '_ {
    let dt = 1.0 / db.rate_hz;
    let mut at = Placement::default();
    let places: Vec<Placement> = rows
        .clone()
        .map(|row| {
            if row > rows.start {
                at = at.advanced(&db.pose[row], dt, db.pose[row][HEADING_RATE] * dt);
            }
            at
        })
        .collect();
    let middle = places.get(places.len() / 2).copied().unwrap_or_default();
    rows.zip(places).map(move |(row, p)| {
        FramePoints::new(&db.point_cloud[row], Placement { x: p.x - middle.x, z: p.z - middle.z, heading: p.heading })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kinematics::world_from_local;
    use crate::pose_vector::{HeadingFilter, point_cloud};
    use crate::transfer::sine_walk::{self, BENT, Gait, NEUTRAL};
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]
        #[test]
        fn finds_what_brute_force_finds(lean in 0.0f32..0.6, period in 40.0f32..90.0, turn in -0.5f32..0.5, k in 1usize..50, length in prop::sample::select(vec![WINDOW, 1, MAX_WINDOW])) {
            let db = sine_walk::database();
            let index = Index::with_window(&db, length);
            let gait = Gait { period, lean, turn, ..if lean > 0.3 { BENT } else { NEUTRAL } };
            let (mut window, mut filter, mut scratch) = (QueryWindow::new(length), HeadingFilter::default(), Scratch::default());
            let mut found = [Neighbours::default(), Neighbours::default()];
            for pose in &sine_walk::walk(&gait, 40, 0.1).poses {
                let heading = filter.update(&world_from_local(&db.proportions, pose), 1.0 / db.rate_hz);
                let at = Placement { x: pose.root.x, z: pose.root.z, heading };
                window.push(&point_cloud(&db.proportions, pose, heading), at);
                for (metric, out) in [Metric::FullBody, Metric::LowerBody].into_iter().zip(&mut found) {
                    let classes = [0, index.classes() - 1];
                    index.query_classes(&window, metric, &classes, k, &mut scratch, out);
                    let mut expected = Neighbours::default();
                    expected.begin(k);
                    for class in classes {
                        brute_force::offer_class(&index, &window, metric, class, &mut expected);
                    }
                    prop_assert_eq!(out.as_slice(), expected.as_slice());
                }
            }
        }
    }
}
