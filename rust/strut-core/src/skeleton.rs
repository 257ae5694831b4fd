//! A joint hierarchy as in a file, without motion and roles.

use crate::math::Vec3;
use thiserror::Error;

/// Largest number of joints of a skeleton.
pub const MAX_JOINTS: usize = 512;

/// One joint of a [`Skeleton`].
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// Name as in the file.
    pub name: String,
    /// Index of the parent, always smaller than the joint's own; `None` only for the root.
    pub parent: Option<usize>,
    /// Position in the parent's frame in the zero pose, in the file's own length unit.
    pub offset: Vec3,
    /// Position of the end of the bone in the joint's frame (BVH "End Site"), if there is one.
    pub end: Option<Vec3>,
}

/// Joints, parents before children, joint 0 the only root.
#[derive(Clone, Debug, PartialEq)]
pub struct Skeleton {
    joints: Vec<Joint>,
}

/// Error of a list of joints that is not a valid skeleton.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum SkeletonError {
    /// There is no joint.
    #[error("a skeleton needs at least one joint")]
    Empty,
    /// There are more than [`MAX_JOINTS`].
    #[error("{0} joints; at most {MAX_JOINTS} are supported")]
    TooManyJoints(usize),
    /// A parent does not come before its child, or there is a second root.
    #[error("joint {index} '{name}' must have a parent that comes before it")]
    Order {
        /// Index of the joint.
        index: usize,
        /// Name of the joint.
        name: String,
    },
    /// An offset is NaN or infinite.
    #[error("joint {index} '{name}' has an offset that is not a finite number")]
    NotFinite {
        /// Index of the joint.
        index: usize,
        /// Name of the joint.
        name: String,
    },
}

impl Skeleton {
    /// Creates a skeleton from joints after checking them.
    ///
    /// # Errors
    /// See [`SkeletonError`].
    pub fn new(joints: Vec<Joint>) -> Result<Self, SkeletonError> {
        if joints.is_empty() {
            return Err(SkeletonError::Empty);
        }
        if joints.len() > MAX_JOINTS {
            return Err(SkeletonError::TooManyJoints(joints.len()));
        }
        for (index, j) in joints.iter().enumerate() {
            let ordered = if index == 0 { j.parent.is_none() } else { j.parent.is_some_and(|p| p < index) };
            if !ordered {
                return Err(SkeletonError::Order { index, name: j.name.clone() });
            }
            if !j.offset.is_finite() || j.end.is_some_and(|e| !e.is_finite()) {
                return Err(SkeletonError::NotFinite { index, name: j.name.clone() });
            }
        }
        Ok(Self { joints })
    }

    /// All joints.
    pub fn joints(&self) -> &[Joint] {
        &self.joints
    }

    /// Number of joints, at least 1.
    pub fn len(&self) -> usize {
        self.joints.len()
    }

    /// Always false; provided because `len` is.
    pub fn is_empty(&self) -> bool {
        self.joints.is_empty()
    }

    /// Returns the index of the joint of a name.
    pub fn find(&self, name: &str) -> Option<usize> {
        self.joints.iter().position(|j| j.name == name)
    }

    /// Indices of the children of `joint`.
    pub fn children(&self, joint: usize) -> impl Iterator<Item = usize> + '_ {
        self.joints.iter().enumerate().filter(move |(_, j)| j.parent == Some(joint)).map(|(i, _)| i)
    }
}
