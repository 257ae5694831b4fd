//! The stored windows.

use super::leaves::Bounds;
use super::metric::{CentredWindow, FrameSums, LENGTH, MAX_WINDOW, Metric, frames_of, window_norm};
use super::points::{Feet, FramePoints, PointRow};
use crate::database::{Class, Clip, Database, PointCloud};
use crate::pose_vector::{HEADING_RATE, Placement, PoseRow};
use std::ops::Range;

/// All windows of a database, in the order of rows.
#[derive(Clone, Debug)]
pub(crate) struct Windows {
    /// Number of frames of a window.
    pub(super) length: usize,
    points: Vec<PointRow>,
    /// Greatest squared length of a frame's points in each class, metres².
    greatest_norms: Vec<f32>,
    /// Rows of each clip.
    clips: Vec<Range<usize>>,
    /// Clips of each class.
    pub(super) classes: Vec<Range<usize>>,
}

impl Windows {
    /// Windows of `length` frames, 1 to [`MAX_WINDOW`].
    pub(crate) fn new(db: &Database, length: usize) -> Self {
        let mut windows = Self::empty(&db.clips, db.classes(), length);
        windows.add(&db.point_cloud, &places(db));
        windows
    }

    /// Windows of rows that are not yet [added](Self::add).
    pub(crate) fn empty(clips: &[Clip], classes: &[Class], length: usize) -> Self {
        Self {
            length,
            points: Vec::with_capacity(clips.last().map_or(0, |clip| clip.rows().end)),
            greatest_norms: vec![0.0; classes.len()],
            clips: clips.iter().map(Clip::rows).collect(),
            classes: classes.iter().map(|c| c.clips.clone()).collect(),
        }
    }

    /// Adds the next rows: their point clouds and placements.
    pub(crate) fn add(&mut self, clouds: &[PointCloud], places: &[Placement]) {
        let mut class = self.classes.partition_point(|class| self.rows_of(class).end <= self.points.len());
        for (cloud, place) in clouds.iter().zip(places) {
            while self.rows_of(&self.classes[class]).end <= self.points.len() {
                class += 1;
            }
            let points = FramePoints::new(cloud, *place);
            self.greatest_norms[class] = self.greatest_norms[class].max(points.norm());
            self.points.push(points.0);
        }
    }

    /// Rows of some successive clips.
    fn rows_of(&self, clips: &Range<usize>) -> Range<usize> {
        let clips = &self.clips[clips.clone()];
        clips.first().map_or(0, |clip| clip.start)..clips.last().map_or(0, |clip| clip.end)
    }

    /// Windows of another length in the same rows.
    pub(super) fn with_length(&self, length: usize) -> Self {
        Self { length, ..self.clone() }
    }

    /// Number of rows.
    pub(super) fn rows(&self) -> usize {
        self.points.len()
    }

