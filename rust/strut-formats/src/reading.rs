//! How a file is to be read and how it was read, as JSON: plain data for other languages.

use crate::joints::{JointAssignment, JointsError, Reading};
use crate::quotation::quotation;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use strut_core::motion::Motion;
use strut_core::note::Note;
use strut_core::retarget::{Binding, ReadAs, UpAxis};
use strut_core::skeleton::Skeleton;
use thiserror::Error;

/// What a person says of a file: `{"up": "z", "floor": -0.93, "mirrored": true, "unit": 0.01, "joints": {"hips": "Bip01"}}`.
#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
struct Said {
    up: Option<String>,
    /// Height of the floor along the up axis, metres.
    floor: Option<f32>,
    swap_sides: bool,
    mirrored: Option<bool>,
    /// Metres per unit of length.
    unit: Option<f32>,
    joints: Option<BTreeMap<String, Option<String>>>,
}

/// Why a text does not say how a file is to be read.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum ReadingError {
    /// Not of the form above.
    #[error("this does not say how a file is to be read: {0}")]
    Json(String),
    /// An axis that does not exist.
    #[error("there is no up axis '{0}'; x, -x, y, -y, z or -z was expected")]
    Up(String),
    /// A height or a unit beyond all bodies.
    #[error("the {0} is no length that files have")]
    Length(&'static str),
    /// A role that does not exist.
    #[error(transparent)]
    Joints(#[from] JointsError),
}

impl Reading {
    /// What this JSON says; nothing where it is empty.
    ///
    /// # Errors
    /// See [`ReadingError`].
    pub fn parse(json: &str) -> Result<Self, ReadingError> {
        if json.is_empty() {
            return Ok(Self::default());
        }
        let said: Said = serde_json::from_str(json).map_err(|e| ReadingError::Json(quotation(&e.to_string(), 200)))?;
        let axis = |name: String| UpAxis::from_name(&name).ok_or_else(|| ReadingError::Up(quotation(&name, 40)));
        let up = said.up.map(axis).transpose()?;
        if said.floor.is_some_and(|height| !height.is_finite()) {
            return Err(ReadingError::Length("floor"));
        }
        if said.unit.is_some_and(|metres| !(metres.is_finite() && metres > 0.0)) {
            return Err(ReadingError::Length("unit"));
        }
        let Said { floor: floor_metres, unit: metres_per_unit, swap_sides, mirrored, joints, .. } = said;
        let read_as = ReadAs { joints: None, metres_per_unit, up, floor_metres, swap_sides, mirrored };
        Ok(Self { joints: joints.map(JointAssignment::new).transpose()?, read_as })
    }
}

/// How a file was read.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Read<'a> {
    frames: usize,
    rate_hz: f64,
    up: &'static str,
    mirrored: bool,
    floor: f32,
    unit: f32,
    height: f32,
    confidence: f32,
    skeleton: String,
    joints: Vec<&'a str>,
    roles: Vec<Option<usize>>,
}

/// A note.
#[derive(Serialize)]
struct SaidNote<'a> {
    code: &'static str,
    text: &'a str,
}

/// Notes as JSON: `[{"code": …, "text": …}, …]`.
pub fn notes_json(notes: &[Note]) -> String {
    let notes: Vec<_> = notes.iter().map(|note| SaidNote { code: note.code.name(), text: &note.text }).collect();
    serde_json::to_string(&notes).unwrap_or_default()
}

/// How a file was read, as JSON: its `frames` and `rateHz`, `up`, `mirrored`, `floor` (metres), `unit` (metres per unit of
/// length), `height` of the body (metres), `confidence` in the roles, the identity of the `skeleton`, the names of its
/// `joints`, and the joint of each of the `roles`.
pub fn reading_json(binding: &Binding, motion: &Motion) -> String {
    let skeleton = &motion.skeleton;
    let read = Read {
        frames: motion.frames(),
        rate_hz: motion.frame_time_secs.recip(),
        up: binding.up.name(),
        mirrored: binding.is_mirrored,
        floor: binding.floor_metres,
        unit: binding.metres_per_unit,
        height: binding.proportions.stature(),
        confidence: binding.confidence,
        skeleton: skeleton_id(skeleton),
        joints: skeleton.joints().iter().map(|joint| joint.name.as_str()).collect(),
        roles: binding.joint_of_role.to_vec(),
    };
    serde_json::to_string(&read).unwrap_or_default()
}

