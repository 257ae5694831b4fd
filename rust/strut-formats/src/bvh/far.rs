//! Bodies far from the origin of their file, as in georeferenced scenes and game worlds.
//!
//! At ten kilometres from the origin single precision has a resolution of about a millimetre in a file in centimetres.
//! The median position of such a body is subtracted in double precision when the file is converted to a motion, and
//! added when a motion is converted to the file.

use super::{Bvh, Channel};
use strut_core::math::stats::median;

/// A body is far if its median position is farther from the origin than this many times the length of all its bones:
/// about 20 m, which no recording of `../shared/data` comes near.
const FAR: f64 = 3.0;
/// Minimum number of joints of a body (`strut_core::retarget`). The bone length of smaller skeletons is not meaningful.
const BODY_JOINTS: usize = 14;

/// Position subtracted from the translations of a joint, in the file's unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Far {
    /// Joint that carries the body.
    pub(super) joint: usize,
    /// One value for each axis of the parent's frame; 0 on axes on which the body is near the origin.
    pub(super) place: [f64; 3],
}

impl Bvh {
    /// Position of the body if it is far from the origin of the file in all frames.
    ///
    /// The joint is the first one that is far and whose ancestors do not move, so that a constant in its parent's frame
    /// is also a constant in the world.
    pub(super) fn far(&self) -> Option<Far> {
        let threshold = FAR * self.bone_length();
        let channels = self.channels();
        // The comparison also rejects a skeleton with lengths that are NaN.
        if !(threshold > 0.0 && self.frames > 0 && self.joints.len() >= BODY_JOINTS) {
            return None;
        }
        let mut first = 0;
        let mut keeps_still = vec![true; self.joints.len()];
        for (j, joint) in self.joints.iter().enumerate() {
            let columns = first..first + joint.channels.len();
            first = columns.end;
            if joint.parent.is_some_and(|parent| !keeps_still[parent]) {
                keeps_still[j] = false;
                continue;
            }
            let column = |c: usize| self.values.iter().skip(c).step_by(channels).copied();
            let mut place = joint.offset;
            for (channel, c) in joint.channels.iter().zip(columns.clone()) {
                if let Channel::Position(axis) = channel {
                    let is_far = column(c).all(|value| value.abs() > threshold);
                    place[*axis as usize] = if is_far { median(column(c)).unwrap_or(0.0) } else { 0.0 };
                }
            }
            let place = place.map(|at| if at.abs() > threshold { at } else { 0.0 });
            if place != [0.0; 3] {
                return Some(Far { joint: j, place });
            }
            keeps_still[j] = columns.clone().all(|c| {
                let start = self.values[c];
                column(c).all(|value| value == start)
            });
        }
        None
    }

    /// Total length of the bones: the offsets of joints below the root that have no position channels, or of all joints
    /// below the root if every joint has them.
    fn bone_length(&self) -> f64 {
        let length = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
        let is_placed = |channels: &[Channel]| channels.iter().any(|c| matches!(c, Channel::Position(_)));
        let below_root = || self.joints.iter().filter(|joint| joint.parent.is_some());
        let bones: f64 = below_root().filter(|joint| !is_placed(&joint.channels)).map(|j| length(j.offset)).sum();
        if bones > 0.0 { bones } else { below_root().map(|joint| length(joint.offset)).sum() }
    }
}
