//! Reads [`Database`] from bytes; checks every value.

use super::metadata::{Metadata, pose_columns};
use super::{KIND, MAX_CLIPS, StrutdbError};
use crate::container::{self, ContainerError, Source, Tensor, Tensors};
use safetensors::tensor::Dtype;
use strut_core::catalogue::{Catalogue, CatalogueBuilder, CatalogueSize};
use strut_core::database::{Clip, Database, DatabaseParts, MAX_COUNTERPARTS, MAX_FRAMES, PointCloud};
use strut_core::humanoid::JOINTS;
use strut_core::math::Quat;
use strut_core::pose_vector::{DOFS, PoseChart, PoseRow, ROW};
use strut_core::search::{Plan, PlanSource};

/// Contents of a file.
#[derive(Clone, Debug)]
pub struct Contents {
    /// The database.
    pub database: Database,
    /// Plan of its search index; `None` if the file has none of this version. [`Catalogue::with_plan`] checks whether
    /// it matches the database.
    pub plan: Option<Plan>,
}

impl Contents {
    /// Prepares the database for styling; the search index is built if there is no plan for it.
    pub fn into_catalogue(self) -> Catalogue {
        Catalogue::with_plan(self.database, self.plan)
    }
}

/// Reads a file.
///
/// # Errors
/// [`StrutdbError`] unless the file is an undamaged database of this major version.
pub fn read<S: Source + ?Sized>(file: &S) -> Result<Contents, StrutdbError> {
    let (metadata, tensors) = open(file)?;
    let (parts, LongTensors { pose, point_cloud, plan }) = parts_of(metadata, &tensors)?;
    let mut rows = vec![[0.0; ROW]; pose.shape()[0]];
    for (i, rows) in rows.chunks_mut(ROWS).enumerate() {
        copy_rows(&pose, i * ROWS, rows);
    }
    let parts = DatabaseParts { pose: rows, point_cloud: point_cloud.numbers(), ..parts };
    let plan = plan.map(|PlanTensors { order, bases, points }| Plan { order, bases, points: points.halves() });
    Ok(Contents { database: Database::new(parts)?, plan })
}

/// Reads a file for styling: the same as [`Contents::into_catalogue`], with less memory. With `most_bytes` it first
/// checks that the database and the targets of [`STYLES`] styles take no more, and that there is memory to open it: in
/// WebAssembly, running out of memory terminates the program.
///
/// # Errors
/// As [`read`], and [`StrutdbError::Memory`].
pub fn read_catalogue(file: &dyn Source, most_bytes: Option<u64>) -> Result<Catalogue, StrutdbError> {
    let (metadata, tensors) = open(file)?;
    if let Some(most_bytes) = most_bytes {
        check_memory(&metadata, &tensors, most_bytes)?;
    }
    let (parts, LongTensors { pose, point_cloud, plan }) = parts_of(metadata, &tensors)?;
    let builder = CatalogueBuilder::new(parts, &|first, rows| copy_rows(&pose, first, rows))?;
    let copy_clouds = Box::new(|first: usize, to: &mut [PointCloud]| point_cloud.copy(first * 3 * JOINTS, to));
    Ok(match plan {
        Some(PlanTensors { order, bases, points }) if points.shape()[1] == order.len() => {
            let windows = order.len();
            let copy_points = |metric: usize, first: usize, to: &mut [[i16; Plan::COORDINATES]]| {
                points.copy((metric * windows + first) * Plan::COORDINATES, to);
            };
            builder.finish(copy_clouds, Some(PlanSource { order, bases, points: &copy_points }))?
        }
        _ => builder.finish(copy_clouds, None)?,
    })
}

/// Number of styles whose targets must fit in memory together with an opened database: three, the neutral one, and one
/// that was in use before.
pub const STYLES: u64 = 5;

/// Size of each trial allocation, bytes: a quarter of the 32-bit address space.
const TRIAL: u64 = 1 << 30;

/// Checks that a database can be opened with `most_bytes`.
fn check_memory(
    metadata: &Metadata,
    tensors: &Tensors<'_, dyn Source + '_>,
    most_bytes: u64,
) -> Result<(), StrutdbError> {
    let counterpart = tensors.find("counterpart", Dtype::F32, &[None, None, None])?;
    let size = CatalogueSize::of_clips(&clips(metadata)?, metadata.styles.len(), counterpart.shape()[2]);
    let opening = size.bytes(tensors.rows("search_order") > 0);
    let needed = opening.saturating_add(STYLES.saturating_mul(size.table_bytes()));
    let refused = |most| StrutdbError::Memory { frames: size.frames, needed, most };
    if needed > most_bytes {
        return Err(refused(Some(most_bytes)));
    }
    if is_available(opening) { Ok(()) } else { Err(refused(None)) }
}

/// Returns whether this number of bytes can be allocated now. In WebAssembly the memory then belongs to the program.
fn is_available(bytes: u64) -> bool {
    let mut trials: Vec<Vec<u8>> = Vec::new();
    let mut left = bytes;
    while left > 0 {
        let mut trial = Vec::new();
        let part = left.min(TRIAL);
        if trial.try_reserve_exact(part as usize).is_err() {
            return false;
        }
        left -= part;
        // Compilers remove allocations that are not used.
        trials.push(std::hint::black_box(trial));
    }
    true
}

/// Tensors that need not be in memory completely.
struct LongTensors<'a, S: ?Sized> {
    pose: Tensor<'a, S>,
    point_cloud: Tensor<'a, S>,
    plan: Option<PlanTensors<'a, S>>,
}

