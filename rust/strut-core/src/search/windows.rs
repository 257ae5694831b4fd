//! The stored windows.

use super::leaves::Bounds;
use super::metric::{CentredWindow, FrameSums, LENGTH, MAX_WINDOW, Metric, frames_of, window_norm};
use super::points::{Feet, FramePoints, PointRow};
use crate::database::{Class, Clip, Database};
use crate::humanoid::JOINTS;
use crate::math::Vec3;
use crate::pose_vector::{HEADING_RATE, Placement};
use std::ops::Range;

/// All windows of a database, row by row.
#[derive(Clone, Debug)]
pub(crate) struct Windows {
    /// Frames of a window.
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
    /// The windows of `length` frames, 1 to [`MAX_WINDOW`].
    pub(crate) fn new(db: &Database, length: usize) -> Self {
        Self::of_clouds(&db.clips, db.classes(), &db.point_cloud, &places(db), length)
    }

    /// The same, of each row's point cloud and place: the rows themselves need not be kept until then.
    pub(crate) fn of_clouds(
        clips: &[Clip],
        classes: &[Class],
        clouds: &[[Vec3; JOINTS]],
        places: &[Placement],
        length: usize,
    ) -> Self {
        let mut windows = Self {
            length,
            points: Vec::with_capacity(clouds.len()),
            greatest_norms: Vec::new(),
            clips: clips.iter().map(Clip::rows).collect(),
            classes: classes.iter().map(|c| c.clips.clone()).collect(),
        };
        for class in classes {
            let mut greatest = 0.0_f32;
            for row in clips[class.clips.clone()].iter().flat_map(Clip::rows) {
                let points = FramePoints::new(&clouds[row], places[row]);
                greatest = greatest.max(points.norm());
                windows.points.push(points.0);
            }
            windows.greatest_norms.push(greatest);
        }
        windows
    }

    /// The windows of another length in the same rows.
    #[cfg(feature = "baselines")]
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

    /// Rows of a clip at which a window ends; never its first, which has no row before it to regress on.
    fn of_clip(&self, clip: &Range<usize>) -> Range<usize> {
        (clip.start + frames_of::<LENGTH>(self.length).max(2) - 1).min(clip.end)..clip.end
    }

    /// Positions of the feet at a row, in the clip's frame of reference.
    pub(super) fn feet(&self, row: usize) -> Feet {
        FramePoints(self.points[row]).feet()
    }

    /// |y|² + |z|² of the window that ends at each row; 0 where none does.
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

    /// The points of the window that ends at row `last`.
    #[inline]
    pub(super) fn points<const S: usize>(&self, last: usize) -> &[PointRow] {
        let frames = frames_of::<S>(self.length);
        &self.points[last + 1 - frames..][..frames]
    }

    /// [`CentredWindow::scale`] of all windows.
    pub(super) fn scale(&self, metric: Metric) -> f32 {
        1.0 / (frames_of::<LENGTH>(self.length) as f32 * metric.share())
    }

    /// Bounds on the windows of a class, whose `norms` are given.
    pub(super) fn bounds(&self, class: usize, metric: Metric, norms: &[f32]) -> Bounds {
        Bounds {
            scale: self.scale(metric),
            norm: self.of_class(class).map(|row| norms[row]).fold(0.0, f32::max),
            uncentred_length: (self.greatest_norms[class] / metric.share()).sqrt(),
        }
    }

    /// The vector of the window that ends at row `last`.
    pub(super) fn centred(&self, last: usize, metric: Metric) -> CentredWindow {
        let mut frames = [FramePoints::default(); MAX_WINDOW];
        for (frame, row) in frames.iter_mut().zip(self.points::<LENGTH>(last)) {
            *frame = FramePoints(*row);
        }
        CentredWindow::new(&frames[..self.length], metric)
    }
}

/// Where every row is in its clip's frame of reference, which has the middle of the path at the origin: small numbers leave
/// more digits to the differences.
pub(crate) fn places(db: &Database) -> Vec<Placement> {
    let dt = 1.0 / db.rate_hz;
    let mut places = vec![Placement::default(); db.frames()];
    for rows in db.clips.iter().map(Clip::rows) {
        let mut at = Placement::default();
        for row in rows.clone().skip(1) {
            at = at.advanced(&db.pose[row], dt, db.pose[row][HEADING_RATE] * dt);
            places[row] = at;
        }
        let of_clip = &mut places[rows];
        let middle = of_clip.get(of_clip.len() / 2).copied().unwrap_or_default();
        for place in of_clip {
            (place.x, place.z) = (place.x - middle.x, place.z - middle.z);
        }
    }
    places
}
