//! The runtime database: registered (action × style) motion, compact and read-only.
//!
//! Rows (frames) are sorted by class, an (action, style) pair, and within it by clip, so that a class
//! is a contiguous range of rows. The layout follows the `.strutdb` file (DESIGN §5).

pub mod build;
mod quantised;
#[cfg(feature = "offline")]
mod residual;
mod target_table;
mod without_clips;

pub use quantised::QuantisedRows;
pub(crate) use quantised::Rows;
#[cfg(feature = "offline")]
pub use residual::residuals;
pub use target_table::TargetTable;

use crate::humanoid::{JOINTS, Proportions};
use crate::math::Vec3;
use crate::pose_vector::{DOFS, PoseChart, PoseRow, ROW};
use std::ops::Range;
use thiserror::Error;

/// Most frames a database may have.
pub const MAX_FRAMES: usize = 4_000_000;
/// Most counterparts a frame may have in a style.
pub const MAX_COUNTERPARTS: usize = 8;

/// One clip of a [`Database`].
#[derive(Clone, Debug, PartialEq)]
pub struct Clip {
    /// File stem or other name, for people.
    pub name: String,
    /// Index into [`DatabaseParts::actions`].
    pub action: u16,
    /// Index into [`DatabaseParts::styles`].
    pub style: u16,
    /// Number of the take.
    pub take: u32,
    /// First row.
    pub first_frame: usize,
    /// Number of rows, at least 1.
    pub frames: usize,
    /// Where the clip comes from.
    pub source: String,
    /// Its licence, empty if unknown.
    pub licence: String,
}

impl Clip {
    /// The clip's rows.
    pub fn rows(&self) -> Range<usize> {
        self.first_frame..self.first_frame + self.frames
    }
}

/// All frames of one action in one style.
#[derive(Clone, Debug, PartialEq)]
pub struct Class {
    /// Index of the action.
    pub action: u16,
    /// Index of the style.
    pub style: u16,
    /// Rows of the class.
    pub rows: Range<usize>,
    /// Clips of the class, as indices into [`DatabaseParts::clips`].
    pub clips: Range<usize>,
}

/// What a database is made of; N rows, S styles, M counterparts.
#[derive(Clone, Debug, PartialEq)]
pub struct DatabaseParts {
    /// Frames per second of every clip.
    pub rate_hz: f32,
    /// Bone offsets of the database's humanoid.
    pub proportions: Proportions,
    /// Centres of the exponential maps.
    pub chart: PoseChart,
    /// Names of the actions.
    pub actions: Vec<String>,
    /// Names of the styles.
    pub styles: Vec<String>,
    /// Index of the neutral style.
    pub neutral: u16,
    /// Clips sorted by (action, style); their rows follow each other without a gap.
    pub clips: Vec<Clip>,
    /// N rows of degrees of freedom; none in the database of a [model](crate::transfer::Model), which holds them on its own.
    pub pose: Vec<PoseRow>,
    /// N heading-free joint positions, metres; none in the database of a [model](crate::transfer::Model).
    pub point_cloud: Vec<[Vec3; JOINTS]>,
    /// N times on the canonical timeline of the action (the neutral reference cycle), in canonical frames.
    pub canonical_time: Vec<f32>,
    /// N durations: seconds per canonical frame, positive.
    pub time_step: Vec<f32>,
    /// N contacts [left, right]: 1 while the foot is planted, else 0.
    pub contact: Vec<[u8; 2]>,
    /// M, at most [`MAX_COUNTERPARTS`].
    pub counterparts_per_style: usize,
    /// N × S × M registered rows as fractional row indices; −1 where there is none. A frame has either
    /// no counterpart in a style or at least one, listed first.
    pub counterpart: Vec<f32>,
}

/// Why parts are no database.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum DatabaseError {
    /// A tensor has another number of rows than the clips say.
    #[error("'{tensor}' has {found} entries; the clips need {expected}")]
    Shape {
        /// Name of the tensor.
        tensor: &'static str,
        /// Entries found.
        found: usize,
        /// Entries expected.
        expected: usize,
    },
    /// Too many or too few of something, or an index outside its table.
    #[error("{0}")]
    Invalid(String),
    /// A tensor holds NaN or infinity, or a value outside its range.
    #[error("'{tensor}' holds {value} at frame {frame}; {expected} was expected")]
    Value {
        /// Name of the tensor.
        tensor: &'static str,
        /// Row of the value.
        frame: usize,
        /// The value.
        value: f32,
        /// What was expected.
        expected: &'static str,
    },
}

/// A validated database. See the module documentation.
#[derive(Clone, Debug)]
pub struct Database {
    parts: DatabaseParts,
    classes: Vec<Class>,
    sigma: PoseRow,
    limits: Box<[PoseRow; 2]>,
}