struct PlanTensors<'a, S: ?Sized> {
    order: Vec<u32>,
    bases: [Vec<f32>; 2],
    points: Tensor<'a, S>,
}

/// A database without its poses and point clouds, and the tensors of these.
fn parts_of<'a, S: Source + ?Sized>(
    metadata: Metadata,
    tensors: &'a Tensors<'_, S>,
) -> Result<(DatabaseParts, LongTensors<'a, S>), StrutdbError> {
    let proportions = metadata.skeleton.proportions().ok_or(StrutdbError::Layout("joints"))?;
    if metadata.pose_columns != pose_columns() {
        return Err(StrutdbError::Layout("degrees of freedom"));
    }
    let clips = clips(&metadata)?;
    let n = Some(frames_of(&clips)?);

    let f32s = |name, shape: &[Option<usize>]| tensors.find(name, Dtype::F32, shape);
    let pose = f32s("pose", &[n, Some(DOFS)])?;
    let point_cloud = f32s("point_cloud", &[n, Some(JOINTS), Some(3)])?;
    let canonical_time = f32s("canonical_time", &[n])?.numbers();
    let time_step = f32s("time_step", &[n])?.numbers();
    let contact = tensors.find("contact", Dtype::U8, &[n, Some(2)])?.numbers();
    let classes: Vec<[u16; 2]> = tensors.find("class_of_clip", Dtype::U16, &[Some(clips.len()), Some(2)])?.numbers();
    let counterpart = f32s("counterpart", &[n, Some(metadata.styles.len()), None])?;
    let counterparts_per_style = counterpart.shape()[2];
    if counterparts_per_style > MAX_COUNTERPARTS {
        return Err(invalid(format!("{counterparts_per_style} counterparts per style")));
    }
    let counterpart = counterpart.numbers();
    let chart: Vec<f32> = f32s("chart", &[Some(JOINTS), Some(4)])?.numbers();
    if !clips.iter().zip(classes).all(|(clip, class)| [clip.action, clip.style] == class) {
        return Err(invalid("'class_of_clip' and the clips' actions and styles differ".into()));
    }
    let plan = plan_of(&metadata, tensors);
    let parts = DatabaseParts {
        rate_hz: metadata.rate_hz,
        proportions,
        chart: unit_chart(&chart)?,
        neutral: index_of(&metadata.styles, &metadata.neutral, "style")?,
        actions: metadata.actions,
        styles: metadata.styles,
        clips,
        pose: Vec::new(),
        point_cloud: Vec::new(),
        canonical_time,
        time_step,
        contact,
        counterparts_per_style,
        counterpart,
    };
    Ok((parts, LongTensors { pose, point_cloud, plan }))
}

/// Plan of the search index, if there is one of this version.
fn plan_of<'a, S: Source + ?Sized>(metadata: &Metadata, tensors: &'a Tensors<'_, S>) -> Option<PlanTensors<'a, S>> {
    metadata.search_version.filter(|&version| version == Plan::VERSION)?;
    let order: Vec<u32> = tensors.find("search_order", Dtype::U32, &[None]).ok()?.numbers();
    let bases = tensors.find("search_basis", Dtype::F32, &[Some(2), Some(Plan::BASIS_LENGTH)]).ok()?.halves();
    let points = tensors.find("search_points", Dtype::I16, &[Some(2), None, Some(Plan::COORDINATES)]).ok()?;
    Some(PlanTensors { order, bases, points })
}

/// Reads only the metadata, after checking version and checksum.
///
/// # Errors
/// [`StrutdbError`] if the file is damaged, of another version or not a database.
pub fn read_metadata<S: Source + ?Sized>(file: &S) -> Result<Metadata, StrutdbError> {
    Ok(open(file)?.0)
}

/// The metadata and the tensors of an undamaged file.
fn open<S: Source + ?Sized>(file: &S) -> Result<(Metadata, Tensors<'_, S>), ContainerError> {
    container::open(KIND, file)
}

fn clips(metadata: &Metadata) -> Result<Vec<Clip>, StrutdbError> {
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

/// Number of frames of all clips.
pub(super) fn frames_of(clips: &[Clip]) -> Result<usize, StrutdbError> {
    let frames = clips.iter().try_fold(0_usize, |n, c| n.checked_add(c.frames).filter(|&n| n <= MAX_FRAMES));
    frames.ok_or_else(|| invalid(format!("more than {MAX_FRAMES} frames")))
}

fn index_of(names: &[String], name: &str, what: &str) -> Result<u16, StrutdbError> {
    let index = names.iter().position(|n| n == name).and_then(|i| u16::try_from(i).ok());
    index.ok_or_else(|| invalid(format!("{what} '{name}' is not in its list")))
}

fn invalid(message: String) -> StrutdbError {
    StrutdbError::Header(message)
}

/// Number of rows copied at once, on the stack.
const ROWS: usize = 32;

/// Copies rows of degrees of freedom, from index `first` on. Their padding is not changed.
fn copy_rows<S: Source + ?Sized>(tensor: &Tensor<'_, S>, first: usize, to: &mut [PoseRow]) {
    let mut rows = [[0.0_f32; DOFS]; ROWS];
    for (i, to) in to.chunks_mut(ROWS).enumerate() {
        let rows = &mut rows[..to.len()];
        tensor.copy((first + i * ROWS) * DOFS, rows.as_flattened_mut());
        for (to, row) in to.iter_mut().zip(rows) {
            to[..DOFS].copy_from_slice(row);
        }
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
