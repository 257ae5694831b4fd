//! Bytes to [`Database`]; trusts nothing.

use super::metadata::{Metadata, pose_columns};
use super::{MAX_BYTES, MAX_CLIPS, Source, StrutdbError, VERSION, checksum};
use bytemuck::Pod;
use safetensors::tensor::{Dtype, Metadata as Header};
use serde::Deserialize;
use strut_core::database::{Clip, Database, DatabaseError, DatabaseParts, MAX_COUNTERPARTS, MAX_FRAMES};
use strut_core::humanoid::JOINTS;
use strut_core::math::Quat;
use strut_core::pose_vector::{DOFS, PoseChart, PoseRow, ROW};
use strut_core::search::{Index, Plan};

/// What is in a file.
#[derive(Clone, Debug)]
pub struct Contents {
    /// The database.
    pub database: Database,
    /// The plan of its search index; `None` if there is none of this version. Whether it is one for the database
    /// [`Index::from_plan`] finds out.
    pub plan: Option<Plan>,
}

impl Contents {
    /// The index of the plan, if there is a good one; it takes the place of the database's point clouds.
    pub fn planned_index(&mut self) -> Option<Index> {
        Index::from_plan(&mut self.database, self.plan.take()?).ok()
    }
}

/// Reads a file.
///
/// # Errors
/// [`StrutdbError`] for anything but an undamaged database of this major version.
pub fn read<S: Source + ?Sized>(file: &S) -> Result<Contents, StrutdbError> {
    let (metadata, tensors) = open(file)?;
    let proportions = metadata.skeleton.proportions().ok_or(StrutdbError::Layout("joints"))?;
    if metadata.pose_columns != pose_columns() {
        return Err(StrutdbError::Layout("degrees of freedom"));
    }
    let clips = clips(&metadata)?;
    let n = Some(frames_of(&clips)?);

    let f32s = |name, shape: &[Option<usize>]| tensors.find(name, Dtype::F32, shape);
    let pose = f32s("pose", &[n, Some(DOFS)])?.rows();
    let point_cloud = f32s("point_cloud", &[n, Some(JOINTS), Some(3)])?.numbers();
    let canonical_time = f32s("canonical_time", &[n])?.numbers();
    let time_step = f32s("time_step", &[n])?.numbers();
    let contact = tensors.find("contact", Dtype::U8, &[n, Some(2)])?.numbers();
    let classes: Vec<[u16; 2]> = tensors.find("class_of_clip", Dtype::U16, &[Some(clips.len()), Some(2)])?.numbers();
    let counterpart = f32s("counterpart", &[n, Some(metadata.styles.len()), None])?;
    let counterparts_per_style = counterpart.shape[2];
    if counterparts_per_style > MAX_COUNTERPARTS {
        return Err(invalid(format!("{counterparts_per_style} counterparts a style")));
    }
    let counterpart = counterpart.numbers();
    let chart: Vec<f32> = f32s("chart", &[Some(JOINTS), Some(4)])?.numbers();
    let order = tensors.find("search_order", Dtype::U32, &[None]).map(|tensor| tensor.numbers());
    let bases = f32s("search_basis", &[Some(2), Some(Plan::BASIS_LENGTH)]).map(|tensor| tensor.halves());
    let points = tensors.find("search_points", Dtype::I16, &[Some(2), None, Some(Plan::COORDINATES)]);
    let points = points.map(|tensor| tensor.halves());

    if !clips.iter().zip(classes).all(|(clip, class)| [clip.action, clip.style] == class) {
        return Err(invalid("'class_of_clip' and the clips' actions and styles differ".into()));
    }
    let plan = match (metadata.search_version, order, bases, points) {
        (Some(Plan::VERSION), Ok(order), Ok(bases), Ok(points)) => Some(Plan { order, bases, points }),
        _ => None,
    };
    let parts = DatabaseParts {
        rate_hz: metadata.rate_hz,
        proportions,
        chart: unit_chart(&chart)?,
        neutral: index_of(&metadata.styles, &metadata.neutral, "style")?,
        actions: metadata.actions,
        styles: metadata.styles,
        clips,
        pose,
        point_cloud,
        canonical_time,
        time_step,
        contact,
        counterparts_per_style,
        counterpart,
    };
    Ok(Contents { database: Database::new(parts)?, plan })
}

