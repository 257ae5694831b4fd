//! User-specified roles of a skeleton's joints: a small JSON file.
//!
//! `{"joints": {"hips": "Bip01", "left_upper_leg": "Bip01 L Thigh", "chest": null}}`. Roles have the names of
//! [`Role::name`]; `null` means that the skeleton has no such joint. Omitted roles are detected.

use crate::quotation::quotation;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use strut_core::humanoid::{JOINTS, Role};
use strut_core::motion::Motion;
use strut_core::retarget::{BindError, Binding, ReadAs};
use thiserror::Error;

/// Greatest size of a file, bytes.
pub const MAX_BYTES: usize = 1 << 20;

/// Joints by role.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct JointAssignment {
    /// Names of joints by names of roles.
    joints: BTreeMap<String, Option<String>>,
}

/// Reason why bytes are not a joint assignment.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum JointsError {
    /// The JSON does not have the form above.
    #[error("this is not a joint mapping: {0}; {{\"joints\": {{\"hips\": \"name\", …}}}} was expected")]
    Json(String),
    /// A role does not exist.
    #[error("there is no role '{0}'; one of {expected} was expected", expected = Role::ALL.map(Role::name).join(", "))]
    Role(String),
}

impl JointAssignment {
    /// Creates an assignment from names of joints by names of roles; `None` if the skeleton has no such joint.
    ///
    /// # Errors
    /// [`JointsError::Role`].
    pub fn new(joints: BTreeMap<String, Option<String>>) -> Result<Self, JointsError> {
        let unknown = joints.keys().find(|name| Role::ALL.iter().all(|role| role.name() != name.as_str()));
        unknown.map_or(Ok(()), |name| Err(JointsError::Role(quotation(name, 40))))?;
        Ok(Self { joints })
    }

    /// Names of joints by names of roles.
    pub fn joints(&self) -> &BTreeMap<String, Option<String>> {
        &self.joints
    }

    /// Parses an assignment.
    ///
    /// # Errors
    /// See [`JointsError`].
    pub fn parse(bytes: &[u8]) -> Result<Self, JointsError> {
        let said: Self =
            serde_json::from_slice(bytes).map_err(|e| JointsError::Json(quotation(&e.to_string(), 200)))?;
        Self::new(said.joints)
    }

    /// Joint of each role of a clip's skeleton.
    ///
    /// # Errors
    /// [`BindError::UnknownJoint`] for a name that the skeleton lacks.
    fn roles(&self, motion: &Motion) -> Result<[Option<usize>; JOINTS], BindError> {
        let mut roles = Binding::likely_roles(motion);
        for role in Role::ALL {
            let Some(joint) = self.joints.get(role.name()) else { continue };
            let unknown = |name: &String| BindError::UnknownJoint { role, joint: quotation(name, 40) };
            let index = joint.as_ref().map(|name| motion.skeleton.find(name).ok_or_else(|| unknown(name)));
            roles[role.index()] = index.transpose()?;
        }
        Ok(roles)
    }
}

/// User-specified options of reading files, in place of detection from the body.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reading {
    /// Joint of each role.
    pub joints: Option<JointAssignment>,
    /// All other options; its `joints` are not used.
    pub read_as: ReadAs,
}

impl Reading {
    /// Binding of a clip.
    ///
    /// # Errors
    /// See [`BindError`].
    pub fn bind(&self, motion: &Motion) -> Result<Binding, BindError> {
        let joints = self.joints.as_ref().map(|joints| joints.roles(motion)).transpose()?;
        Binding::read(motion, &ReadAs { joints, ..self.read_as })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_assignment_names_roles_and_joints() {
        let said = JointAssignment::parse(br#"{"joints": {"hips": "Bip01", "chest": null}}"#).unwrap();
        assert_eq!(said.joints["hips"].as_deref(), Some("Bip01"));
        assert_eq!(said.joints["chest"], None);
    }

    #[test]
    fn other_files_are_refused_with_what_was_expected() {
        let refusal = |text: &str| JointAssignment::parse(text.as_bytes()).unwrap_err().to_string();
        assert!(refusal(r#"{"joints": {"hip": "Bip01"}}"#).starts_with("there is no role 'hip'; one of hips, spine"));
        for text in ["", "[]", r#"{"roles": {}}"#, r#"{"joints": {"hips": 3}}"#] {
            assert!(refusal(text).starts_with("this is not a joint mapping: "), "{text}");
        }
    }
}