impl Database {
    /// A database of these parts; every shape, index and value is checked.
    ///
    /// # Errors
    /// See [`DatabaseError`].
    pub fn new(parts: DatabaseParts) -> Result<Self, DatabaseError> {
        let classes = validated_classes(&parts)?;
        validate_tensors(&parts)?;
        let sigma = standard_deviation(&parts.pose);
        let limits = Box::new(observed_range(&parts.pose));
        Ok(Self { parts, classes, sigma, limits })
    }

    /// Forgets the point clouds: a fifth of the memory, of no use once there is a search index.
    pub(crate) fn forget_point_clouds(&mut self) {
        self.parts.point_cloud = Vec::new();
    }

    /// Forgets the rows.
    pub(crate) fn forget_rows(&mut self) {
        self.parts.pose = Vec::new();
    }

    /// Number of rows.
    pub fn frames(&self) -> usize {
        self.parts.time_step.len()
    }

    /// Classes in order of their rows.
    pub fn classes(&self) -> &[Class] {
        &self.classes
    }

    /// Index of the class that a row belongs to.
    ///
    /// # Panics
    /// If `row` is not below [`Database::frames`].
    pub fn class_of_row(&self, row: usize) -> usize {
        assert!(row < self.frames(), "row {row} of {}", self.frames());
        self.classes.partition_point(|c| c.rows.end <= row)
    }

    /// Index of the clip that a row belongs to.
    ///
    /// # Panics
    /// If `row` is not below [`Database::frames`].
    pub fn clip_of_row(&self, row: usize) -> usize {
        assert!(row < self.frames(), "row {row} of {}", self.frames());
        self.parts.clips.partition_point(|c| c.first_frame + c.frames <= row)
    }

    /// Standard deviation of each degree of freedom over all rows, floored at 1e-4; padding is 1.
    pub fn sigma(&self) -> &PoseRow {
        &self.sigma
    }

    /// Least and greatest value of each degree of freedom over all rows.
    pub fn observed_range(&self) -> &[PoseRow; 2] {
        &self.limits
    }

    /// Index of the style of this name.
    pub fn style_index(&self, name: &str) -> Option<u16> {
        self.styles.iter().position(|s| s == name).map(|i| i as u16)
    }

    /// Index of the action of this name.
    pub fn action_index(&self, name: &str) -> Option<u16> {
        self.actions.iter().position(|s| s == name).map(|i| i as u16)
    }

    /// Counterparts of a row in a style: fractional row indices, at most M, none if the style is missing
    /// for the row's action.
    pub fn counterparts(&self, row: usize, style: u16) -> impl Iterator<Item = f32> + '_ {
        let m = self.parts.counterparts_per_style;
        let first = (row * self.parts.styles.len() + usize::from(style)) * m;
        self.parts.counterpart[first..first + m].iter().copied().take_while(|&c| c >= 0.0)
    }
}

impl std::ops::Deref for Database {
    type Target = DatabaseParts;
    fn deref(&self) -> &DatabaseParts {
        &self.parts
    }
}

fn validated_classes(parts: &DatabaseParts) -> Result<Vec<Class>, DatabaseError> {
    let invalid = |s: String| Err(DatabaseError::Invalid(s));
    if !(parts.rate_hz.is_finite() && parts.rate_hz >= 1.0 && parts.rate_hz <= 1000.0) {
        return invalid(format!("the rate is {} Hz; 1 to 1000 was expected", parts.rate_hz));
    }
    if !parts.proportions.is_valid() {
        return invalid("a limb bone has no length, or an offset is not a finite number".into());
    }
    if parts.clips.is_empty() {
        return invalid("it has no clips".into());
    }
    if usize::from(parts.neutral) >= parts.styles.len() {
        return invalid(format!("the neutral style is number {} of {}", parts.neutral, parts.styles.len()));
    }
    if parts.counterparts_per_style == 0 || parts.counterparts_per_style > MAX_COUNTERPARTS {
        return invalid(format!(
            "{} counterparts a style; 1 to {MAX_COUNTERPARTS} were expected",
            parts.counterparts_per_style
        ));
    }
    let mut classes: Vec<Class> = Vec::new();
    let mut rows = 0_usize;
    for (i, clip) in parts.clips.iter().enumerate() {
        if usize::from(clip.action) >= parts.actions.len() || usize::from(clip.style) >= parts.styles.len() {
            return invalid(format!("clip '{}' has an action or style that is not in the lists", clip.name));
        }
        if clip.first_frame != rows || clip.frames == 0 || clip.frames > MAX_FRAMES - rows {
            return invalid(format!("clip '{}' must begin at frame {rows} and have at least one", clip.name));
        }
        rows += clip.frames;
        match classes.last_mut() {
            Some(c) if (c.action, c.style) == (clip.action, clip.style) => {
                c.rows.end = rows;
                c.clips.end = i + 1;
            }
            last => {
                if last.is_some_and(|c| (c.action, c.style) > (clip.action, clip.style)) {
                    return invalid(format!(
                        "clip '{}' is out of order: clips are sorted by action, then style",
                        clip.name
                    ));
                }
                classes.push(Class {
                    action: clip.action,
                    style: clip.style,
                    rows: clip.first_frame..rows,
                    clips: i..i + 1,
                });
            }
        }
    }
    Ok(classes)
}

