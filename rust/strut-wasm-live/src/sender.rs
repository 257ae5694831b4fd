//! What a sender's numbers mean: its skeleton, and from that to poses.

use strut_core::humanoid::{POSE_FLOATS, Pose, Proportions};
use strut_core::math::{Quat, Vec3};
use strut_core::motion::Motion;
use strut_core::retarget::{BindError, Binding, CharacterFacts, ReadAs, ToHumanoid};
use strut_core::skeleton::{Joint, Skeleton};
use strut_core::stream::{LANDMARKS, Landmark, LandmarkFit};
use strut_formats::bvh::{self, Bvh, MAX_ABS_VALUE};
use strut_wasm_common::EngineError;

/// Least and greatest |q|² of a rotation that was sent.
const SQUARES: std::ops::RangeInclusive<f32> = 0.25..=4.0;
/// Numbers of a landmark: x, y, z and visibility.
const LANDMARK_FLOATS: usize = 4;

/// How a sender's frames become poses on the body of a database.
pub(crate) enum Sender {
    /// They are such poses.
    Poses,
    /// The place of joint 0 and the local rotation of every joint.
    Joints(Box<Rig>),
    /// Channels of a BVH file.
    Channels(Box<Channels>),
    /// Landmarks of a camera.
    Landmarks(Box<Camera>),
}

/// A skeleton that was bound, and its transforms in a frame.
pub(crate) struct Rig {
    retarget: ToHumanoid,
    translations: Vec<Vec3>,
    rotations: Vec<Quat>,
}

/// The joints of a BVH file, which are bound with their first frame.
pub(crate) struct Channels {
    file: Bvh,
    row: Vec<f64>,
    rig: Option<Rig>,
}

/// A camera that sees a body.
pub(crate) struct Camera {
    fit: LandmarkFit,
    /// Whether its picture is mirrored.
    mirrored: bool,
    sent_secs: Option<f64>,
}

/// The binding of a sender's skeleton. One frame does not show where the floor is: a `LiveFloor` finds it.
fn bind(frame: &Motion) -> Result<Binding, BindError> {
    Binding::read(frame, &ReadAs { floor_metres: Some(0.0), ..ReadAs::default() })
}

impl Sender {
    /// Of a skeleton: without a unit the size of the body tells it.
    pub(crate) fn of_joints(
        names: Vec<String>,
        parents: &[i32],
        offsets: &[f32],
        metres_per_unit: Option<f32>,
        body: &Proportions,
    ) -> Result<Self, EngineError> {
        let (offsets, rest) = offsets.as_chunks::<3>();
        if parents.len() != names.len() || offsets.len() != names.len() || !rest.is_empty() {
            return Err(EngineError::bad_input("every joint needs a name, a parent and an offset"));
        }
        if metres_per_unit.is_some_and(|unit| !(unit.is_finite() && unit > 0.0)) {
            return Err(EngineError::bad_input("a unit must be a positive number of metres"));
        }
        let joints = names.into_iter().zip(parents).zip(offsets).map(|((name, parent), offset)| Joint {
            name,
            parent: usize::try_from(*parent).ok(),
            offset: Vec3::from_array(*offset),
            end: None,
        });
        let skeleton = Skeleton::new(joints.collect()).map_err(|e| EngineError::bad_file(e, ""))?;
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

    /// Of what stands before the frames of a BVH file.
    pub(crate) fn of_bvh(header: &str) -> Result<Self, EngineError> {
        let file = bvh::parse_hierarchy(header.as_bytes()).map_err(|e| EngineError::bad_file(e, ""))?;
        Ok(Self::Channels(Box::new(Channels { row: vec![0.0; file.channels()], file, rig: None })))
    }

    /// Of a camera.
    pub(crate) fn of_camera(mirrored: bool, body: &Proportions) -> Self {
        Self::Landmarks(Box::new(Camera { fit: LandmarkFit::new(body), mirrored, sent_secs: None }))
    }

    /// Numbers of a frame.
    pub(crate) fn floats(&self) -> usize {
        match self {
            Self::Poses => POSE_FLOATS,
            Self::Joints(rig) => 3 + 4 * rig.rotations.len(),
            Self::Channels(channels) => channels.row.len(),
            Self::Landmarks(_) => LANDMARKS * LANDMARK_FLOATS,
        }
    }

    /// Whether a skeleton moved over the ground in the last frame: hips that are sent as zero are a body without a root. `None`
    /// where poses stand on the ground already.
    pub(crate) fn has_root(&self) -> Option<bool> {
        let rig = match self {
            Self::Joints(rig) => Some(&**rig),
            Self::Channels(channels) => channels.rig.as_ref(),
            Self::Poses | Self::Landmarks(_) => None,
        };
        rig.map(|rig| rig.translations.first() != Some(&Vec3::ZERO))
    }

    /// The pose of a frame; `None` where its numbers cannot be one.
    ///
    /// # Errors
    /// If the skeleton is no body's, which only the first frame of a BVH file may show.
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
            // A point that is hidden need not have numbers.
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

/// A pose of numbers; `None` where a rotation is none.
pub(crate) fn pose_of(numbers: &[f32; POSE_FLOATS]) -> Option<Pose> {
    let rotations = numbers[3..].as_chunks::<4>().0;
    let are_rotations = rotations.iter().all(|q| unit(Quat::from_array(*q)).is_some());
    are_rotations.then(|| Pose::read_from(numbers))
}

/// The rotation of a quaternion that is about as long as it should be.
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
    /// Of a BVH file, of which one frame is known.
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
        // Who is seen in a mirror has left and right exchanged.
        if self.mirrored { pose.mirrored() } else { pose }
    }
}
