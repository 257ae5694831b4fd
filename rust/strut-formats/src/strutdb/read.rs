//! Bytes to [`Database`]; trusts nothing.

use super::metadata::{Metadata, pose_columns};
use super::{MAX_BYTES, MAX_CLIPS, StrutdbError, VERSION, checksum};
use safetensors::SafeTensors;
use safetensors::tensor::{Dtype, SafeTensorError};
use serde::Deserialize;
use strut_core::database::{Clip, Database, DatabaseError, DatabaseParts, MAX_COUNTERPARTS, MAX_FRAMES};
use strut_core::humanoid::JOINTS;
use strut_core::math::{Quat, Vec3};
use strut_core::pose_vector::{DOFS, PoseChart, ROW};
use strut_core::search::Plan;

/// Reads a file.
///
/// # Errors
/// [`StrutdbError`] for anything but an undamaged database of this major version.
pub fn read(bytes: &[u8]) -> Result<Database, StrutdbError> {
    if bytes.len() > MAX_BYTES {
        return Err(StrutdbError::TooManyBytes { bytes: bytes.len() });
    }
    let tensors = SafeTensors::deserialize(bytes).map_err(container_error)?;
    let metadata = read_metadata(bytes)?;
    let proportions = metadata.skeleton.proportions().ok_or(StrutdbError::Layout("joints"))?;
    if metadata.pose_columns != pose_columns() {
        return Err(StrutdbError::Layout("degrees of freedom"));
    }
    let clips = clips(&metadata)?;
    let frames = frames_of(&clips)?;
    let classes = tensor(&tensors, "class_of_clip", Dtype::U16, &[Some(clips.len()), Some(2)])?;
    let agree = clips.iter().zip(classes.data.chunks_exact(4)).all(|(clip, c)| {
        (clip.action, clip.style) == (u16::from_le_bytes([c[0], c[1]]), u16::from_le_bytes([c[2], c[3]]))
    });
    if !agree {
        return Err(invalid("'class_of_clip' and the clips' actions and styles differ".into()));
    }

    let f32s = |name, shape: &[Option<usize>]| tensor(&tensors, name, Dtype::F32, shape);
    let n = Some(frames);
    let counterpart = f32s("counterpart", &[n, Some(metadata.styles.len()), None])?;
    let counterparts_per_style = counterpart.shape[2];
    if counterparts_per_style > MAX_COUNTERPARTS {
        return Err(invalid(format!("{counterparts_per_style} counterparts a style")));
    }
    let chart: Vec<f32> = f32s("chart", &[Some(JOINTS), Some(4)])?.floats().collect();
    let contact = tensor(&tensors, "contact", Dtype::U8, &[n, Some(2)])?;
    let parts = DatabaseParts {
        rate_hz: metadata.rate_hz,
        proportions,
        chart: unit_chart(&chart)?,
        neutral: index_of(&metadata.styles, &metadata.neutral, "style")?,
        actions: metadata.actions,
        styles: metadata.styles,
        clips,
        pose: rows(f32s("pose", &[n, Some(DOFS)])?.data),
        point_cloud: point_clouds(f32s("point_cloud", &[n, Some(JOINTS), Some(3)])?.data),
        canonical_time: f32s("canonical_time", &[n])?.floats().collect(),
        time_step: f32s("time_step", &[n])?.floats().collect(),
        contact: contact.data.chunks_exact(2).map(|c| [c[0], c[1]]).collect(),
        counterparts_per_style,
        counterpart: counterpart.floats().collect(),
    };
    Ok(Database::new(parts)?)
}

/// The plan of the search index in a file that [`read`] accepts; `None` if there is none of this version. Whether it is
/// one for the database [`Index::from_plan`](strut_core::search::Index::from_plan) finds out.
pub fn read_plan(bytes: &[u8]) -> Option<Plan> {
    let (_, header) = SafeTensors::read_metadata(bytes).ok()?;
    let metadata: Metadata = serde_json::from_str(header.metadata().as_ref()?.get("strut")?).ok()?;
    metadata.search_version.filter(|&v| v == Plan::VERSION)?;
    let tensors = SafeTensors::deserialize(bytes).ok()?;
    let order = tensor(&tensors, "search_order", Dtype::U32, &[None]).ok()?;
    let basis = tensor(&tensors, "search_basis", Dtype::F32, &[Some(2), Some(Plan::BASIS_LENGTH)]).ok()?;
    let (full, lower) = basis.data.split_at(basis.data.len() / 2);
    Some(Plan {
        order: order.data.chunks_exact(4).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect(),
        bases: [full, lower].map(|data| floats(data).collect()),
    })
}

