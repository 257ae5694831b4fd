//! Bodies far from the origin of their file, as georeferenced scenes and game worlds have them.
//!
//! Ten kilometres from the origin single precision leaves a millimetre of a centimetre file's step. The usual place of such
//! a body is subtracted in double precision where the file becomes a motion, and added where a motion becomes the file.

use super::{Bvh, Channel};

/// A body is far where its usual place is farther from the origin than this many times the length of all its bones: about
/// 20 m, which no recording of `../shared/data` comes near.
const FAR: f64 = 3.0;
/// Fewest joints of a body (`strut_core::retarget`); the length of the bones of less says nothing.
const BODY_JOINTS: usize = 14;

/// What is subtracted of the translations of a joint, in the file's unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Far {
    /// The joint that carries the body.
    pub(super) joint: usize,
    /// By axis of its parent's frame; 0 on axes on which the body is near.
    pub(super) place: [f64; 3],
}

impl Bvh {
    /// Where the body is, if it is far from the origin of the file in all frames.
    ///
    /// It is the first joint that is far and whose ancestors keep still, so that a constant in its parent's frame is one in
    /// the world.
    pub(super) fn far(&self) -> Option<Far> {
        let threshold = FAR * self.bone_length();
        let channels = self.channels();
        // Also refuses a skeleton whose lengths are no numbers.
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
                    place[*axis as usize] = if is_far { median(column(c).collect()) } else { 0.0 };
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

    /// Length of all bones: offsets of joints below the root that have no position channels, or of all below it where
    /// every joint has them.
    fn bone_length(&self) -> f64 {
        let length = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
        let is_placed = |channels: &[Channel]| channels.iter().any(|c| matches!(c, Channel::Position(_)));
        let below_root = || self.joints.iter().filter(|joint| joint.parent.is_some());
        let bones: f64 = below_root().filter(|joint| !is_placed(&joint.channels)).map(|j| length(j.offset)).sum();
        if bones > 0.0 { bones } else { below_root().map(|joint| length(joint.offset)).sum() }
    }
}

/// The middle of numbers; 0 of none.
fn median(mut values: Vec<f64>) -> f64 {
    let middle = values.len() / 2;
    if values.is_empty() { 0.0 } else { *values.select_nth_unstable_by(middle, f64::total_cmp).1 }
}
