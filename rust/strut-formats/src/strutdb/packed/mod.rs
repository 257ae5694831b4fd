//! A database and a few motions in a tenth of the size: the format in which the page loads the built-in motions.
//!
//! Derived data are omitted (point clouds follow from rows), numbers become multiples of a step, and columns become
//! second differences, most of which are small. The file is intended to be sent compressed with Deflate:
//!
//! | Bytes | Content |
//! | --- | --- |
//! | 8 | [`MAGIC`]; its last character is the version |
//! | | header, see below |
//! | | inputs: for each its poses by columns, root x y z in metres, then the rotation vectors of the joints, [`STEP`] |
//! | | `pose` of the database by columns, [`STEP`] |
//! | | `canonical_time`, [`TIME_STEP`]; `time_step`, [`DURATION_STEP`]; `contact` by columns, 1 |
//! | | `counterpart` by columns (style, then slot), [`ROW_STEP`]; −1 where there is none |
//!
//! A file may contain several such sets in sequence; its content is that of the last. Inputs, and the first frames of
//! clips, that are in the previous set are identified by their names, and their poses are not stored again. So the page
//! can show the first set while the next one loads.
//!
//! A column of integers x is stored as xₜ − 2 xₜ₋₁ + xₜ₋₂, with zeros before the first, each in zigzag LEB128.
//!
//! The error of rotations is at most 5e-5 rad, half a step per axis. The error of joint positions is at most 0.09 mm in
//! the built-in database, and at most 0.11 mm in the built-in inputs.

mod header;
mod numbers;

use super::StrutdbError;
use header::{Header, InputInfo};
use numbers::{Reader, write_column};
use strut_core::database::{Clip, Database, DatabaseParts};
use strut_core::humanoid::{HumanoidMotion, JOINTS, Pose, Proportions};
use strut_core::math::{Quat, Vec3, exp_map};
use strut_core::pose_vector::{DOFS, Placement, PoseChart, PoseRow, ROW, point_cloud};

/// First bytes of packed motions.
pub const MAGIC: [u8; 8] = *b"strutpk3";
/// Step of rotations, radians, of lengths, metres, and of their rates per second.
pub const STEP: f32 = 1.0 / 16_384.0;
/// Step of canonical time, canonical frames.
pub const TIME_STEP: f32 = 1.0 / 256.0;
/// Step of the seconds per canonical frame.
pub const DURATION_STEP: f32 = 1.0 / 1_048_576.0;
/// Step of counterparts, rows.
pub const ROW_STEP: f32 = 1.0 / 256.0;

/// Number of columns of an input: the root, and a rotation vector for each joint.
const INPUT_COLUMNS: usize = 3 + 3 * JOINTS;

/// A motion with a display name.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedMotion {
    /// For example "neutral walk".
    pub name: String,
    /// The motion.
    pub motion: HumanoidMotion,
}

/// Packs a database with motions on its humanoid and at its rate.
///
/// # Panics
/// Never for a [`Database`], whose shapes were checked when it was created.
pub fn write(db: &Database, inputs: &[NamedMotion]) -> Vec<u8> {
    let mut file = Vec::new();
    write_set(&mut file, db, inputs, &Known::default());
    file
}

/// Appends a set to packed motions. Inputs with the names of inputs of the last set are taken from it, and clips start
/// with the frames that it contains.
///
/// # Errors
/// [`StrutdbError`] if `file` does not contain packed motions, or if a clip of the same name is shorter or has another
/// chart.
pub fn append(file: &mut Vec<u8>, db: &Database, inputs: &[NamedMotion]) -> Result<(), StrutdbError> {
    let known = known_at_end(&sets(file)?)?;
    known.check(&db.clips, &db.chart)?;
    write_set(file, db, inputs, &known);
    Ok(())
}

fn write_set(file: &mut Vec<u8>, db: &Database, inputs: &[NamedMotion], known: &Known) {
    let columns = columns_of(db, inputs, known);
    let info = |input: &NamedMotion| InputInfo { name: input.name.clone(), frames: input.motion.poses.len() };
    let infos: Vec<_> = inputs.iter().map(info).collect();
    file.extend(MAGIC);
    file.extend(header::write(db, &infos, columns.len()));
    file.extend(columns);
}

