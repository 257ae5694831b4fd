//! Converts the motion of any skeleton to a BVH file.

use super::{Axis, Bvh, BvhError, Channel, Joint, parse_hierarchy, write};
use strut_core::math::Vec3;
use strut_core::motion::Motion;

impl Bvh {
    /// A motion as a file: joints in an order in which subtrees are contiguous, rotations about Z, X and Y on each, and
    /// positions on the root and on joints whose translation differs from the offset.
    ///
    /// # Errors
    /// [`BvhError::UnwritableJoint`] if a name or an offset could not be read back, and the errors of [`Bvh::with_motion`].
    pub fn from_motion(motion: &Motion) -> Result<Self, BvhError> {
        let joints = motion.skeleton.joints();
        let order = contiguous(motion);
        let place = |joint: usize| order.iter().position(|other| *other == joint);
        let moves = |joint: usize| {
            let offset = joints[joint].offset;
            (0..motion.frames()).any(|frame| motion.translations_at(frame)[joint] != offset)
        };
        let of = |&joint: &usize| {
            let parent = joints[joint].parent;
            let positions = if parent.is_none() || moves(joint) { &[Axis::X, Axis::Y, Axis::Z][..] } else { &[] };
            let rotations = [Axis::Z, Axis::X, Axis::Y].map(Channel::Rotation);
            Joint {
                name: joints[joint].name.clone(),
                name_bytes: None,
                parent: parent.and_then(place),
                offset: joints[joint].offset.to_array().map(f64::from),
                channels: positions.iter().copied().map(Channel::Position).chain(rotations).collect(),
                end_site: joints[joint].end.map(|end: Vec3| end.to_array().map(f64::from)),
            }
        };
        let joints = order.iter().map(of).collect();
        let frame_time_secs = motion.frame_time_secs;
        let rest = Self { joints, added_positions: false, frame_time_secs, frames: 0, values: Vec::new() };
        rest.check_joints()?;
        let (mut translations, mut rotations) = (Vec::new(), Vec::new());
        for frame in 0..motion.frames() {
            translations.extend(order.iter().map(|&joint| motion.translations_at(frame)[joint]));
            rotations.extend(order.iter().map(|&joint| motion.rotations_at(frame)[joint]));
        }
        let skeleton = rest.to_motion()?.skeleton;
        rest.with_motion(&Motion::new(skeleton, frame_time_secs, translations, rotations)?)
    }
}

impl Bvh {
    /// Returns an error for the first joint that would not be read back as it is written.
    fn check_joints(&self) -> Result<(), BvhError> {
        for joint in &self.joints {
            // Each joint is tested alone, so that the error can name it.
            let alone = Joint { parent: None, ..joint.clone() };
            let file = Self { joints: vec![alone], values: Vec::new(), ..*self };
            if !parse_hierarchy(&write(&file)).is_ok_and(|read| read.joints == file.joints) {
                return Err(BvhError::UnwritableJoint { joint: joint.name.clone() });
            }
        }
        Ok(())
    }
}

/// The joints, each followed by its subtree.
fn contiguous(motion: &Motion) -> Vec<usize> {
    let mut order = Vec::with_capacity(motion.skeleton.len());
    let mut rest = vec![0];
    while let Some(joint) = rest.pop() {
        order.push(joint);
        let below = rest.len();
        rest.extend(motion.skeleton.children(joint));
        rest[below..].reverse();
    }
    order
}

#[cfg(test)]
mod tests {
    use super::*;
    use strut_core::math::Quat;
    use strut_core::skeleton::{self, Skeleton};

    #[test]
    fn what_could_not_be_read_back_is_refused() {
        let of = |name: &str, x: f32, frames: usize, frame_time_secs: f64| {
            let joint =
                |name: &str, parent| skeleton::Joint { name: name.into(), parent, offset: Vec3::X * x, end: None };
            let skeleton = Skeleton::new(vec![joint("hips", None), joint(name, Some(0))]).unwrap();
            let (translations, rotations) = (vec![Vec3::X * x; 2 * frames], vec![Quat::IDENTITY; 2 * frames]);
            Bvh::from_motion(&Motion::new(skeleton, frame_time_secs, translations, rotations).unwrap())
        };
        for name in ["spine", "left arm", "naïve", "b{r", "1"] {
            let file = of(name, 1.0, 2, 0.01).unwrap();
            let file = super::super::parse(&super::super::write(&file)).unwrap();
            assert_eq!(file.joints[1].name, name);
        }
        let long = "n".repeat(super::super::MAX_NAME_BYTES + 1);
        for name in ["", " ", "two\nlines", "two\rlines", "with\ttab", "brace {", " before", "after ", long.as_str()] {
            let refused = Err(BvhError::UnwritableJoint { joint: name.into() });
            assert_eq!(of(name, 1.0, 2, 0.01), refused);
        }
        for x in [1e8, -2e7] {
            assert!(of("spine", x, 2, 0.01).is_err(), "{x}");
        }
        assert_eq!(of("spine", 1.0, 0, 0.01), Err(BvhError::UnwritableFrames { frames: 0, joints: 2 }));
        assert!(of("spine", 1.0, super::super::MAX_FRAMES + 1, 0.01).is_err());
        for secs in [1e-5, 11.0] {
            assert_eq!(of("spine", 1.0, 2, secs), Err(BvhError::UnwritableFrameTime { secs }));
        }
    }

    #[test]
    fn joints_in_any_order_are_written_and_read_back() {
        let joint = |name: &str, parent, x| skeleton::Joint {
            name: name.into(),
            parent,
            offset: Vec3::new(x, 1.0, 0.0),
            end: None,
        };
        let joints = vec![
            joint("hips", None, 0.0),
            joint("left", Some(0), 1.0),
            joint("right", Some(0), 2.0),
            joint("left end", Some(1), 3.0),
            joint("right end", Some(2), 4.0),
        ];
        let skeleton = Skeleton::new(joints).unwrap();
        let mut translations: Vec<Vec3> =
            (0..2).flat_map(|_| skeleton.joints().iter().map(|j| j.offset).collect::<Vec<_>>()).collect();
        translations[9] = Vec3::new(5.0, 6.0, 7.0);
        let rotations = (0..10).map(|i| Quat::from_rotation_y(0.1 * i as f32)).collect();
        let motion = Motion::new(skeleton, 0.01, translations, rotations).unwrap();
        let file = Bvh::from_motion(&motion).unwrap();
        let file = super::super::parse(&super::super::write(&file)).unwrap();
        let names: Vec<&str> = file.joints.iter().map(|j| j.name.as_str()).collect();
        assert_eq!(names, ["hips", "left", "left end", "right", "right end"]);
        let back = file.to_motion().unwrap();
        assert_eq!(back.translations_at(1)[4], Vec3::new(5.0, 6.0, 7.0));
        assert_eq!(file.joints[2].channels.len(), 3, "it keeps to its offset");
        for (joint, of) in [0, 1, 3, 2, 4].into_iter().enumerate() {
            assert!(back.rotations_at(1)[joint].inv_mul(motion.rotations_at(1)[of]).angle() < 1e-6);
        }
    }
}