    /// Rows at which the windows of a class end, ascending.
    pub(super) fn of_class(&self, class: usize) -> impl Iterator<Item = usize> + '_ {
        self.clips[self.classes[class].clone()].iter().flat_map(|c| self.of_clip(c))
    }

    /// Rows of a clip at which a window ends; never the first row, which has no predecessor for the regression.
    fn of_clip(&self, clip: &Range<usize>) -> Range<usize> {
        (clip.start + frames_of::<LENGTH>(self.length).max(2) - 1).min(clip.end)..clip.end
    }

    /// Positions of the feet at a row at which a window ends and at the two rows before it, oldest first, in the clip's
    /// frame of reference. If windows are shorter than three frames, a clip's first row is repeated for rows before it.
    pub(super) fn last_feet(&self, row: usize) -> [Feet; 3] {
        let begins_before = frames_of::<LENGTH>(self.length) >= 3;
        let first = if begins_before { 0 } else { self.clips[self.clips.partition_point(|c| c.end <= row)].start };
        [2, 1, 0].map(|back| FramePoints(self.points[row.saturating_sub(back).max(first)]).feet())
    }

    /// Points of a row.
    pub(super) fn points_of_row(&self, row: usize) -> PointRow {
        self.points[row]
    }

    /// |y|² + |z|² of the window that ends at each row; 0 if none ends there.
    pub(super) fn norms(&self, metric: Metric) -> Vec<f32> {
        let mut norms = vec![0.0; self.rows()];
        for clip in &self.clips {
            let frame = |row: &PointRow| FrameSums::new(&FramePoints(*row), metric);
            let sums: Vec<FrameSums> = self.points[clip.clone()].iter().map(frame).collect();
            for end in self.of_clip(clip) {
                let last = end - clip.start;
                norms[end] = window_norm(&sums[last + 1 - frames_of::<LENGTH>(self.length)..=last], metric);
            }
        }
        norms
    }

    /// Points of the window that ends at row `last`.
    #[inline]
    pub(super) fn points<const S: usize>(&self, last: usize) -> &[PointRow] {
        let frames = frames_of::<S>(self.length);
        &self.points[last + 1 - frames..][..frames]
    }

    /// [`CentredWindow::scale`] of all windows.
    pub(super) fn scale(&self, metric: Metric) -> f32 {
        1.0 / (frames_of::<LENGTH>(self.length) as f32 * metric.share())
    }

    /// Bounds for the windows of a class, given their `norms`.
    pub(super) fn bounds(&self, class: usize, metric: Metric, norms: &[f32]) -> Bounds {
        Bounds {
            scale: self.scale(metric),
            norm: self.of_class(class).map(|row| norms[row]).fold(0.0, f32::max),
            uncentred_length: (self.greatest_norms[class] / metric.share()).sqrt(),
        }
    }

    /// Vector of the window that ends at row `last`.
    pub(super) fn centred(&self, last: usize, metric: Metric) -> CentredWindow {
        let mut frames = [FramePoints::default(); MAX_WINDOW];
        for (frame, row) in frames.iter_mut().zip(self.points::<LENGTH>(last)) {
            *frame = FramePoints(*row);
        }
        CentredWindow::new(&frames[..self.length], metric)
    }
}

/// Placement of every row of a database in its clip's frame of reference.
pub(crate) fn places(db: &Database) -> Vec<Placement> {
    let mut places = Places::with_capacity(db.frames(), db.rate_hz);
    for clip in &db.clips {
        places.add(&db.pose[clip.rows()], true);
        places.end_clip(clip.frames);
    }
    places.all
}

/// Placements of rows in their clip's frame of reference, whose origin is the middle of the path: small numbers leave
/// more digits for the differences.
#[derive(Clone, Debug)]
pub(crate) struct Places {
    dt_secs: f32,
    /// Placements of all rows so far.
    pub(crate) all: Vec<Placement>,
}

impl Places {
    /// An empty list with capacity for this number of rows.
    pub(crate) fn with_capacity(rows: usize, rate_hz: f32) -> Self {
        Self { dt_secs: 1.0 / rate_hz, all: Vec::with_capacity(rows) }
    }

    /// Adds the next rows of a clip. `begins_clip`: whether the first of them is the first row of the clip.
    pub(crate) fn add(&mut self, rows: &[PoseRow], begins_clip: bool) {
        for (i, row) in rows.iter().enumerate() {
            let before = self.all.last().filter(|_| i > 0 || !begins_clip);
            let turn = row[HEADING_RATE] * self.dt_secs;
            self.all.push(before.map_or(Placement::default(), |at| at.advanced(row, self.dt_secs, turn)));
        }
    }

    /// Ends a clip of this number of rows, all of which have been added.
    pub(crate) fn end_clip(&mut self, rows: usize) {
        let of_clip = self.all.len() - rows;
        let of_clip = &mut self.all[of_clip..];
        let middle = of_clip.get(of_clip.len() / 2).copied().unwrap_or_default();
        for place in of_clip {
            (place.x, place.z) = (place.x - middle.x, place.z - middle.z);
        }
    }
}
