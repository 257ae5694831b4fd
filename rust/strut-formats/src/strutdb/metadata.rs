//! Metadata of a database file.

use crate::container;
use serde::{Deserialize, Serialize};
use strut_core::database::Database;
use strut_core::humanoid::{JOINTS, Proportions, Role};
use strut_core::math::Vec3;
use strut_core::pose_vector::DOFS;
use strut_core::search::Plan;

/// The JSON object of the metadata entry `strut`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Metadata {
    /// Version of the format, major.minor; another major version is rejected.
    pub version: String,
    /// CRC-32 of the file; see [`container`].
    pub checksum: String,
    /// Program and version that wrote the file.
    pub generator: String,
    /// Frames per second of every clip.
    pub rate_hz: f32,
    /// Humanoid of the tensors' joints.
    pub skeleton: SkeletonInfo,
    /// Meaning of each column of `pose`.
    pub pose_columns: Vec<String>,
    /// Names of the actions.
    pub actions: Vec<String>,
    /// Names of the styles.
    pub styles: Vec<String>,
    /// Name of the neutral style.
    pub neutral: String,
    /// Clips in order of their frames.
    pub clips: Vec<ClipInfo>,
    /// [`Plan::VERSION`] of the search index; missing in files without one.
    #[serde(default)]
    pub search_version: Option<u32>,
}

/// The canonical humanoid's joints, parents first.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SkeletonInfo {
    /// Names of the joints.
    pub names: Vec<String>,
    /// Index of each joint's parent; −1 for the root.
    pub parents: Vec<i32>,
    /// Position of each joint in its parent's frame in the T-pose, centimetres; the root's is (0, height, 0).
    pub offsets_cm: Vec<[f64; 3]>,
    /// Humanoid role of each joint.
    pub roles: Vec<String>,
}

/// One clip.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ClipInfo {
    /// File stem or other name.
    pub name: String,
    /// Name of the action.
    pub action: String,
    /// Name of the style.
    pub style: String,
    /// Number of the take.
    pub take: u32,
    /// Number of frames.
    pub frames: usize,
    /// Row of its first frame.
    pub first_frame: usize,
    /// Origin of the clip.
    pub source: String,
    /// Licence, empty if unknown.
    pub licence: String,
}

impl Metadata {
    /// Metadata of a database, with a blank checksum.
    pub(super) fn of(db: &Database, generator: &str) -> Self {
        let clips = db.clips.iter().map(|c| ClipInfo {
            name: c.name.clone(),
            action: db.actions[usize::from(c.action)].clone(),
            style: db.styles[usize::from(c.style)].clone(),
            take: c.take,
            frames: c.frames,
            first_frame: c.first_frame,
            source: c.source.clone(),
            licence: c.licence.clone(),
        });
        Self {
            version: super::KIND.version.to_owned(),
            checksum: container::BLANK.to_owned(),
            generator: generator.to_owned(),
            rate_hz: db.rate_hz,
            skeleton: SkeletonInfo::of(&db.proportions),
            pose_columns: pose_columns(),
            actions: db.actions.clone(),
            styles: db.styles.clone(),
            neutral: db.styles[usize::from(db.neutral)].clone(),
            clips: clips.collect(),
            search_version: Some(Plan::VERSION),
        }
    }
}

/// Greatest component of a bone offset, cm. Much greater lengths overflow when they are squared.
pub(super) const MAX_OFFSET_CM: f64 = 10_000.0;

impl SkeletonInfo {
    pub(crate) fn of(proportions: &Proportions) -> Self {
        let names = || Role::ALL.iter().map(|r| r.name().to_owned()).collect();
        Self {
            names: names(),
            parents: Role::ALL.iter().map(|r| r.parent().map_or(-1, |p| p.index() as i32)).collect(),
            offsets_cm: proportions.offsets.iter().map(|o| o.to_array().map(|v| f64::from(v) * 100.0)).collect(),
            roles: names(),
        }
    }

    /// Bone offsets if the joints are those of the canonical humanoid in its order, at most [`MAX_OFFSET_CM`] apart.
    pub(crate) fn proportions(&self) -> Option<Proportions> {
        let mut proportions = Proportions::default();
        let expected = Self::of(&proportions);
        if self.roles != expected.roles || self.parents != expected.parents || self.offsets_cm.len() != JOINTS {
            return None;
        }
        for (offset, cm) in proportions.offsets.iter_mut().zip(&self.offsets_cm) {
            if !cm.iter().all(|v| v.abs() <= MAX_OFFSET_CM) {
                return None;
            }
            *offset = Vec3::from_array(cm.map(|v| (v / 100.0) as f32));
        }
        Some(proportions)
    }
}

/// Meaning of each degree of freedom in the order of [`strut_core::pose_vector`]: exponential map
/// components of every joint, radians, then root height, velocities and heading rate.
pub(super) fn pose_columns() -> Vec<String> {
    let mut columns = Vec::with_capacity(DOFS);
    for role in Role::ALL {
        columns.extend(["x", "y", "z"].map(|axis| format!("{}.{axis}", role.name())));
    }
    columns.extend(["hip_height", "velocity_x", "velocity_z", "heading_rate"].map(str::to_owned));
    columns
}
