//! The input of a prediction.

use crate::pose_vector::PoseRow;

/// The degrees of freedom of the input at t and t−1.
#[derive(Clone, Copy, Debug)]
pub(super) struct Input<'a> {
    pub(super) current: &'a PoseRow,
    pub(super) previous: &'a PoseRow,
}
