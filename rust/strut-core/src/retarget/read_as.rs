//! Properties of a file that the user sets instead of detecting them from the body.

use super::UpAxis;
use crate::humanoid::JOINTS;

/// Properties of a file that the user sets instead of detecting them from the body.
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
    /// Whether the detected sides are swapped: a file detected as a mirror image is read as it is, any other file as a mirror
    /// image.
    pub swap_sides: bool,
    /// Whether the file is a mirror image, regardless of the body; `swap_sides` is then ignored.
    pub mirrored: Option<bool>,
}