fn columns_of(db: &Database, inputs: &[NamedMotion], known: &Known) -> Vec<u8> {
    let mut bytes = Vec::new();
    for input in inputs.iter().filter(|input| !known.has_input(&input.name)) {
        let rows: Vec<[f32; INPUT_COLUMNS]> = input.motion.poses.iter().map(row_of).collect();
        (0..INPUT_COLUMNS).for_each(|c| write_column(&mut bytes, STEP, rows.iter().map(|row| row[c])));
    }
    let own = || db.clips.iter().flat_map(|clip| &db.pose[clip.rows()][known.frames_of(&clip.name)..]);
    (0..DOFS).for_each(|d| write_column(&mut bytes, STEP, own().map(|row| row[d])));
    write_column(&mut bytes, TIME_STEP, db.canonical_time.iter().copied());
    write_column(&mut bytes, DURATION_STEP, db.time_step.iter().copied());
    (0..2).for_each(|foot| write_column(&mut bytes, 1.0, db.contact.iter().map(|c| f32::from(c[foot]))));
    let columns = db.styles.len() * db.counterparts_per_style;
    for c in 0..columns {
        write_column(&mut bytes, ROW_STEP, db.counterpart.iter().skip(c).step_by(columns).copied());
    }
    bytes
}

/// Names of the motions that are stored with the database.
///
/// # Errors
/// [`StrutdbError`] if the bytes are not packed motions.
pub fn input_names(bytes: &[u8]) -> Result<Vec<String>, StrutdbError> {
    let last = sets(bytes)?.pop();
    Ok(last.into_iter().flat_map(|set| set.header.inputs).map(|i| i.name).collect())
}

/// Motion of this name; `None` if there is none.
///
/// # Errors
/// [`StrutdbError`] if the bytes are not packed motions.
pub fn read_input(bytes: &[u8], name: &str) -> Result<Option<HumanoidMotion>, StrutdbError> {
    let mut known = Known::default();
    for Set { header, mut columns } in sets(bytes)? {
        for input in header.inputs.iter().filter(|input| !known.has_input(&input.name)) {
            if input.name != name {
                columns.skip(input.frames, INPUT_COLUMNS)?;
                continue;
            }
            let rows = columns.rows::<INPUT_COLUMNS>(input.frames, INPUT_COLUMNS, STEP)?;
            let Header { proportions, rate_hz, .. } = header;
            return Ok(Some(HumanoidMotion { proportions, rate_hz, poses: rows.iter().map(pose_of).collect() }));
        }
        known.inputs = header.inputs;
    }
    Ok(None)
}

/// Reads the database.
///
/// # Errors
/// [`StrutdbError`] if the bytes are not packed motions.
pub fn read_database(bytes: &[u8]) -> Result<Database, StrutdbError> {
    let mut sets = sets(bytes)?;
    let last = sets.pop().ok_or(StrutdbError::NotPacked)?;
    let Set { header, mut columns } = last;
    let Known { pose, .. } = known_at_end(&sets)?.after(&header, &mut columns)?;
    let Header { proportions, chart, counterparts_per_style, .. } = header;
    let n = pose.len();
    let canonical_time = columns.column(n, TIME_STEP)?.collect();
    let time_step = columns.column(n, DURATION_STEP)?.collect();
    let contact = columns.rows::<2>(n, 2, 1.0)?.into_iter().map(|c| c.map(|planted| planted as u8)).collect();
    let per_frame = header.styles.len() * counterparts_per_style;
    columns.expect(n.saturating_mul(per_frame))?;
    let mut counterpart = vec![0.0; n * per_frame];
    for c in 0..per_frame {
        let places = counterpart.iter_mut().skip(c).step_by(per_frame);
        places.zip(columns.column(n, ROW_STEP)?).for_each(|(place, row)| *place = row);
    }
    let parts = DatabaseParts {
        rate_hz: header.rate_hz,
        proportions,
        chart,
        neutral: header.neutral,
        point_cloud: pose.iter().map(|row| cloud_of(&proportions, &chart, row)).collect(),
        actions: header.actions,
        styles: header.styles,
        clips: header.clips,
        pose,
        canonical_time,
        time_step,
        contact,
        counterparts_per_style,
        counterpart,
    };
    Ok(Database::new(parts)?)
}

/// A set: its header, and the columns after it.
struct Set<'a> {
    header: Header,
    columns: Reader<'a>,
}

