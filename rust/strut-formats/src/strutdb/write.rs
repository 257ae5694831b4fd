//! [`Database`] to bytes.

use super::checksum;
use super::metadata::Metadata;
use safetensors::tensor::{Dtype, TensorView};
use strut_core::database::Database;
use strut_core::humanoid::JOINTS;
use strut_core::math::{Quat, Vec3};
use strut_core::pose_vector::DOFS;
use strut_core::search::{Index, Plan};

/// The file of a database and of the plan of its search index; `generator` names the program and version that made it.
///
/// # Panics
/// Never for a [`Database`], whose shapes were checked when it was made.
pub fn write(db: &Database, generator: &str) -> Vec<u8> {
    let n = db.frames();
    let floats = |values: &mut dyn Iterator<Item = f32>| values.flat_map(f32::to_le_bytes).collect::<Vec<u8>>();
    let pose = floats(&mut db.pose.iter().flat_map(|row| row[..DOFS].iter().copied()));
    let point_cloud = floats(&mut db.point_cloud.iter().flatten().flat_map(Vec3::to_array));
    let canonical_time = floats(&mut db.canonical_time.iter().copied());
    let time_step = floats(&mut db.time_step.iter().copied());
    let contact: Vec<u8> = db.contact.iter().flatten().copied().collect();
    let class_of_clip: Vec<u8> = db.clips.iter().flat_map(|c| [c.action, c.style]).flat_map(u16::to_le_bytes).collect();
    let counterpart = floats(&mut db.counterpart.iter().copied());
    let plan = Index::build(db).plan();
    let search_order: Vec<u8> = plan.order.iter().flat_map(|row| row.to_le_bytes()).collect();
    let search_basis = floats(&mut plan.bases.iter().flatten().copied());
    let chart = floats(&mut db.chart.means.iter().copied().flat_map(Quat::to_array));

    let (f32s, styles) = (Dtype::F32, db.styles.len());
    let tensors = [
        ("pose", f32s, vec![n, DOFS], &pose),
        ("point_cloud", f32s, vec![n, JOINTS, 3], &point_cloud),
        ("canonical_time", f32s, vec![n], &canonical_time),
        ("time_step", f32s, vec![n], &time_step),
        ("contact", Dtype::U8, vec![n, 2], &contact),
        ("class_of_clip", Dtype::U16, vec![db.clips.len(), 2], &class_of_clip),
        ("counterpart", f32s, vec![n, styles, db.counterparts_per_style], &counterpart),
        ("chart", f32s, vec![JOINTS, 4], &chart),
        ("search_order", Dtype::U32, vec![plan.order.len()], &search_order),
        ("search_basis", f32s, vec![2, Plan::BASIS_LENGTH], &search_basis),
    ];
    let views = tensors
        .into_iter()
        .map(|(name, dtype, shape, bytes)| (name, TensorView::new(dtype, shape, bytes).expect("bytes fill the shape")));
    let metadata = serde_json::to_string(&Metadata::of(db, generator)).expect("strings and numbers are JSON");
    let metadata = std::iter::once(("strut".to_owned(), metadata)).collect();
    let mut file = safetensors::serialize(views, Some(metadata)).expect("tensors have distinct names");
    checksum::enter(&mut file);
    file
}
