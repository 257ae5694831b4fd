//! Builds a catalogue from rows that are read in parts.

use super::gait_phase::GaitPhase;
use super::header::Header;
use super::quantised::QuantisedRows;
use super::runtime::Catalogue;
use crate::database::{
    Clip, Database, DatabaseError, DatabaseParts, PointCloud, RowSquares, RowSums, StepSums, validate_point_clouds,
    validate_poses, validate_short_tensors, validated_classes,
};
use crate::humanoid::JOINTS;
use crate::math::Vec3;
use crate::pose_vector::{PoseRow, ROW};
use crate::search::{Index, Places, Plan, PlanSource, WINDOW, Windows};
use std::ops::Range;

/// Number of rows that are read at once.
const PORTION: usize = 256;

/// Copies rows from an index on. The rows must exist.
pub type RowReader<'a, T> = dyn Fn(usize, &mut [T]) + 'a;

/// A [`Catalogue`] without its index. The tensors that take most of a database's bytes are copied in parts from their
/// source, so that the memory of a WebAssembly module, which never shrinks, need not contain them.
pub struct CatalogueBuilder {
    header: Header,
    rows: QuantisedRows,
    places: Places,
    time_step: Vec<f32>,
    gait_phase: GaitPhase,
    contact: Vec<[u8; 2]>,
    counterparts_per_style: usize,
    counterpart: Vec<f32>,
    sigma: PoseRow,
    step_sigma: PoseRow,
    observed_range: Box<[PoseRow; 2]>,
}

impl CatalogueBuilder {
    /// Reads the poses: `read` copies the rows from an index on. The poses and point clouds of `parts` are not used.
    /// Every shape, index and value is checked as by [`Database::new`](crate::database::Database::new).
    ///
    /// # Errors
    /// See [`DatabaseError`].
    pub fn new(parts: DatabaseParts, read: &RowReader<'_, PoseRow>) -> Result<Self, DatabaseError> {
        let classes = validated_classes(&parts)?;
        let n = validate_short_tensors(&parts)?;
        let mut portion = vec![[0.0; ROW]; PORTION.min(n)];
        let mut places = Places::with_capacity(n, parts.rate_hz);
        let (mut sums, mut steps) = (RowSums::default(), StepSums::default());
        for clip in &parts.clips {
            let mut last = None;
            for rows in portions_of(clip) {
                let poses = &mut portion[..rows.len()];
                read(rows.start, poses);
                validate_poses(rows.start, poses)?;
                sums.add(poses);
                let before = last.as_ref().into_iter().chain(&*poses);
                before.zip(&poses[usize::from(last.is_none())..]).for_each(|(from, to)| steps.add(from, to));
                places.add(poses, last.is_none());
                last = poses.last().copied();
            }
            places.end_clip(clip.frames);
        }
        let observed_range = Box::new(sums.range());
        let mut rows = QuantisedRows::with_range(&observed_range, n);
        let mut squares = RowSquares::around(sums.mean());
        for part in parts.clips.iter().flat_map(portions_of) {
            let poses = &mut portion[..part.len()];
            read(part.start, poses);
            squares.add(poses);
            for row in poses {
                rows.push(row);
            }
        }
        let gait_phase = GaitPhase::new(&parts);
        let mut parts = parts;
        let header = Header::take(&mut parts, classes);
        let DatabaseParts { time_step, contact, counterparts_per_style, counterpart, .. } = parts;
        Ok(Self {
            header,
            rows,
            places,
            time_step,
            gait_phase,
            contact,
            counterparts_per_style,
            counterpart,
            sigma: squares.deviation(),
            step_sigma: steps.deviation(),
            observed_range,
        })
    }

    /// Rows of a database, and its point clouds.
    fn of(db: Database) -> (Self, Vec<PointCloud>) {
        let (mut parts, _) = db.into_parts();
        let (pose, point_cloud) = (std::mem::take(&mut parts.pose), std::mem::take(&mut parts.point_cloud));
        let copy = |first: usize, to: &mut [PoseRow]| to.copy_from_slice(&pose[first..][..to.len()]);
        (valid(Self::new(parts, &copy)), point_cloud)
    }

    /// Reads the point clouds with `read`, as in [`CatalogueBuilder::new`], and creates the search index from a plan.
    /// Without a plan, or with that of another database, the index is built, which takes longer.
    ///
    /// # Errors
    /// If a position is not finite or not within 1 km.
    pub fn finish(
        mut self,
        read: Box<RowReader<'_, PointCloud>>,
        plan: Option<PlanSource<'_>>,
    ) -> Result<Catalogue, DatabaseError> {
        let mut windows = Windows::empty(&self.header.clips, self.header.classes(), WINDOW);
        let mut portion = vec![[Vec3::ZERO; JOINTS]; PORTION.min(self.header.frames())];
        for rows in self.header.clips.iter().flat_map(portions_of) {
            let clouds = &mut portion[..rows.len()];
            read(rows.start, clouds);
            validate_point_clouds(rows.start, clouds)?;
            windows.add(clouds, &self.places.all[rows]);
        }
        drop((read, portion, std::mem::take(&mut self.places.all)));
        Ok(self.finish_with(Index::of_windows(windows, plan)))
    }

    /// Completes the catalogue with an index of the same rows.
    fn finish_with(self, index: Index) -> Catalogue {
        Catalogue {
            header: self.header,
            rows: self.rows,
            time_step: self.time_step,
            gait_phase: self.gait_phase,
            contact: self.contact,
            counterparts_per_style: self.counterparts_per_style,
            counterpart: self.counterpart,
            sigma: self.sigma,
            step_sigma: self.step_sigma,
            observed_range: self.observed_range,
            index,
        }
    }
}

impl Catalogue {
    /// Creates the catalogue of a database; builds the search index.
    pub fn new(db: Database) -> Self {
        Self::with_plan(db, None)
    }

    /// Creates the catalogue of a database with the search index of a plan. Without a plan, or with that of another
    /// database, the index is built, which takes longer.
    ///
    /// # Panics
    /// Never: a [`Database`] was validated when it was created.
    pub fn with_plan(db: Database, plan: Option<Plan>) -> Self {
        let (builder, point_cloud) = CatalogueBuilder::of(db);
        let copy = move |first: usize, to: &mut [PointCloud]| to.copy_from_slice(&point_cloud[first..][..to.len()]);
        let finish = |plan: Option<PlanSource<'_>>| valid(builder.finish(Box::new(copy), plan));
        match plan {
            Some(plan) if plan.has_all_points() => plan.with_source(|plan| finish(Some(plan))),
            _ => finish(None),
        }
    }

    /// Creates the catalogue of a database with its index.
    ///
    /// # Panics
    /// As [`Catalogue::with_plan`].
    pub fn with_index(db: Database, index: Index) -> Self {
        CatalogueBuilder::of(db).0.finish_with(index)
    }
}

/// Unwraps a result for a [`Database`], which was validated when it was created. `expect` is not used, because its
/// formatting of an error would be a twenty-fifth of a small package.
fn valid<T>(result: Result<T, DatabaseError>) -> T {
    result.unwrap_or_else(|error| unreachable!("the database is valid, but {error}"))
}

/// Rows of a clip in parts.
fn portions_of(clip: &Clip) -> impl Iterator<Item = Range<usize>> {
    let rows = clip.rows();
    rows.clone().step_by(PORTION).map(move |first| first..rows.end.min(first + PORTION))
}
