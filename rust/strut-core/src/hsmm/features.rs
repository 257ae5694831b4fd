//! Conversion of walks to degrees of freedom (`docs/methods/hsmm.md` §3).

use super::RATE_HZ;
use super::model::Observation;
use crate::humanoid::{HumanoidMotion, JOINTS, Pose, TooManyFrames};
use crate::kinematics::rotation_row::RotationRow;
use crate::kinematics::rotation_row::mean_rotations;
use crate::kinematics::{WorldPose, world_from_local};
use crate::math::float_funcs::atan2;
use crate::math::{Quat, Vec3};
use crate::pose_vector::heading_of;
use thiserror::Error;

pub use crate::kinematics::rotation_row::row_of;

/// Least travelled distance from which a heading can be computed, metres.
const LEAST_WAY: f32 = 0.3;
/// Greatest mean angle between the body's heading and its direction of travel, degrees.
const MOST_ASIDE: f32 = 25.0;
/// Rotations are averaged over every n-th frame.
const REFERENCE_STRIDE: usize = 4;

/// Error of a clip that is not a walk.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum TrackError {
    /// It has too many frames at [`RATE_HZ`].
    #[error(transparent)]
    TooLong(#[from] TooManyFrames),
    /// The body stays in place.
    #[error("the body travels {0:.2} m in total; a walk of at least {LEAST_WAY} m was expected")]
    NoWay(f32),
    /// The body does not face its direction of travel.
    #[error(
        "the body faces {0:.0}° away from its direction of travel on average; a forward walk, at most {MOST_ASIDE}° \
         off, was expected"
    )]
    Turns(f32),
}

/// A clip of walking straight ahead, at [`RATE_HZ`] and without its heading.
#[derive(Clone, Debug)]
pub struct Track {
    /// Poses that face +Z on average.
    pub poses: Vec<Pose>,
    /// Positions of the joints, metres.
    pub positions: Vec<[Vec3; JOINTS]>,
}

impl Track {
    /// Creates a track from a clip at any rate.
    ///
    /// # Errors
    /// See [`TrackError`].
    pub fn new(motion: &HumanoidMotion) -> Result<Self, TrackError> {
        let motion = motion.resampled(RATE_HZ)?;
        let way = match (motion.poses.first(), motion.poses.last()) {
            (Some(first), Some(last)) => (last.root - first.root) * Vec3::new(1.0, 0.0, 1.0),
            _ => Vec3::ZERO,
        };
        if way.length() < LEAST_WAY {
            return Err(TrackError::NoWay(way.length()));
        }
        let facing = Quat::from_rotation_y(-atan2(way.x, way.z));
        let poses: Vec<Pose> = motion
            .poses
            .iter()
            .map(|pose| {
                let mut turned = Pose { root: facing * pose.root, ..*pose };
                turned.rotations[0] = facing * pose.rotations[0];
                turned
            })
            .collect();
        let worlds: Vec<WorldPose> = poses.iter().map(|pose| world_from_local(&motion.proportions, pose)).collect();
        let aside = worlds.iter().filter_map(heading_of).map(|heading| heading.abs().to_degrees()).sum::<f32>();
        let aside = aside / worlds.len() as f32;
        if aside > MOST_ASIDE {
            return Err(TrackError::Turns(aside));
        }
        Ok(Self { poses, positions: worlds.into_iter().map(|world| world.positions).collect() })
    }

    /// Splits the track into halves.
    pub fn halves(&self) -> [Self; 2] {
        let middle = self.poses.len() / 2;
        let (poses, positions) = (self.poses.split_at(middle), self.positions.split_at(middle));
        [(poses.0, positions.0), (poses.1, positions.1)]
            .map(|(poses, positions)| Self { poses: poses.to_vec(), positions: positions.to_vec() })
    }

    /// The poses as exponential maps about a reference.
    pub(super) fn rows(&self, reference: &[Quat; JOINTS]) -> Vec<RotationRow> {
        self.poses.iter().map(|pose| row_of(reference, &pose.rotations)).collect()
    }
}

/// The mean rotation of every joint over clips: the centres of the exponential maps.
pub(super) fn reference(tracks: &[&Track]) -> [Quat; JOINTS] {
    mean_rotations(tracks.iter().flat_map(|track| &track.poses).step_by(REFERENCE_STRIDE))
}

/// Poses with velocities and accelerations per frame; beyond the ends the end frames are repeated.
pub(super) fn observations(rows: &[RotationRow]) -> Vec<Observation> {
    let at = |t: usize| {
        let (before, after) = (&rows[t.saturating_sub(1)], &rows[(t + 1).min(rows.len() - 1)]);
        let velocity = std::array::from_fn(|d| 0.5 * (after[d] - before[d]));
        let acceleration = std::array::from_fn(|d| after[d] - 2.0 * rows[t][d] + before[d]);
        [rows[t], velocity, acceleration]
    };
    (0..rows.len()).map(at).collect()
}
