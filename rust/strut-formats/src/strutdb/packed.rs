//! A database and a few motions in a tenth of the bytes: the format in which the page loads the built-in motions.
//!
//! Derived data are left out (point clouds follow from rows), numbers become multiples of a step, and columns become
//! second differences, most of which are small. The file is meant to be sent deflated:
//!
//! | Bytes | Content |
//! | --- | --- |
//! | 8 | [`MAGIC`]; its last character is the version |
//! | 4 | length of the header, little-endian |
//! | | header: a JSON object, see `Header` |
//! | | inputs: for each its poses by columns, root x y z in metres, then the rotation vectors of the joints, [`STEP`] |
//! | | `pose` of the database by columns, [`STEP`] |
//! | | `canonical_time`, [`TIME_STEP`]; `time_step`, [`DURATION_STEP`]; `contact` by columns, 1 |
//! | | `counterpart` by columns (style, then slot), [`ROW_STEP`]; −1 where there is none |
//!
//! A file may have several such sets, one after the other; its content is that of the last. Inputs and the beginnings of clips
//! that were in the set before are told by their names, and their poses are not stored again: so the page shows the first set
//! while the next one loads.
//!
//! A column of integers x is stored as xₜ − 2 xₜ₋₁ + xₜ₋₂, with zeros before the first, each in zigzag LEB128.
//!
//! Rotations are off by at most 5e-5 rad (half a step an axis): no joint of the built-in database is off by more than
//! 0.09 mm, none of the built-in inputs by more than 0.11 mm.

use super::metadata::Metadata;
use super::{KIND, StrutdbError, read};
use crate::container::ContainerError;
use serde::{Deserialize, Serialize};
use strut_core::database::{Clip, Database, DatabaseParts, MAX_COUNTERPARTS, MAX_FRAMES};
use strut_core::humanoid::{HumanoidMotion, JOINTS, Pose, Proportions};
use strut_core::math::{Quat, Vec3, exp_map};
use strut_core::pose_vector::{DOFS, Placement, PoseChart, PoseRow, ROW, point_cloud};

/// First bytes of packed motions.
pub const MAGIC: [u8; 8] = *b"strutpk2";
/// Step of rotations, radians, of lengths, metres, and of their rates a second.
pub const STEP: f32 = 1.0 / 16_384.0;
/// Step of canonical time, canonical frames.
pub const TIME_STEP: f32 = 1.0 / 256.0;
/// Step of the seconds per canonical frame.
pub const DURATION_STEP: f32 = 1.0 / 1_048_576.0;
/// Step of counterparts, rows.
pub const ROW_STEP: f32 = 1.0 / 256.0;

/// Columns of an input: the root and a rotation vector a joint.
const INPUT_COLUMNS: usize = 3 + 3 * JOINTS;

/// The header, in JSON.
#[derive(Serialize, Deserialize)]
struct Header {
    /// As in a `.strutdb`; there is no checksum.
    database: Metadata,
    /// Centres of the exponential maps, x y z w.
    chart: Vec<[f64; 4]>,
    counterparts_per_style: usize,
    /// Motions on the database's humanoid and at its rate, in order.
    inputs: Vec<InputInfo>,
    /// Length of the columns after the header, bytes.
    bytes: usize,
}

#[derive(Clone, Serialize, Deserialize)]
struct InputInfo {
    name: String,
    frames: usize,
}

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
/// Never for a [`Database`], whose shapes were checked when it was made.
pub fn write(db: &Database, inputs: &[NamedMotion], generator: &str) -> Vec<u8> {
    let mut file = Vec::new();
    write_set(&mut file, db, inputs, generator, &Known::default());
    file
}

/// Appends a set to packed motions: inputs of the same names are those of the last set, and clips begin with what it has of
/// them.
///
/// # Errors
/// [`StrutdbError`] if `file` is anything but packed motions, or if a clip of the same name is shorter or has another chart.
pub fn append(file: &mut Vec<u8>, db: &Database, inputs: &[NamedMotion], generator: &str) -> Result<(), StrutdbError> {
    let known = known_at_end(&sets(file)?)?;
    known.check(&db.clips, &db.chart)?;
    write_set(file, db, inputs, generator, &known);
    Ok(())
}