/// Identity of a skeleton by which what a person said of it is found again: a hash (FNV-1a) of the names and the tree of its
/// joints. The same names in the same tree give the same one, whatever the lengths are.
pub fn skeleton_id(skeleton: &Skeleton) -> String {
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    for joint in skeleton.joints() {
        let parent = joint.parent.map_or(u32::MAX, |parent| parent as u32).to_le_bytes();
        // No name has a byte of 0: where one ends is part of it.
        for byte in parent.iter().chain(joint.name.as_bytes()).chain(&[0]) {
            hash = (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }
    format!("{hash:016x}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use strut_core::math::Vec3;
    use strut_core::note::NoteCode;
    use strut_core::skeleton::Joint;

    fn skeleton(names: [&str; 3], parents: [usize; 2]) -> Skeleton {
        let parents = [None, Some(parents[0]), Some(parents[1])];
        let joints = names.iter().zip(parents);
        let joints = joints.map(|(name, parent)| Joint { name: (*name).into(), parent, offset: Vec3::Y, end: None });
        Skeleton::new(joints.collect()).unwrap()
    }

    #[test]
    fn a_reading_is_plain_data() {
        assert_eq!(Reading::parse("").unwrap(), Reading::default());
        assert_eq!(Reading::parse("{}").unwrap(), Reading::default());
        let said = Reading::parse(
            r#"{"up": "-Z", "floor": -0.93, "mirrored": false, "unit": 0.01, "joints": {"hips": "Bip01", "chest": null}}"#,
        )
        .unwrap();
        assert_eq!(said.read_as.up, Some(UpAxis::NegZ));
        assert_eq!((said.read_as.floor_metres, said.read_as.metres_per_unit), (Some(-0.93), Some(0.01)));
        assert_eq!(said.read_as.mirrored, Some(false));
        assert_eq!(said.joints.unwrap().joints()["hips"].as_deref(), Some("Bip01"));
    }

    #[test]
    fn other_texts_are_refused_with_what_was_expected() {
        let refusal = |text: &str| Reading::parse(text).unwrap_err().to_string();
        assert!(
            refusal(r#"{"flor": 1}"#).starts_with("this does not say how a file is to be read: unknown field `flor`")
        );
        assert_eq!(refusal(r#"{"up": "w"}"#), "there is no up axis 'w'; x, -x, y, -y, z or -z was expected");
        assert_eq!(refusal(r#"{"unit": 0}"#), "the unit is no length that files have");
        assert_eq!(refusal(r#"{"floor": 1e39}"#), "the floor is no length that files have");
        assert!(refusal(r#"{"joints": {"hip": "Bip01"}}"#).starts_with("there is no role 'hip'"));
    }

    #[test]
    fn a_skeleton_is_known_by_its_names_and_its_tree() {
        let id = skeleton_id(&skeleton(["a", "b", "c"], [0, 0]));
        assert_eq!(id, skeleton_id(&skeleton(["a", "b", "c"], [0, 0])));
        assert_eq!(id.len(), 16);
        assert_ne!(id, skeleton_id(&skeleton(["a", "b", "c"], [0, 1])));
        assert_ne!(id, skeleton_id(&skeleton(["a", "bc", ""], [0, 0])));
    }

    #[test]
    fn notes_are_codes_and_sentences() {
        let notes = [Note::new(NoteCode::Up, "Up is \"+Z\".")];
        assert_eq!(notes_json(&notes), r#"[{"code":"up","text":"Up is \"+Z\"."}]"#);
        assert_eq!(notes_json(&[]), "[]");
    }
}
