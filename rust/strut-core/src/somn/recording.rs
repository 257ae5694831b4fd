//! Training clips: poses that face forward (`docs/methods/somn.md` §2).

use super::RATE_HZ;
use super::frame::Frame;
use crate::humanoid::{HumanoidMotion, Pose, Proportions, TooManyFrames};
use crate::kinematics::{WorldPose, world_from_local};
use crate::math::float_funcs::{atan2, cos, sin_cos, wrap_angle};
use crate::math::{Quat, Vec3};
use crate::pose_vector::heading_of;
use std::f32::consts::PI;
use std::ops::Range;
use thiserror::Error;

/// Rates that differ by at most this share are considered equal: files round their frame times.
const SAME_RATE: f32 = 1e-3;
/// Least distance from the first frame to the last of a travelling body, metres.
const LEAST_WAY: f32 = 1.0;
/// Greatest mean angle between the body's heading and a direction that can be its facing direction, radians.
const MOST_ASIDE: f32 = 25.0 * PI / 180.0;
/// Least mean speed of a body that travels on a curved path, m/s.
const LEAST_SPEED: f32 = 0.5;
/// Half-width of the window for smoothing directions and positions, frames: one second.
const HALF_WINDOW: usize = RATE_HZ as usize;

/// Error of a clip that is not a valid recording.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum RecordingError {
    /// It has too many frames at [`RATE_HZ`].
    #[error(transparent)]
    TooLong(#[from] TooManyFrames),
    /// It has no frame.
    #[error("the clip has no frame")]
    Empty,
    /// It contains a number that is not finite.
    #[error("frame {0} holds a number that is not finite")]
    NotFinite(usize),
}

/// A clip at [`RATE_HZ`] without its facing direction and its place on the floor.
#[derive(Clone, Debug, PartialEq)]
pub struct Recording {
    /// Its name.
    pub name: String,
    /// The body.
    pub proportions: Proportions,
    /// Poses that face +Z with the hips above the origin.
    pub poses: Vec<Pose>,
    /// Data for the measures, one per pose.
    pub frames: Vec<Frame>,
    /// Whether the body travels, and synthesised motion should travel too.
    pub travels: bool,
}

impl Recording {
    /// Creates a recording from a clip at any rate. The facing direction of a body that walks straight ahead is that of its
    /// travel, that of a body in place its mean heading, and that of any other body its heading averaged over two seconds.
    ///
    /// # Errors
    /// See [`RecordingError`].
    pub fn new(name: impl Into<String>, motion: &HumanoidMotion) -> Result<Self, RecordingError> {
        if let Some(frame) = motion.poses.iter().position(|pose| !pose.is_finite()) {
            return Err(RecordingError::NotFinite(frame + 1));
        }
        let resampled;
        let poses = if (motion.rate_hz / RATE_HZ - 1.0).abs() <= SAME_RATE {
            &motion.poses
        } else {
            resampled = motion.resampled(RATE_HZ)?.poses;
            &resampled
        };
        let (Some(first), Some(last)) = (poses.first(), poses.last()) else { return Err(RecordingError::Empty) };
        let proportions = motion.proportions;
        let headings = headings(poses.iter().map(|pose| world_from_local(&proportions, pose)));
        let speeds = speeds(poses);
        let mean_speed = speeds.iter().sum::<f32>() / speeds.len() as f32;

        let way = (last.root - first.root) * Vec3::new(1.0, 0.0, 1.0);
        let direction = atan2(way.x, way.z);
        let mean = mean_direction(headings.iter().map(|h| (1.0, *h)));
        let aside =
            |from: f32| headings.iter().map(|h| wrap_angle(h - from).abs()).sum::<f32>() / headings.len() as f32;
        let goes_ahead = way.length() >= LEAST_WAY && aside(direction) <= MOST_ASIDE;
        let stays = !goes_ahead && mean_speed < LEAST_SPEED;
        let facing: Vec<f32> = if goes_ahead {
            vec![direction; poses.len()]
        } else if stays && aside(mean) <= MOST_ASIDE {
            vec![mean; poses.len()]
        } else {
            (0..poses.len()).map(|t| mean_direction(window(t, poses.len()).map(|(w, i)| (w, headings[i])))).collect()
        };
        let poses: Vec<Pose> = poses
            .iter()
            .zip(&facing)
            .map(|(pose, facing)| {
                let mut turned = Pose { root: pose.root * Vec3::Y, ..*pose };
                turned.rotations[0] = Quat::from_rotation_y(-facing) * pose.rotations[0];
                turned
            })
            .collect();
        let frames = poses.iter().zip(&speeds).map(|(pose, speed)| Frame::new(&proportions, pose, *speed)).collect();
        Ok(Self { name: name.into(), proportions, poses, frames, travels: !stays })
    }

    /// Returns a range of its frames.
    ///
    /// # Panics
    /// If the range exceeds its frames.
    pub fn part(&self, range: Range<usize>) -> Self {
        Self {
            name: self.name.clone(),
            poses: self.poses[range.clone()].to_vec(),
            frames: self.frames[range].to_vec(),
            ..*self
        }
    }
}

/// Headings of a body, radians; a pose without a heading takes the previous one.
fn headings(worlds: impl Iterator<Item = WorldPose>) -> Vec<f32> {
    let mut last = 0.0;
    worlds
        .map(|world| {
            last = heading_of(&world).unwrap_or(last);
            last
        })
        .collect()
}

/// Speed of the body on the floor with steps smoothed out, m/s.
fn speeds(poses: &[Pose]) -> Vec<f32> {
    let smoothed: Vec<Vec3> = (0..poses.len())
        .map(|t| {
            let (sum, weight) = window(t, poses.len())
                .fold((Vec3::ZERO, 0.0), |(sum, weight), (w, i)| (sum + poses[i].root * w, weight + w));
            sum / weight * Vec3::new(1.0, 0.0, 1.0)
        })
        .collect();
    let last = smoothed.len() - 1;
    (0..smoothed.len())
        .map(|t| {
            let (before, after) = (t.saturating_sub(1), (t + 1).min(last));
            (smoothed[after] - smoothed[before]).length() * RATE_HZ / (after - before).max(1) as f32
        })
        .collect()
}

/// Hann window about a frame: weights and the indices of their frames.
fn window(t: usize, frames: usize) -> impl Iterator<Item = (f32, usize)> {
    let range = t.saturating_sub(HALF_WINDOW)..(t + HALF_WINDOW + 1).min(frames);
    range.map(move |i| (0.5 + 0.5 * cos(PI * t.abs_diff(i) as f32 / (HALF_WINDOW + 1) as f32), i))
}

/// The weighted mean direction.
fn mean_direction(weighted: impl Iterator<Item = (f32, f32)>) -> f32 {
    let (sin, cos) = weighted.fold((0.0, 0.0), |(s, c), (weight, angle)| {
        let (sin, cos) = sin_cos(angle);
        (s + weight * sin, c + weight * cos)
    });
    atan2(sin, cos)
}