/// All sets of a file, at least one.
fn sets(bytes: &[u8]) -> Result<Vec<Set<'_>>, StrutdbError> {
    let mut sets = Vec::new();
    let mut rest = bytes;
    while sets.is_empty() || !rest.is_empty() {
        let (set, after) = open(rest)?;
        sets.push(set);
        rest = after;
    }
    Ok(sets)
}

/// The first set of these bytes, and the bytes after it.
fn open(bytes: &[u8]) -> Result<(Set<'_>, &[u8]), StrutdbError> {
    let rest = bytes.strip_prefix(&MAGIC).ok_or(StrutdbError::NotPacked)?;
    let mut rest = Reader { rest };
    let header = header::read(&mut rest)?;
    let columns = Reader { rest: rest.bytes(header.bytes)? };
    Ok((Set { header, columns }, rest.rest))
}

/// Data that the next set need not store.
#[derive(Default)]
struct Known {
    inputs: Vec<InputInfo>,
    clips: Vec<Clip>,
    /// Centres of the exponential maps of `pose`; `None` before the first set.
    chart: Option<PoseChart>,
    pose: Vec<PoseRow>,
}

impl Known {
    fn has_input(&self, name: &str) -> bool {
        self.inputs.iter().any(|input| input.name == name)
    }

    fn clip(&self, name: &str) -> Option<&Clip> {
        self.clips.iter().find(|clip| clip.name == name)
    }

    /// Number of the clip's first frames that are known.
    fn frames_of(&self, name: &str) -> usize {
        self.clip(name).map_or(0, |clip| clip.frames)
    }

    /// Rejects clips that do not continue the known ones.
    fn check(&self, clips: &[Clip], chart: &PoseChart) -> Result<(), StrutdbError> {
        if self.chart.is_some_and(|known| known != *chart) {
            return Err(StrutdbError::Layout("joints"));
        }
        if clips.iter().any(|clip| self.frames_of(&clip.name) > clip.frames) {
            Err(StrutdbError::Layout("clips"))
        } else {
            Ok(())
        }
    }

    /// Reads the poses of the next set. `columns` are then at the data after them.
    fn after(self, header: &Header, columns: &mut Reader<'_>) -> Result<Self, StrutdbError> {
        let Header { clips, chart, .. } = header;
        self.check(clips, chart)?;
        let n = clips.iter().map(|clip| clip.frames).sum::<usize>();
        for input in header.inputs.iter().filter(|input| !self.has_input(&input.name)) {
            columns.skip(input.frames, INPUT_COLUMNS)?;
        }
        let taken: usize = clips.iter().map(|clip| self.frames_of(&clip.name)).sum();
        if taken > self.pose.len() {
            return Err(StrutdbError::Layout("clips"));
        }
        let mut own = columns.rows::<ROW>(n - taken, DOFS, STEP)?.into_iter();
        let mut pose = Vec::with_capacity(n);
        for clip in clips {
            let known = self.clip(&clip.name).map_or(0..0, Clip::rows);
            pose.extend_from_slice(&self.pose[known.clone()]);
            pose.extend(own.by_ref().take(clip.frames - known.len()));
        }
        Ok(Self { inputs: header.inputs.clone(), clips: clips.clone(), chart: Some(*chart), pose })
    }
}

/// Data that are known after these sets.
fn known_at_end(sets: &[Set<'_>]) -> Result<Known, StrutdbError> {
    let next = |known: Known, set: &Set<'_>| known.after(&set.header, &mut set.columns.clone());
    sets.iter().try_fold(Known::default(), next)
}

fn row_of(pose: &Pose) -> [f32; INPUT_COLUMNS] {
    let mut row = [0.0; INPUT_COLUMNS];
    row[..3].copy_from_slice(&pose.root.to_array());
    for (vector, q) in row[3..].chunks_exact_mut(3).zip(&pose.rotations) {
        vector.copy_from_slice(&exp_map::log(*q).to_array());
    }
    row
}

fn pose_of(row: &[f32; INPUT_COLUMNS]) -> Pose {
    let mut pose = Pose { root: Vec3::from_slice(&row[..3]), rotations: [Quat::IDENTITY; JOINTS] };
    for (q, vector) in pose.rotations.iter_mut().zip(row[3..].chunks_exact(3)) {
        *q = exp_map::exp(Vec3::from_slice(vector));
    }
    pose
}

fn cloud_of(proportions: &Proportions, chart: &PoseChart, row: &PoseRow) -> [Vec3; JOINTS] {
    point_cloud(proportions, &chart.decode(row, Placement::default()), 0.0)
}
