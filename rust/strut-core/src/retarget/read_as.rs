//! What a person says of a file, in place of what is read from the body.

use super::UpAxis;
use crate::humanoid::JOINTS;

/// What a person says of a file, in place of what is read from the body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ReadAs {
    /// The joint of each role.
    pub joints: Option<[Option<usize>; JOINTS]>,
    /// Metres per unit of length; finite and above 0.
    pub metres_per_unit: Option<f32>,
    /// The file's up axis.
    pub up: Option<UpAxis>,
    /// Height of the floor along the up axis, metres; finite.
    pub floor_metres: Option<f32>,
    /// Whether left and right are the other way round than they are read: a mirror image is taken as it is, any other file
    /// as a mirror image.
    pub swap_sides: bool,
    /// Whether the file is a mirror image, whatever the body shows; `swap_sides` does not count then.
    pub mirrored: Option<bool>,
}
