//! Input of a prediction.

use crate::pose_vector::PoseRow;

/// Degrees of freedom of the input at t and t−1.
#[derive(Clone, Copy, Debug)]
pub(super) struct Input<'a> {
    pub(super) current: &'a PoseRow,
    pub(super) previous: &'a PoseRow,
}
