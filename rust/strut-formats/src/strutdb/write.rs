//! Writes [`Database`] as bytes.

use super::KIND;
use super::metadata::Metadata;
use crate::container::{self, Written, floats};
use safetensors::tensor::Dtype;
use strut_core::database::Database;
use strut_core::humanoid::JOINTS;
use strut_core::math::{Quat, Vec3};
use strut_core::pose_vector::DOFS;
use strut_core::search::Plan;

/// Writes the file of a database and of the plan of its search index, [`Index::plan`](strut_core::search::Index::plan).
/// `generator` is the name and version of the program.
///
/// # Panics
/// Never for a [`Database`], whose shapes were checked when it was created.
pub fn write(db: &Database, plan: &Plan, generator: &str) -> Vec<u8> {
    let (n, styles) = (db.frames(), db.styles.len());
    let tensors = [
        ("pose", floats(vec![n, DOFS], || db.pose.iter().flat_map(|row| row[..DOFS].iter().copied()))),
        ("point_cloud", floats(vec![n, JOINTS, 3], || db.point_cloud.iter().flatten().flat_map(Vec3::to_array))),
        ("canonical_time", floats(vec![n], || db.canonical_time.iter().copied())),
        ("time_step", floats(vec![n], || db.time_step.iter().copied())),
        ("contact", Written::new(Dtype::U8, vec![n, 2], || db.contact.iter().flatten().copied().collect())),
        (
            "class_of_clip",
            Written::new(Dtype::U16, vec![db.clips.len(), 2], || {
                db.clips.iter().flat_map(|c| [c.action, c.style]).flat_map(u16::to_le_bytes).collect()
            }),
        ),
        ("counterpart", floats(vec![n, styles, db.counterparts_per_style], || db.counterpart.iter().copied())),
        ("chart", floats(vec![JOINTS, 4], || db.chart.means.iter().copied().flat_map(Quat::to_array))),
        (
            "search_order",
            Written::new(Dtype::U32, vec![plan.order.len()], || {
                plan.order.iter().flat_map(|row| row.to_le_bytes()).collect()
            }),
        ),
        ("search_basis", floats(vec![2, Plan::BASIS_LENGTH], || plan.bases.iter().flatten().copied())),
        (
            "search_points",
            Written::new(Dtype::I16, vec![2, plan.order.len(), Plan::COORDINATES], || {
                plan.points.iter().flatten().flatten().flat_map(|coordinate| coordinate.to_le_bytes()).collect()
            }),
        ),
    ];
    container::write(KIND, &Metadata::of(db, generator), &tensors)
}
