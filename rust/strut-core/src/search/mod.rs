//! Exact search for the stored windows that resemble the last frames of the input.
//!
//! A window ends at a row and holds it and the four rows before it in the same clip; the first rows of a
//! clip end no window. Rows are kept once, in a frame of reference of their clip that is rebuilt by
//! integrating the rows' velocities and heading rates, so that overlapping windows share them.

mod brute_force;
mod lanes;
mod metric;
mod neighbours;

pub use metric::{Metric, QueryWindow, WINDOW};
pub use neighbours::{Neighbour, Neighbours};

use crate::database::Database;
use crate::pose_vector::{HEADING_RATE, Placement};
use metric::{FramePoints, GroundRow, HeightRow, window_norm};
use std::ops::Range;

/// All windows of a database, ready to be searched.
#[derive(Clone, Debug)]
pub struct Index {
    heights: Vec<HeightRow>,
    ground: Vec<GroundRow>,
    /// |y|² + |z|² of the window that ends at each row; unused where none does.
    full_norms: Vec<f32>,
    lower_norms: Vec<f32>,
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
        let mut index = Self {
            heights: Vec::with_capacity(db.frames()),
            ground: Vec::with_capacity(db.frames()),
            full_norms: vec![0.0; db.frames()],
            lower_norms: vec![0.0; db.frames()],
            clips: db.clips.iter().map(crate::database::Clip::rows).collect(),
            classes: db.classes().iter().map(|c| c.clips.clone()).collect(),
        };
        for (clip, rows) in db.clips.iter().zip(&index.clips) {
            let points: Vec<FramePoints> = clip_points(db, clip.rows()).collect();
            for last in windows_of_clip(rows) {
                let end = last + 1 - rows.start;
                if let Some(frames) = points[..end].last_chunk::<WINDOW>() {
                    index.full_norms[last] = window_norm(frames, Metric::FullBody);
                    index.lower_norms[last] = window_norm(frames, Metric::LowerBody);
                }
            }
            index.heights.extend(points.iter().map(|p| p.height));
            index.ground.extend(points.iter().map(|p| p.ground));
        }
        index
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
        self.clips[self.classes[class].clone()].iter().map(|c| windows_of_clip(c).len()).sum()
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
        scratch.found.begin(k);
        for &class in classes {
            brute_force::offer_class(self, query, metric, class, &mut scratch.found);
        }
        std::mem::swap(&mut scratch.found, out);
    }

    /// The points of the window that ends at row `last`, which is at least the fifth of its clip.
    #[inline]
    fn window(&self, last: usize) -> (&[HeightRow; WINDOW], &[GroundRow; WINDOW]) {
        let (height, ground) = (self.heights[..=last].last_chunk(), self.ground[..=last].last_chunk());
        height.zip(ground).expect("windows end at the fifth row of a clip or later")
    }

    fn norms(&self, metric: Metric) -> &[f32] {
        match metric {
            Metric::FullBody => &self.full_norms,
            Metric::LowerBody => &self.lower_norms,
        }
    }
}

/// Rows of a clip at which a window ends.
fn windows_of_clip(clip: &Range<usize>) -> Range<usize> {
    (clip.start + WINDOW - 1).min(clip.end)..clip.end
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
