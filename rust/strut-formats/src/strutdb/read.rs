//! Bytes to [`Database`]; checks every value.

use super::metadata::{Metadata, pose_columns};
use super::{KIND, MAX_CLIPS, StrutdbError};
use crate::container::{self, ContainerError, Source, Tensor, Tensors};
use safetensors::tensor::Dtype;
use strut_core::catalogue::Catalogue;
use strut_core::database::{Clip, Database, DatabaseError, DatabaseParts, MAX_COUNTERPARTS, MAX_FRAMES};
use strut_core::humanoid::JOINTS;
use strut_core::math::Quat;
use strut_core::pose_vector::{DOFS, PoseChart, PoseRow, ROW};
use strut_core::search::Plan;

/// Contents of a file.
#[derive(Clone, Debug)]
pub struct Contents {
    /// The database.
    pub database: Database,
    /// The plan of its search index; `None` if there is none of this version. [`Catalogue::with_plan`] checks whether it
    /// fits the database.
    pub plan: Option<Plan>,
}

impl Contents {
    /// The database made ready to style with; the search index is built if there is no plan for it.
    pub fn into_catalogue(self) -> Catalogue {
        Catalogue::with_plan(self.database, self.plan)
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
    let pose = padded_rows(&f32s("pose", &[n, Some(DOFS)])?);
    let point_cloud = f32s("point_cloud", &[n, Some(JOINTS), Some(3)])?.numbers();
    let canonical_time = f32s("canonical_time", &[n])?.numbers();
    let time_step = f32s("time_step", &[n])?.numbers();
    let contact = tensors.find("contact", Dtype::U8, &[n, Some(2)])?.numbers();
    let classes: Vec<[u16; 2]> = tensors.find("class_of_clip", Dtype::U16, &[Some(clips.len()), Some(2)])?.numbers();
    let counterpart = f32s("counterpart", &[n, Some(metadata.styles.len()), None])?;
    let counterparts_per_style = counterpart.shape()[2];
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

/// Reads the metadata alone, after checking version and checksum.
///
/// # Errors
/// [`StrutdbError`] for a damaged file, one of another version, or none at all.
pub fn read_metadata<S: Source + ?Sized>(file: &S) -> Result<Metadata, StrutdbError> {
    Ok(open(file)?.0)
}

/// The metadata and the tensors of an undamaged file.
fn open<S: Source + ?Sized>(file: &S) -> Result<(Metadata, Tensors<'_, S>), ContainerError> {
    container::open(KIND, file)
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

/// Rows that are copied at once.
const ROWS: usize = 256;

/// Rows of degrees of freedom with their padding.
fn padded_rows<S: Source + ?Sized>(tensor: &Tensor<'_, S>) -> Vec<PoseRow> {
    let mut padded = vec![[0.0; ROW]; tensor.shape()[0]];
    let mut rows = vec![[0.0_f32; DOFS]; ROWS];
    for (i, padded) in padded.chunks_mut(ROWS).enumerate() {
        let rows = &mut rows[..padded.len()];
        tensor.copy(i * ROWS * DOFS, rows.as_flattened_mut());
        for (padded, row) in padded.iter_mut().zip(rows) {
            padded[..DOFS].copy_from_slice(row);
        }
    }
    padded
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
