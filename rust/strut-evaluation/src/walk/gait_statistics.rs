//! Gait statistics of a synthesised walk.

use std::sync::Arc;
use strut_core::hsmm::RATE_HZ;
use strut_core::hsmm::WalkModel;
use strut_core::hsmm::{RuntimeWalkModel, Walker, WeightsError};
use strut_core::humanoid::{Pose, Role};
use strut_core::kinematics::world_from_local;
use strut_core::math::Vec3;
use strut_core::math::float_funcs::atan2;

/// Gait statistics, averaged over the steps of a walk.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GaitStatistics {
    /// Duration of a step, seconds.
    pub step_secs: f64,
    /// Length of a step, metres.
    pub step_length: f64,
    /// Walking speed, metres per second.
    pub speed: f64,
    /// Lean of the chest, forward from upright, degrees.
    pub lean: f64,
    /// Pitch of the head, down from level, degrees.
    pub head_pitch: f64,
}

impl GaitStatistics {
    /// The statistics with their names.
    pub fn named(&self) -> [(&'static str, f64); 5] {
        [
            ("step duration", self.step_secs),
            ("step length", self.step_length),
            ("speed", self.speed),
            ("torso lean", self.lean),
            ("head pitch", self.head_pitch),
        ]
    }

    /// Measures a number of steps in a style, at least one.
    ///
    /// # Errors
    /// See [`WeightsError`].
    pub fn of(
        model: &WalkModel,
        runtime: &Arc<RuntimeWalkModel>,
        weights: &[f32],
        steps: u64,
    ) -> Result<Self, WeightsError> {
        let steps = steps.max(1);
        let mut walker = Walker::new(Arc::clone(runtime));
        walker.set_styles(weights)?;
        walker.reset(Vec3::ZERO, 0.0);
        let mut poses: Vec<Pose> = Vec::new();
        // The first two steps are excluded as the start.
        while walker.next_step() < steps + 2 {
            let pose = *walker.advance();
            if walker.step().0 >= 2 {
                poses.push(pose);
            }
        }
        let frames = poses.len() as f64;
        let (first, last) = (poses[0].root, poses[poses.len() - 1].root);
        let way = f64::from((last - first).length()) * frames / (frames - 1.0);
        let secs = frames / f64::from(RATE_HZ);
        let pitch = |role: Role, axis: Vec3, level: fn(Vec3) -> f32| {
            let of = |pose: &Pose| level(world_from_local(&model.proportions, pose).rotations[role.index()] * axis);
            f64::from(poses.iter().map(of).sum::<f32>().to_degrees()) / frames
        };
        Ok(Self {
            step_secs: secs / steps as f64,
            step_length: way / steps as f64,
            speed: way / secs,
            lean: pitch(Role::Chest, Vec3::Y, |up| atan2(up.z, up.y)),
            head_pitch: pitch(Role::Head, Vec3::Z, |ahead| atan2(-ahead.y, ahead.z)),
        })
    }
}
