//! The format of a sender's numbers, and their conversion to poses.

use crate::common::{EngineError, skeleton_of};
use strut_core::humanoid::{POSE_FLOATS, Pose, Proportions};
use strut_core::math::{Quat, Vec3};
use strut_core::motion::Motion;
use strut_core::retarget::{BindError, Binding, CharacterFacts, ReadAs, ToHumanoid};
use strut_core::stream::{LANDMARKS, Landmark, LandmarkFit};
use strut_formats::bvh::{self, Bvh, MAX_ABS_VALUE};

/// Range of |q|² of a rotation that is accepted.
const SQUARES: std::ops::RangeInclusive<f32> = 0.25..=4.0;
/// Numbers per landmark: x, y, z and visibility.
const LANDMARK_FLOATS: usize = 4;

/// Conversion of a sender's frames to poses on the body of a database.
pub(crate) enum Sender {
    /// Poses on that body.
    Poses,
    /// The position of joint 0 and the local rotation of every joint.
    Joints(Box<Rig>),
    /// Channels of a BVH file.
    Channels(Box<Channels>),
    /// Landmarks of a camera image.
    Landmarks(Box<Camera>),
}

/// A bound skeleton, and its transforms in a frame.
pub(crate) struct Rig {
    retarget: ToHumanoid,
    translations: Vec<Vec3>,
    rotations: Vec<Quat>,
}

/// The joints of a BVH file, which are bound with the first frame.
pub(crate) struct Channels {
    file: Bvh,
    row: Vec<f64>,
    rig: Option<Rig>,
}

/// Pose estimation from a camera.
pub(crate) struct Camera {
    fit: LandmarkFit,
    /// Whether the image is mirrored.
    mirrored: bool,
    sent_secs: Option<f64>,
}

/// Binds a sender's skeleton. One frame does not show the height of the floor: a `LiveFloor` finds it.
fn bind(frame: &Motion) -> Result<Binding, BindError> {
    Binding::read(frame, &ReadAs { floor_metres: Some(0.0), ..ReadAs::default() })
}

impl Sender {
    /// Creates the sender of a skeleton. Without a unit, the unit follows from the size of the body.
    pub(crate) fn of_joints(
        names: Vec<String>,
        parents: &[i32],
        offsets: &[f32],
        metres_per_unit: Option<f32>,
        body: &Proportions,
    ) -> Result<Self, EngineError> {
        let skeleton = skeleton_of(names, parents, offsets)?;
        if metres_per_unit.is_some_and(|unit| !(unit.is_finite() && unit > 0.0)) {
            return Err(EngineError::bad_input("a unit must be a positive number of metres"));
        }
        let translations: Vec<Vec3> = skeleton.joints().iter().map(|joint| joint.offset).collect();
        let rotations = vec![Quat::IDENTITY; translations.len()];
        let binding = match metres_per_unit {
            Some(metres_per_unit) => {
                let facts = CharacterFacts { metres_per_unit, sole_height: None, roles: Default::default() };
                Binding::of_character(&skeleton, &facts)
            }
            None => bind(&Motion {
                skeleton,
                frame_time_secs: 1.0,
                translations: translations.clone(),
                rotations: rotations.clone(),
            }),
        };
        let binding = binding.map_err(|e| EngineError::bad_file(e, ""))?;
        Ok(Self::Joints(Box::new(Rig { retarget: ToHumanoid::new(&binding, body), translations, rotations })))
    }

    /// Creates the sender of a BVH file from its header.
    pub(crate) fn of_bvh(header: &str) -> Result<Self, EngineError> {
        let file = bvh::parse_hierarchy(header.as_bytes()).map_err(|e| EngineError::bad_file(e, ""))?;
        Ok(Self::Channels(Box::new(Channels { row: vec![0.0; file.channels()], file, rig: None })))
    }

    /// Creates the sender of a camera.
    pub(crate) fn of_camera(mirrored: bool, body: &Proportions) -> Self {
        Self::Landmarks(Box::new(Camera { fit: LandmarkFit::new(body), mirrored, sent_secs: None }))
    }

    /// Returns the number of floats per frame.
    pub(crate) fn floats(&self) -> usize {
        match self {
            Self::Poses => POSE_FLOATS,
            Self::Joints(rig) => 3 + 4 * rig.rotations.len(),
            Self::Channels(channels) => channels.row.len(),
            Self::Landmarks(_) => LANDMARKS * LANDMARK_FLOATS,
        }
    }