fn write_set(file: &mut Vec<u8>, db: &Database, inputs: &[NamedMotion], generator: &str, known: &Known) {
    let columns = columns_of(db, inputs, known);
    let header = Header {
        database: Metadata::of(db, generator),
        chart: db.chart.means.iter().map(|q| q.to_array().map(f64::from)).collect(),
        counterparts_per_style: db.counterparts_per_style,
        inputs: inputs.iter().map(|i| InputInfo { name: i.name.clone(), frames: i.motion.poses.len() }).collect(),
        bytes: columns.len(),
    };
    let header = serde_json::to_vec(&header).expect("strings and numbers are JSON");
    file.extend(MAGIC);
    file.extend((header.len() as u32).to_le_bytes());
    file.extend(header);
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

/// Names of the motions beside the database.
///
/// # Errors
/// [`StrutdbError`] for anything but packed motions.
pub fn input_names(bytes: &[u8]) -> Result<Vec<String>, StrutdbError> {
    let last = sets(bytes)?.pop();
    Ok(last.into_iter().flat_map(|set| set.header.inputs).map(|i| i.name).collect())
}

/// The motion of this name; `None` if there is none.
///
/// # Errors
/// [`StrutdbError`] for anything but packed motions.
pub fn read_input(bytes: &[u8], name: &str) -> Result<Option<HumanoidMotion>, StrutdbError> {
    let mut known = Known::default();
    for Set { header, mut columns } in sets(bytes)? {
        for input in header.inputs.iter().filter(|input| !known.has_input(&input.name)) {
            if input.name != name {
                columns.skip(input.frames, INPUT_COLUMNS)?;
                continue;
            }
            let rows = columns.rows::<INPUT_COLUMNS>(input.frames, INPUT_COLUMNS, STEP)?;
            let (proportions, rate_hz) = (proportions(&header)?, header.database.rate_hz);
            return Ok(Some(HumanoidMotion { proportions, rate_hz, poses: rows.iter().map(pose_of).collect() }));
        }
        known.inputs = header.inputs;
    }
    Ok(None)
}

/// The database.
///
/// # Errors
/// [`StrutdbError`] for anything but packed motions.
pub fn read_database(bytes: &[u8]) -> Result<Database, StrutdbError> {
    let mut sets = sets(bytes)?;
    let last = sets.pop().ok_or(StrutdbError::NotPacked)?;
    let Set { header, mut columns } = last;
    let (proportions, chart) = (proportions(&header)?, chart(&header)?);
    let Known { clips, pose, .. } = known_at_end(&sets)?.after(&header, &mut columns)?;
    let Header { database: metadata, counterparts_per_style, .. } = header;
    if counterparts_per_style > MAX_COUNTERPARTS {
        return Err(StrutdbError::Layout("counterparts"));
    }
    let n = pose.len();
    let canonical_time = columns.column(n, TIME_STEP)?.collect();
    let time_step = columns.column(n, DURATION_STEP)?.collect();
    let contact = columns.rows::<2>(n, 2, 1.0)?.into_iter().map(|c| c.map(|planted| planted as u8)).collect();
    let per_frame = metadata.styles.len() * counterparts_per_style;
    columns.expect(n.saturating_mul(per_frame))?;
    let mut counterpart = vec![0.0; n * per_frame];
    for c in 0..per_frame {
        let places = counterpart.iter_mut().skip(c).step_by(per_frame);
        places.zip(columns.column(n, ROW_STEP)?).for_each(|(place, row)| *place = row);
    }
    let parts = DatabaseParts {
        rate_hz: metadata.rate_hz,
        proportions,
        chart,
        neutral: read::index_of(&metadata.styles, &metadata.neutral, "style")?,
        point_cloud: pose.iter().map(|row| cloud_of(&proportions, &chart, row)).collect(),
        actions: metadata.actions,
        styles: metadata.styles,
        clips,
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
    columns: Columns<'a>,
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
    let (length, rest) = rest.split_first_chunk::<4>().ok_or(ContainerError::Length)?;
    let (json, rest) = rest.split_at_checked(u32::from_le_bytes(*length) as usize).ok_or(ContainerError::Length)?;
    let header: Header =
        serde_json::from_slice(json).map_err(|e| ContainerError::Metadata { kind: KIND, reason: e.to_string() })?;
    if header.database.version != KIND.version {
        let found = header.database.version.chars().take(20).collect();
        return Err(ContainerError::Version { kind: KIND, found }.into());
    }
    let (columns, after) = rest.split_at_checked(header.bytes).ok_or(ContainerError::Length)?;
    Ok((Set { header, columns: Columns { rest: columns } }, after))
}

/// What the next set need not store.
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

    /// Frames at the beginning of a clip.
    fn frames_of(&self, name: &str) -> usize {
        self.clip(name).map_or(0, |clip| clip.frames)
    }

    /// Refuses clips that are not what they are here.
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

    /// Reads the poses of the next set; `columns` are left at those after them.
    fn after(self, header: &Header, columns: &mut Columns<'_>) -> Result<Self, StrutdbError> {
        let chart = chart(header)?;
        let clips = read::clips(&header.database)?;
        self.check(&clips, &chart)?;
        let n = read::frames_of(&clips)?;
        for input in header.inputs.iter().filter(|input| !self.has_input(&input.name)) {
            columns.skip(input.frames, INPUT_COLUMNS)?;
        }
        let taken: usize = clips.iter().map(|clip| self.frames_of(&clip.name)).sum();
        if taken > self.pose.len() {
            return Err(StrutdbError::Layout("clips"));
        }
        let mut own = columns.rows::<ROW>(n - taken, DOFS, STEP)?.into_iter();
        let mut pose = Vec::with_capacity(n);
        for clip in &clips {
            if clip.first_frame != pose.len() {
                return Err(StrutdbError::Layout("clips"));
            }
            let known = self.clip(&clip.name).map_or(0..0, Clip::rows);
            pose.extend_from_slice(&self.pose[known.clone()]);
            pose.extend(own.by_ref().take(clip.frames - known.len()));
        }
        Ok(Self { inputs: header.inputs.clone(), clips, chart: Some(chart), pose })
    }
}

/// What is known after these sets.
fn known_at_end(sets: &[Set<'_>]) -> Result<Known, StrutdbError> {
    let next = |known: Known, set: &Set<'_>| known.after(&set.header, &mut Columns { rest: set.columns.rest });
    sets.iter().try_fold(Known::default(), next)
}

fn chart(header: &Header) -> Result<PoseChart, StrutdbError> {
    let chart: Vec<f32> = header.chart.iter().flatten().map(|&v| v as f32).collect();
    if chart.len() != 4 * JOINTS {
        return Err(StrutdbError::Layout("joints"));
    }
    read::unit_chart(&chart)
}

fn proportions(header: &Header) -> Result<Proportions, StrutdbError> {
    header.database.skeleton.proportions().ok_or(StrutdbError::Layout("joints"))
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

/// Appends a column.
fn write_column(file: &mut Vec<u8>, step: f32, values: impl Iterator<Item = f32>) {
    let [mut before, mut last] = [0_i32; 2];
    for value in values {
        let now = (f64::from(value) / f64::from(step)).round() as i32;
        let difference = now.wrapping_sub(last.wrapping_mul(2)).wrapping_add(before);
        let mut zigzag = ((difference << 1) ^ (difference >> 31)) as u32;
        while zigzag > 0x7F {
            file.push(zigzag as u8 | 0x80);
            zigzag >>= 7;
        }
        file.push(zigzag as u8);
        [before, last] = [last, now];
    }
}

/// Columns not yet read.
struct Columns<'a> {
    rest: &'a [u8],
}

impl Columns<'_> {
    /// Refuses to allocate for more numbers than the remaining bytes can hold, at least one byte each.
    fn expect(&self, numbers: usize) -> Result<(), ContainerError> {
        if numbers > self.rest.len() { Err(ContainerError::Length) } else { Ok(()) }
    }

    /// The next column of `n` numbers.
    fn column(&mut self, n: usize, step: f32) -> Result<impl Iterator<Item = f32> + use<>, ContainerError> {
        self.expect(n)?;
        let mut numbers = Vec::with_capacity(n);
        let [mut before, mut last] = [0_i32; 2];
        for _ in 0..n {
            let zigzag = self.number()?;
            let difference = (zigzag >> 1) as i32 ^ -((zigzag & 1) as i32);
            let now = difference.wrapping_add(last.wrapping_mul(2)).wrapping_sub(before);
            numbers.push(now as f32 * step);
            [before, last] = [last, now];
        }
        Ok(numbers.into_iter())
    }

    /// The next `columns` columns as `n` rows; the padding of rows is zero.
    fn rows<const R: usize>(&mut self, n: usize, columns: usize, step: f32) -> Result<Vec<[f32; R]>, ContainerError> {
        self.expect(n.saturating_mul(columns))?;
        let mut rows = vec![[0.0; R]; n];
        for c in 0..columns {
            rows.iter_mut().zip(self.column(n, step)?).for_each(|(row, number)| row[c] = number);
        }
        Ok(rows)
    }

    fn skip(&mut self, n: usize, columns: usize) -> Result<(), ContainerError> {
        (0..n.min(MAX_FRAMES) * columns).try_for_each(|_| self.number().map(drop))
    }

    /// One number in LEB128, of at most 32 bits.
    fn number(&mut self) -> Result<u32, ContainerError> {
        let mut number = 0;
        for shift in (0..32).step_by(7) {
            let (&byte, rest) = self.rest.split_first().ok_or(ContainerError::Length)?;
            self.rest = rest;
            number |= u32::from(byte & 0x7F) << shift;
            if byte < 0x80 {
                return Ok(number);
            }
        }
        Err(ContainerError::Length)
    }
}