/// Reads the metadata alone, once version and checksum are found right.
///
/// # Errors
/// [`StrutdbError`] for a damaged file, one of another version, or none at all.
pub fn read_metadata<S: Source + ?Sized>(file: &S) -> Result<Metadata, StrutdbError> {
    open(file).map(|(metadata, _)| metadata)
}

/// The metadata and the tensors of an undamaged file.
fn open<S: Source + ?Sized>(file: &S) -> Result<(Metadata, Tensors<'_, S>), StrutdbError> {
    #[derive(Deserialize)]
    struct Version {
        version: String,
    }
    if file.len() > MAX_BYTES {
        return Err(StrutdbError::TooManyBytes { bytes: file.len() });
    }
    let beginning = beginning(file).ok_or(StrutdbError::NotSafetensors)?;
    let header: Header =
        serde_json::from_slice(&beginning[LENGTH_BYTES..]).map_err(|_| StrutdbError::NotSafetensors)?;
    if header.data_len().checked_add(beginning.len()) != Some(file.len()) {
        return Err(StrutdbError::Length);
    }
    let json = header.metadata().as_ref().and_then(|m| m.get("strut")).ok_or(StrutdbError::NoMetadata)?;
    let unreadable = |e: serde_json::Error| StrutdbError::Metadata(e.to_string());
    let Version { version } = serde_json::from_str(json).map_err(unreadable)?;
    let major = |v: &str| v.split('.').next().and_then(|major| major.parse::<u32>().ok());
    if major(&version) != major(VERSION) {
        return Err(StrutdbError::Version { found: version.chars().take(20).collect() });
    }
    let metadata: Metadata = serde_json::from_str(json).map_err(unreadable)?;
    let found: String = metadata.checksum.chars().take(20).collect();
    let computed = checksum::compute(&beginning, file).unwrap_or_default();
    if found != computed {
        return Err(StrutdbError::Checksum { found, computed });
    }
    Ok((metadata, Tensors { header, start: beginning.len(), file }))
}

/// Bytes that hold the length of the header.
const LENGTH_BYTES: usize = 8;

/// The file up to the end of its header, if it is that long.
fn beginning<S: Source + ?Sized>(file: &S) -> Option<Vec<u8>> {
    let mut length = [0; LENGTH_BYTES];
    if file.len() < LENGTH_BYTES {
        return None;
    }
    file.copy(0, &mut length);
    let end = usize::try_from(u64::from_le_bytes(length)).ok()?.checked_add(LENGTH_BYTES)?;
    if end > file.len() {
        return None;
    }
    let mut beginning = vec![0; end];
    file.copy(0, &mut beginning);
    Some(beginning)
}

pub(super) fn clips(metadata: &Metadata) -> Result<Vec<Clip>, StrutdbError> {
    if metadata.clips.len() > MAX_CLIPS {
        return Err(invalid(format!("{} clips; at most {MAX_CLIPS} are supported", metadata.clips.len())));
    }
    let clip = |c: &super::ClipInfo| -> Result<Clip, StrutdbError> {
        Ok(Clip {
            name: c.name.clone(),
            action: index_of(&metadata.actions, &c.action, "action")?,
            style: index_of(&metadata.styles, &c.style, "style")?,
            take: c.take,
            first_frame: c.first_frame,
            frames: c.frames,
            source: c.source.clone(),
            licence: c.licence.clone(),
        })
    };
    metadata.clips.iter().map(clip).collect()
}

/// Frames of all clips.
pub(super) fn frames_of(clips: &[Clip]) -> Result<usize, StrutdbError> {
    let frames = clips.iter().try_fold(0_usize, |n, c| n.checked_add(c.frames).filter(|&n| n <= MAX_FRAMES));
    frames.ok_or_else(|| invalid(format!("more than {MAX_FRAMES} frames")))
}

