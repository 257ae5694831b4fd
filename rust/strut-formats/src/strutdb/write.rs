//! [`Database`] to bytes.

use super::checksum;
use super::metadata::Metadata;
use safetensors::View;
use safetensors::tensor::Dtype;
use std::borrow::Cow;
use strut_core::database::Database;
use strut_core::humanoid::JOINTS;
use strut_core::math::{Quat, Vec3};
use strut_core::pose_vector::DOFS;
use strut_core::search::{Index, Plan};

/// A tensor whose bytes are made when they are written: all of them at once would need the file's size a second time,
/// which browsers have not to spare.
struct Tensor<'a> {
    dtype: Dtype,
    shape: Vec<usize>,
    bytes: Box<dyn Fn() -> Vec<u8> + 'a>,
}

impl View for &Tensor<'_> {
    fn dtype(&self) -> Dtype {
        self.dtype
    }

    fn shape(&self) -> &[usize] {
        &self.shape
    }

    fn data(&self) -> Cow<'_, [u8]> {
        (self.bytes)().into()
    }

    fn data_len(&self) -> usize {
        self.shape.iter().product::<usize>() * self.dtype.bitsize() / 8
    }
}

/// The file of a database and of the plan of its search index; `generator` names the program and version that made it.
///
/// # Panics
/// Never for a [`Database`], whose shapes were checked when it was made.
pub fn write(db: &Database, generator: &str) -> Vec<u8> {
    let (n, styles) = (db.frames(), db.styles.len());
    let plan = Index::build(db).plan();
    let tensors = [
        ("pose", floats(vec![n, DOFS], || db.pose.iter().flat_map(|row| row[..DOFS].iter().copied()))),
        ("point_cloud", floats(vec![n, JOINTS, 3], || db.point_cloud.iter().flatten().flat_map(Vec3::to_array))),
        ("canonical_time", floats(vec![n], || db.canonical_time.iter().copied())),
        ("time_step", floats(vec![n], || db.time_step.iter().copied())),
        ("contact", tensor(Dtype::U8, vec![n, 2], || db.contact.iter().flatten().copied().collect())),
        (
            "class_of_clip",
            tensor(Dtype::U16, vec![db.clips.len(), 2], || {
                db.clips.iter().flat_map(|c| [c.action, c.style]).flat_map(u16::to_le_bytes).collect()
            }),
        ),
        ("counterpart", floats(vec![n, styles, db.counterparts_per_style], || db.counterpart.iter().copied())),
        ("chart", floats(vec![JOINTS, 4], || db.chart.means.iter().copied().flat_map(Quat::to_array))),
        (
            "search_order",
            tensor(Dtype::U32, vec![plan.order.len()], || {
                plan.order.iter().flat_map(|row| row.to_le_bytes()).collect()
            }),
        ),
        ("search_basis", floats(vec![2, Plan::BASIS_LENGTH], || plan.bases.iter().flatten().copied())),
        (
            "search_points",
            tensor(Dtype::I16, vec![2, plan.order.len(), Plan::COORDINATES], || {
                plan.points.iter().flatten().flatten().flat_map(|coordinate| coordinate.to_le_bytes()).collect()
            }),
        ),
    ];
    let metadata = serde_json::to_string(&Metadata::of(db, generator)).expect("strings and numbers are JSON");
    let metadata = std::iter::once(("strut".to_owned(), metadata)).collect();
    let views = tensors.iter().map(|(name, tensor)| (*name, tensor));
    let mut file = safetensors::serialize(views, Some(metadata)).expect("tensors have distinct names");
    checksum::enter(&mut file);
    file
}

fn tensor<'a>(dtype: Dtype, shape: Vec<usize>, bytes: impl Fn() -> Vec<u8> + 'a) -> Tensor<'a> {
    Tensor { dtype, shape, bytes: Box::new(bytes) }
}

fn floats<'a, I: Iterator<Item = f32>>(shape: Vec<usize>, values: impl Fn() -> I + 'a) -> Tensor<'a> {
    let length = 4 * shape.iter().product::<usize>();
    tensor(Dtype::F32, shape, move || {
        let mut bytes = Vec::with_capacity(length);
        bytes.extend(values().flat_map(f32::to_le_bytes));
        bytes
    })
}
