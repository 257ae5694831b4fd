//! Clips of an action in the form that registration reads.

use crate::humanoid::JOINTS;
use crate::math::Vec3;
use crate::pose_vector::{HEADING_RATE, PoseRow};

/// A clip of an action in the form that registration reads. All arrays have one entry per frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Example {
    /// Index of the style.
    pub style: u16,
    /// Degrees of freedom.
    pub pose: Vec<PoseRow>,
    /// Heading-free joint positions, metres.
    pub point_cloud: Vec<[Vec3; JOINTS]>,
    /// Planted feet, left and right.
    pub contact: Vec<[bool; 2]>,
    /// Known correspondence: identifier of the script, and the strictly increasing script time in seconds.
    pub script: Option<(u32, Vec<f32>)>,
}

impl Example {
    /// Number of frames.
    pub fn frames(&self) -> usize {
        self.pose.len()
    }

    /// Change of heading over the clip, radians, positive to the left; whole turns are included.
    pub fn turn(&self, rate_hz: f32) -> f32 {
        self.pose.iter().skip(1).map(|row| row[HEADING_RATE]).sum::<f32>() / rate_hz
    }
}