    /// Returns whether the skeleton's root moved in the last frame: a body without root motion sends its hips as zero.
    /// `None` for poses, which already stand on the ground.
    pub(crate) fn has_root(&self) -> Option<bool> {
        let rig = match self {
            Self::Joints(rig) => Some(&**rig),
            Self::Channels(channels) => channels.rig.as_ref(),
            Self::Poses | Self::Landmarks(_) => None,
        };
        rig.map(|rig| rig.translations.first() != Some(&Vec3::ZERO))
    }

    /// Returns the pose of a frame, or `None` if its numbers are invalid.
    ///
    /// # Errors
    /// If the skeleton is not a body, which may appear only with the first frame of a BVH file.
    pub(crate) fn pose(
        &mut self,
        sent_secs: f64,
        numbers: &[f32],
        body: &Proportions,
    ) -> Result<Option<Pose>, EngineError> {
        let is_number = |n: &f32| n.is_finite() && f64::from(n.abs()) <= MAX_ABS_VALUE;
        if numbers.len() != self.floats() {
            return Ok(None);
        }
        if let Self::Landmarks(camera) = self {
            // A hidden landmark need not have finite numbers.
            return Ok(Some(camera.pose(sent_secs, numbers)));
        }
        if !numbers.iter().all(is_number) {
            return Ok(None);
        }
        match self {
            Self::Poses => Ok(numbers.try_into().ok().and_then(pose_of)),
            Self::Joints(rig) => Ok(rig.pose(numbers)),
            Self::Channels(channels) => channels.pose(numbers, body).map(Some),
            Self::Landmarks(_) => Ok(None),
        }
    }
}

/// Reads a pose from numbers. Returns `None` if a rotation is invalid.
pub(crate) fn pose_of(numbers: &[f32; POSE_FLOATS]) -> Option<Pose> {
    let rotations = numbers[3..].as_chunks::<4>().0;
    let are_rotations = rotations.iter().all(|q| unit(Quat::from_array(*q)).is_some());
    are_rotations.then(|| Pose::read_from(numbers))
}

/// Normalises a quaternion whose length is in the accepted range.
fn unit(q: Quat) -> Option<Quat> {
    let square: f32 = q.to_array().iter().map(|x| x * x).sum();
    SQUARES.contains(&square).then(|| q.normalized())
}

impl Rig {
    fn pose(&mut self, numbers: &[f32]) -> Option<Pose> {
        let (place, rotations) = numbers.split_first_chunk::<3>()?;
        for (to, from) in self.rotations.iter_mut().zip(rotations.as_chunks::<4>().0) {
            *to = unit(Quat::from_array(*from))?;
        }
        *self.translations.first_mut()? = Vec3::from_array(*place);
        Some(self.retarget.frame(&self.translations, &self.rotations))
    }
}

impl Channels {
    fn pose(&mut self, numbers: &[f32], body: &Proportions) -> Result<Pose, EngineError> {
        for (to, from) in self.row.iter_mut().zip(numbers) {
            *to = f64::from(*from);
        }
        let rig = match &mut self.rig {
            Some(rig) => rig,
            none => none.insert(Rig::of_first_frame(&self.file, &self.row, body)?),
        };
        let locals = rig.translations.iter_mut().zip(&mut rig.rotations);
        for ((translation, rotation), local) in locals.zip(self.file.transforms(&self.row)) {
            (*translation, *rotation) = local;
        }
        Ok(rig.retarget.frame(&rig.translations, &rig.rotations))
    }
}

impl Rig {
    /// Binds a BVH file with its first frame.
    fn of_first_frame(file: &Bvh, row: &[f64], body: &Proportions) -> Result<Self, EngineError> {
        let motion = Bvh { values: row.to_vec(), ..file.clone() }.to_motion();
        let motion = motion.map_err(|e| EngineError::bad_file(e, ""))?;
        let binding = bind(&motion).map_err(|e| EngineError::bad_file(e, ""))?;
        Ok(Self {
            retarget: ToHumanoid::new(&binding, body),
            translations: motion.translations,
            rotations: motion.rotations,
        })
    }
}

impl Camera {
    fn pose(&mut self, sent_secs: f64, numbers: &[f32]) -> Pose {
        let mut landmarks = [Landmark::default(); LANDMARKS];
        for (to, &[x, y, z, visibility]) in landmarks.iter_mut().zip(numbers.as_chunks::<LANDMARK_FLOATS>().0) {
            *to = Landmark { position: Vec3::new(x, y, z), visibility };
        }
        let before = self.sent_secs.replace(sent_secs).unwrap_or(sent_secs);
        let pose = self.fit.next(&landmarks, (sent_secs - before) as f32);
        // A mirrored image has left and right swapped.
        if self.mirrored { pose.mirrored() } else { pose }
    }
}