pub(super) fn index_of(names: &[String], name: &str, what: &str) -> Result<u16, StrutdbError> {
    let index = names.iter().position(|n| n == name).and_then(|i| u16::try_from(i).ok());
    index.ok_or_else(|| invalid(format!("{what} '{name}' is not in its list")))
}

fn invalid(message: String) -> StrutdbError {
    DatabaseError::Invalid(message).into()
}

/// The tensors of a file.
struct Tensors<'a, S: ?Sized> {
    header: Header,
    /// Where the first begins.
    start: usize,
    file: &'a S,
}

impl<S: Source + ?Sized> Tensors<'_, S> {
    /// The tensor of this name; `None` in the shape stands for any length.
    fn find(&self, name: &'static str, dtype: Dtype, shape: &[Option<usize>]) -> Result<Tensor<'_, S>, StrutdbError> {
        let info = self.header.info(name).ok_or(StrutdbError::MissingTensor(name))?;
        let fits = info.shape.len() == shape.len()
            && info.shape.iter().zip(shape).all(|(found, expected)| expected.is_none_or(|e| e == *found));
        if info.dtype != dtype || !fits {
            let lengths: Vec<String> = shape.iter().map(|l| l.map_or("any".into(), |l| l.to_string())).collect();
            return Err(StrutdbError::Tensor {
                name,
                found: format!("{:?} {:?}", info.dtype, info.shape),
                expected: format!("{dtype:?} [{}]", lengths.join(", ")),
            });
        }
        let (begin, end) = info.data_offsets;
        Ok(Tensor { file: self.file, begin: self.start + begin, bytes: end - begin, shape: &info.shape })
    }
}

/// A tensor of the expected type and shape.
struct Tensor<'a, S: ?Sized> {
    file: &'a S,
    begin: usize,
    bytes: usize,
    shape: &'a [usize],
}

// Bytes become numbers as they are.
const _: () = assert!(cfg!(target_endian = "little"), "files are little-endian");

/// Rows that are copied at once.
const ROWS: usize = 256;

impl<S: Source + ?Sized> Tensor<'_, S> {
    fn numbers<T: Pod>(&self) -> Vec<T> {
        self.part(0, self.bytes)
    }

    /// Of a tensor whose first dimension is 2.
    fn halves<T: Pod>(&self) -> [Vec<T>; 2] {
        let half = self.bytes / 2;
        [self.part(0, half), self.part(half, half)]
    }

    fn part<T: Pod>(&self, begin: usize, bytes: usize) -> Vec<T> {
        let mut numbers = vec![T::zeroed(); bytes / size_of::<T>()];
        self.file.copy(self.begin + begin, bytemuck::cast_slice_mut(&mut numbers));
        numbers
    }

    /// Rows with their padding.
    fn rows(&self) -> Vec<PoseRow> {
        let mut padded = vec![[0.0; ROW]; self.bytes / size_of::<[f32; DOFS]>()];
        let mut rows = vec![[0.0_f32; DOFS]; ROWS];
        for (i, padded) in padded.chunks_mut(ROWS).enumerate() {
            let rows = &mut rows[..padded.len()];
            self.file.copy(self.begin + i * ROWS * size_of::<[f32; DOFS]>(), bytemuck::cast_slice_mut(rows));
            for (padded, row) in padded.iter_mut().zip(rows) {
                padded[..DOFS].copy_from_slice(row);
            }
        }
        padded
    }
}

pub(super) fn unit_chart(floats: &[f32]) -> Result<PoseChart, StrutdbError> {
    let mut chart = PoseChart::default();
    for (mean, q) in chart.means.iter_mut().zip(floats.chunks_exact(4)) {
        *mean = Quat::from_xyzw(q[0], q[1], q[2], q[3]);
        let length_squared = mean.dot(*mean);
        if !(0.99..1.01).contains(&length_squared) {
            return Err(invalid("'chart' holds a quaternion that is not of unit length".into()));
        }
    }
    Ok(chart)
}
