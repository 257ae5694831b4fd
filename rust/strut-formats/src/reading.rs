//! User-specified reading options of a file as text, for the JavaScript packages, and the identity of a skeleton.
//!
//! A line contains one option: `up -z`, `floor -0.93` and `unit 0.01` in metres, `swapSides true`, `mirrored false`,
//! `joint left_hand Wrist L`, `joint chest` if the skeleton has no such joint, or `joints` if the user has checked all
//! of them. The parser is written by hand: a JSON parser would be as large as the detection of the joints.

use crate::joints::{JointAssignment, JointsError, Reading};
use crate::quotation::quotation;
use std::collections::BTreeMap;
use strut_core::retarget::UpAxis;
use strut_core::skeleton::Skeleton;
use thiserror::Error;

/// Reason why a text does not contain reading options.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum ReadingError {
    /// A line contains no option.
    #[error("there is no reading option '{0}'; up, floor, swapSides, mirrored, unit or joints was expected")]
    Line(String),
    /// An axis does not exist.
    #[error("there is no up axis '{0}'; x, -x, y, -y, z or -z was expected")]
    Up(String),
    /// A height or a unit is out of range for bodies.
    #[error("'{0}' is not a valid length in metres")]
    Length(String),
    /// A role does not exist.
    #[error(transparent)]
    Joints(#[from] JointsError),
}

impl Reading {
    /// Parses reading options, one per line.
    ///
    /// # Errors
    /// See [`ReadingError`].
    pub fn parse(lines: &str) -> Result<Self, ReadingError> {
        let mut reading = Self::default();
        let mut joints: Option<BTreeMap<String, Option<String>>> = None;
        for line in lines.lines() {
            let (name, value) = line.split_once(' ').unwrap_or((line, ""));
            let said = &mut reading.read_as;
            match (name, value) {
                ("up", axis) => {
                    let known = UpAxis::from_name(axis).ok_or_else(|| ReadingError::Up(quotation(axis, 40)))?;
                    said.up = Some(known);
                }
                ("floor", _) => said.floor_metres = Some(length(line, value)?),
                ("unit", _) => {
                    let metres = length(line, value)?;
                    if metres <= 0.0 {
                        return Err(ReadingError::Length(quotation(line, 40)));
                    }
                    said.metres_per_unit = Some(metres);
                }
                ("swapSides", "true" | "false") => said.swap_sides = value == "true",
                ("mirrored", "true" | "false") => said.mirrored = Some(value == "true"),
                ("joints", "") => drop(joints.get_or_insert_default()),
                ("joint", _) => {
                    let (role, joint) =
                        value.split_once(' ').map_or((value, None), |(role, joint)| (role, Some(joint)));
                    joints.get_or_insert_default().insert(role.to_owned(), joint.map(str::to_owned));
                }
                _ => return Err(ReadingError::Line(quotation(line, 40))),
            }
        }
        reading.joints = joints.map(JointAssignment::new).transpose()?;
        Ok(reading)
    }
}

/// Length in a line.
fn length(line: &str, value: &str) -> Result<f32, ReadingError> {
    // JavaScript passes numbers in double precision, too.
    let metres = value.parse::<f64>().ok().map(|metres| metres as f32).filter(|metres| metres.is_finite());
    metres.ok_or_else(|| ReadingError::Length(quotation(line, 40)))
}

/// Identity of a skeleton, by which a user's reading options are found again: a hash (FNV-1a) of the names and the tree
/// of its joints. It does not depend on lengths.
pub fn skeleton_id(skeleton: &Skeleton) -> String {
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    for joint in skeleton.joints() {
        let parent = joint.parent.map_or(u32::MAX, |parent| parent as u32).to_le_bytes();
        // No name contains a byte of 0, so that the hash includes where a name ends.
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
    use strut_core::skeleton::Joint;

    fn skeleton(names: [&str; 3], parents: [usize; 2]) -> Skeleton {
        let parents = [None, Some(parents[0]), Some(parents[1])];
        let joints = names.iter().zip(parents);
        let joints = joints.map(|(name, parent)| Joint { name: (*name).into(), parent, offset: Vec3::Y, end: None });
        Skeleton::new(joints.collect()).unwrap()
    }

    #[test]
    fn a_line_says_one_thing() {
        assert_eq!(Reading::parse("").unwrap(), Reading::default());
        let lines = "up -Z\nfloor -0.93\nmirrored false\nunit 0.01\njoint hips Bip01 L\njoint chest";
        let said = Reading::parse(lines).unwrap();
        assert_eq!(said.read_as.up, Some(UpAxis::NegZ));
        assert_eq!((said.read_as.floor_metres, said.read_as.metres_per_unit), (Some(-0.93), Some(0.01)));
        assert_eq!((said.read_as.mirrored, said.read_as.swap_sides), (Some(false), false));
        let joints = said.joints.unwrap();
        assert_eq!((joints.joints()["hips"].as_deref(), &joints.joints()["chest"]), (Some("Bip01 L"), &None));
        assert!(Reading::parse("swapSides true\njoints").unwrap().joints.unwrap().joints().is_empty());
    }

    #[test]
    fn other_lines_are_refused_with_what_was_expected() {
        let refusal = |text: &str| Reading::parse(text).unwrap_err().to_string();
        assert_eq!(
            refusal("flor 1"),
            "there is no reading option 'flor 1'; up, floor, swapSides, mirrored, unit or joints was expected"
        );
        assert!(refusal("mirrored 1").starts_with("there is no reading option 'mirrored 1'"));
        assert_eq!(refusal("up w"), "there is no up axis 'w'; x, -x, y, -y, z or -z was expected");
        for line in ["unit 0", "unit -1", "unit", "floor 1e39", "floor low", "floor NaN"] {
            assert_eq!(refusal(line), format!("'{line}' is not a valid length in metres"));
        }
        assert!(refusal("joint hip Bip01").starts_with("there is no role 'hip'"));
    }

    #[test]
    fn a_skeleton_is_known_by_its_names_and_its_tree() {
        let id = skeleton_id(&skeleton(["a", "b", "c"], [0, 0]));
        assert_eq!(id, skeleton_id(&skeleton(["a", "b", "c"], [0, 0])));
        assert_eq!(id.len(), 16);
        assert_ne!(id, skeleton_id(&skeleton(["a", "b", "c"], [0, 1])));
        assert_ne!(id, skeleton_id(&skeleton(["a", "bc", ""], [0, 0])));
    }
}
