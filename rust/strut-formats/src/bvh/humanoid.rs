//! Converts a canonical humanoid to a BVH file.

use super::{Axis, Bvh, BvhError, Channel, Joint};
use strut_core::humanoid::{HumanoidMotion, Role};
use strut_core::math::Vec3;
use strut_core::motion::Motion;

/// Lengths are written in centimetres, as in most files.
const UNITS_PER_METRE: f32 = 100.0;

/// Joint names by role, as in Unity's and VRM's humanoids.
pub(crate) const NAMES: [&str; Role::ALL.len()] = [
    "Hips",
    "Spine",
    "Chest",
    "Neck",
    "Head",
    "LeftShoulder",
    "LeftUpperArm",
    "LeftLowerArm",
    "LeftHand",
    "RightShoulder",
    "RightUpperArm",
    "RightLowerArm",
    "RightHand",
    "LeftUpperLeg",
    "LeftLowerLeg",
    "LeftFoot",
    "LeftToes",
    "RightUpperLeg",
    "RightLowerLeg",
    "RightFoot",
    "RightToes",
];

/// End of the bone in the joint's frame, metres, for roles without a child bone. The end sites make the head, hands and
/// toes visible in other programs.
fn end_site(role: Role) -> Option<Vec3> {
    match role {
        Role::Head => Some(Vec3::new(0.0, 0.18, 0.0)),
        Role::LeftHand => Some(Vec3::new(0.16, 0.0, 0.0)),
        Role::RightHand => Some(Vec3::new(-0.16, 0.0, 0.0)),
        Role::LeftToes | Role::RightToes => Some(Vec3::new(0.0, 0.0, 0.07)),
        _ => None,
    }
}

impl Bvh {
    /// A humanoid's motion as a file: 21 joints whose zero pose is the T-pose, centimetres, six channels on the hips
    /// and three on every other joint.
    ///
    /// # Errors
    /// [`BvhError::Motion`] if the rate is not finite or not positive, [`BvhError::Skeleton`] if an offset is not
    /// finite, and the errors of [`Bvh::with_motion`].
    pub fn from_humanoid(motion: &HumanoidMotion) -> Result<Self, BvhError> {
        let cm = |v: Vec3| v * UNITS_PER_METRE;
        let rotations = [Axis::Z, Axis::X, Axis::Y].map(Channel::Rotation);
        let joints = Role::ALL.map(|role| {
            let root = role.parent().is_none();
            let positions = if root { &[Axis::X, Axis::Y, Axis::Z][..] } else { &[] };
            Joint {
                name: NAMES[role.index()].into(),
                name_bytes: None,
                parent: role.parent().map(Role::index),
                // The root's channels replace its offset.
                offset: if root { [0.0; 3] } else { rounded(cm(motion.proportions.offsets[role.index()])) },
                channels: positions.iter().copied().map(Channel::Position).chain(rotations).collect(),
                end_site: end_site(role).map(|e| rounded(cm(e))),
            }
        });
        let frame_time_secs = 1.0 / f64::from(motion.rate_hz);
        let rest =
            Self { joints: joints.to_vec(), added_positions: false, frame_time_secs, frames: 0, values: Vec::new() };
        let skeleton = rest.to_motion()?.skeleton;
        let offsets = motion.proportions.offsets.map(cm);
        let translations = motion.poses.iter().flat_map(|pose| {
            let mut translations = offsets;
            translations[0] = cm(pose.root);
            translations
        });
        let rotations = motion.poses.iter().flat_map(|pose| pose.rotations);
        rest.with_motion(&Motion::new(skeleton, frame_time_secs, translations.collect(), rotations.collect())?)
    }
}

/// A length rounded to six decimals, the resolution of `f32`.
fn rounded(v: Vec3) -> [f64; 3] {
    v.to_array().map(|v| (f64::from(v) * 1e6).round() / 1e6)
}

#[cfg(test)]
mod tests {
    use super::*;
    use strut_core::humanoid::{Pose, Proportions};
    use strut_core::math::Quat;

    #[test]
    fn what_could_not_be_read_back_is_refused() {
        let of = |frames: usize, rate_hz: f32| {
            let poses = vec![Pose::default(); frames];
            Bvh::from_humanoid(&HumanoidMotion { proportions: Proportions::default(), rate_hz, poses })
        };
        assert_eq!(of(0, 60.0), Err(BvhError::UnwritableFrames { frames: 0, joints: 21 }));
        assert!(matches!(of(2, 0.01), Err(BvhError::UnwritableFrameTime { .. })));
        assert!(matches!(of(2, 20_000.0), Err(BvhError::UnwritableFrameTime { .. })));
        assert!(of(1, 60.0).is_ok());
    }

    #[test]
    fn a_humanoid_is_written_in_centimetres_with_its_rotations() {
        let mut pose = Pose { root: Vec3::new(0.1, 0.9, -2.0), ..Pose::default() };
        pose.rotations[Role::LeftUpperArm.index()] = Quat::from_rotation_z(-1.2);
        let motion = HumanoidMotion { proportions: Proportions::default(), rate_hz: 60.0, poses: vec![pose; 3] };
        let file = Bvh::from_humanoid(&motion).unwrap();
        let file = super::super::parse(&super::super::write(&file)).unwrap();
        let back = file.to_motion().unwrap();
        assert_eq!((back.frames(), back.skeleton.len()), (3, Role::ALL.len()));
        assert!((back.translations_at(2)[0] - Vec3::new(10.0, 90.0, -200.0)).length() < 1e-4);
        for (a, b) in back.rotations_at(1).iter().zip(&pose.rotations) {
            assert!(a.inv_mul(*b).angle() < 1e-5);
        }
    }
}
