//! Driving: neutral motion that goes where a user steers, by motion matching over the neutral clips of a database
//! (`../shared/spec/live-driving.md`, part A). The stylizer takes its frames as input.
//!
//! [`DrivingClips`] are the clips in the frame of their root, [`Features`] what is compared, [`Matching`] the exact search
//! for the row that goes on best.

mod clips;
mod features;
mod matching;
mod smoothing;

pub use clips::{DrivingClip, DrivingClips, DrivingError, NeutralClip, RootMotion};
pub use features::{FEATURES, Features, HORIZONS_SECS, feature};
pub use matching::{Match, Matching};

#[cfg(test)]
mod tests {
    use super::NeutralClip;
    use crate::humanoid::{Pose, Proportions};
    use crate::math::{Quat, Vec3};

    /// Somebody who glides round a circle, 60 frames a second, from the origin towards +Z: `speed` m/s, `turn_rate` rad/s.
    pub(super) fn circle(frames: usize, speed: f32, turn_rate: f32) -> NeutralClip {
        let mut at = Proportions::default().offsets[0];
        let mut heading = 0.0_f32;
        let mut poses = Vec::new();
        for _ in 0..frames {
            let mut pose = Pose { root: at, ..Pose::default() };
            pose.rotations[0] = Quat::from_rotation_y(heading);
            poses.push(pose);
            heading += turn_rate / 120.0;
            at += Quat::from_rotation_y(heading) * Vec3::Z * (speed / 60.0);
            heading += turn_rate / 120.0;
        }
        let contacts = (0..frames).map(|frame| [frame % 60 < 35, frame % 60 > 25]).collect();
        NeutralClip { name: "circle".into(), poses, contacts }
    }
}