fn validate_tensors(parts: &DatabaseParts) -> Result<(), DatabaseError> {
    let n = parts.clips.last().map_or(0, |c| c.first_frame + c.frames);
    let shape = |tensor, found: usize, expected: usize| {
        if found == expected { Ok(()) } else { Err(DatabaseError::Shape { tensor, found, expected }) }
    };
    shape("pose", parts.pose.len(), n)?;
    shape("point_cloud", parts.point_cloud.len(), n)?;
    shape("canonical_time", parts.canonical_time.len(), n)?;
    shape("time_step", parts.time_step.len(), n)?;
    shape("contact", parts.contact.len(), n)?;
    shape("counterpart", parts.counterpart.len(), n * parts.styles.len() * parts.counterparts_per_style)?;

    let bad = |tensor, frame, value, expected| Err(DatabaseError::Value { tensor, frame, value, expected });
    for frame in 0..n {
        if let Some(v) = first_beyond(&parts.pose[frame], 1e4) {
            return bad("pose", frame, v, "a number below 10 000");
        }
        if let Some(v) = first_beyond(bytemuck::cast_slice(&parts.point_cloud[frame]), 1e3) {
            return bad("point_cloud", frame, v, "a position within 1 km");
        }
        let (t, w) = (parts.canonical_time[frame], parts.time_step[frame]);
        if !t.is_finite() {
            return bad("canonical_time", frame, t, "a finite number");
        }
        if !(w > 0.0 && w < 10.0) {
            return bad("time_step", frame, w, "a duration between 0 and 10 s");
        }
        if let Some(&c) = parts.contact[frame].iter().find(|&&c| c > 1) {
            return bad("contact", frame, f32::from(c), "0 or 1");
        }
    }
    let per_frame = parts.styles.len() * parts.counterparts_per_style;
    let last_row = (n - 1) as f32;
    for (i, &c) in parts.counterpart.iter().enumerate() {
        if c != -1.0 && !(c >= 0.0 && c <= last_row) {
            return bad("counterpart", i / per_frame, c, "a row of the database, or −1");
        }
    }
    Ok(())
}

/// The first value that is no number or whose size is not below `limit`.
#[inline(never)] // In WebAssembly a function becomes fast once it has been called often.
fn first_beyond(values: &[f32], limit: f32) -> Option<f32> {
    let within = |v: f32| v.abs() < limit;
    // Good values are the rule: without a way out of the loop, several are looked at together.
    if values.iter().fold(true, |good, &v| good & within(v)) {
        return None;
    }
    values.iter().copied().find(|&v| !within(v))
}

fn standard_deviation(rows: &[PoseRow]) -> PoseRow {
    let n = rows.len().max(1) as f64;
    let mut mean = [0.0_f64; ROW];
    for row in rows {
        add(row, &mut mean);
    }
    let mean = mean.map(|sum| sum / n);
    let mut variance = [0.0_f64; ROW];
    for row in rows {
        add_squared_differences(row, &mean, &mut variance);
    }
    std::array::from_fn(|d| if d < DOFS { ((variance[d] / n).sqrt() as f32).max(1e-4) } else { 1.0 })
}

#[inline(never)] // see `first_beyond`
fn add(row: &PoseRow, sums: &mut [f64; ROW]) {
    sums.iter_mut().zip(row).for_each(|(sum, &v)| *sum += f64::from(v));
}

#[inline(never)] // see `first_beyond`
fn add_squared_differences(row: &PoseRow, mean: &[f64; ROW], sums: &mut [f64; ROW]) {
    for ((sum, mean), &v) in sums.iter_mut().zip(mean).zip(row) {
        let difference = f64::from(v) - mean;
        *sum += difference * difference;
    }
}

fn observed_range(rows: &[PoseRow]) -> [PoseRow; 2] {
    let mut range = [[0.0; ROW]; 2];
    if let Some(first) = rows.first() {
        range = [*first; 2];
    }
    for row in rows {
        widen(&mut range, row);
    }
    range
}

#[inline(never)] // see `first_beyond`
fn widen([least, greatest]: &mut [PoseRow; 2], row: &PoseRow) {
    for ((least, greatest), &v) in least.iter_mut().zip(greatest).zip(row) {
        *least = least.min(v);
        *greatest = greatest.max(v);
    }
}