fn container_error(error: SafeTensorError) -> StrutdbError {
    use SafeTensorError as E;
    match error {
        E::MetadataIncompleteBuffer | E::TensorInvalidInfo | E::InvalidOffset(_) | E::ValidationOverflow => {
            StrutdbError::Length
        }
        _ => StrutdbError::NotSafetensors,
    }
}

/// Reads the metadata alone, once version and checksum are found right.
///
/// # Errors
/// [`StrutdbError`] for a damaged file, one of another version, or none at all.
pub fn read_metadata(bytes: &[u8]) -> Result<Metadata, StrutdbError> {
    #[derive(Deserialize)]
    struct Version {
        version: String,
    }
    let (_, header) = SafeTensors::read_metadata(bytes).map_err(container_error)?;
    let json = header.metadata().as_ref().and_then(|m| m.get("strut")).ok_or(StrutdbError::NoMetadata)?;
    let unreadable = |e: serde_json::Error| StrutdbError::Metadata(e.to_string());
    let Version { version } = serde_json::from_str(json).map_err(unreadable)?;
    let major = |v: &str| v.split('.').next().and_then(|major| major.parse::<u32>().ok());
    if major(&version) != major(VERSION) {
        return Err(StrutdbError::Version { found: version.chars().take(20).collect() });
    }
    let metadata: Metadata = serde_json::from_str(json).map_err(unreadable)?;
    let found: String = metadata.checksum.chars().take(20).collect();
    let computed = checksum::compute(bytes).unwrap_or_default();
    if found != computed {
        return Err(StrutdbError::Checksum { found, computed });
    }
    Ok(metadata)
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

/// A tensor of the expected type and shape.
struct Tensor<'a> {
    data: &'a [u8],
    shape: Vec<usize>,
}

impl Tensor<'_> {
    fn floats(&self) -> impl Iterator<Item = f32> + '_ {
        floats(self.data)
    }
}

/// The tensor of this name; `None` in the shape stands for any length.
fn tensor<'a>(
    tensors: &SafeTensors<'a>,
    name: &'static str,
    dtype: Dtype,
    shape: &[Option<usize>],
) -> Result<Tensor<'a>, StrutdbError> {
    let view = tensors.tensor(name).map_err(|_| StrutdbError::MissingTensor(name))?;
    let fits = view.shape().len() == shape.len()
        && view.shape().iter().zip(shape).all(|(found, expected)| expected.is_none_or(|e| e == *found));
    if view.dtype() != dtype || !fits {
        let lengths: Vec<String> = shape.iter().map(|l| l.map_or("any".into(), |l| l.to_string())).collect();
        return Err(StrutdbError::Tensor {
            name,
            found: format!("{:?} {:?}", view.dtype(), view.shape()),
            expected: format!("{dtype:?} [{}]", lengths.join(", ")),
        });
    }
    Ok(Tensor { data: view.data(), shape: view.shape().to_vec() })
}

fn floats(bytes: &[u8]) -> impl Iterator<Item = f32> + '_ {
    bytes.chunks_exact(4).map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]]))
}

fn rows(bytes: &[u8]) -> Vec<[f32; ROW]> {
    let row = |bytes: &[u8]| {
        let mut row = [0.0; ROW];
        row.iter_mut().zip(floats(bytes)).for_each(|(r, v)| *r = v);
        row
    };
    bytes.chunks_exact(4 * DOFS).map(row).collect()
}

fn point_clouds(bytes: &[u8]) -> Vec<[Vec3; JOINTS]> {
    let cloud = |bytes: &[u8]| {
        let mut cloud = [Vec3::ZERO; JOINTS];
        for (point, b) in cloud.iter_mut().zip(bytes.chunks_exact(12)) {
            floats(b).enumerate().for_each(|(axis, v)| point[axis] = v);
        }
        cloud
    };
    bytes.chunks_exact(12 * JOINTS).map(cloud).collect()
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
