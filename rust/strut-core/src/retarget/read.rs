//! Reading of a clip: its roles, axes, sides and floor, each detected from the body or set by the user.

use super::anatomy::four_legs;
use super::axes::is_mirrored;
use super::binding::{BindError, Binding, check_roles, leave_out_toes_without_length, move_hands_without_length};
use super::find_roles::find_roles;
use super::floor::floor_of;
use super::read_as::ReadAs;
use super::sample::Sample;
use crate::humanoid::JOINTS;
use crate::motion::Motion;
use crate::note::{Note, NoteCode};

/// Confidence from which joints count as found by name: below it a third of the limbs or more were found by shape.
const BY_NAME: f32 = 0.75;

impl Binding {
    /// Finds roles, rest pose, unit, axes and floor of a clip.
    ///
    /// # Errors
    /// See [`BindError`]; its messages are shown to users.
    pub fn detect(motion: &Motion) -> Result<Self, BindError> {
        Self::read(motion, &ReadAs::default())
    }

    /// Returns the joint of each role as far as it can be detected: a proposal for the user if [`Binding::detect`] is unsure
    /// or fails. All `None` for a clip without frames.
    pub fn likely_roles(motion: &Motion) -> [Option<usize>; JOINTS] {
        let sample = Sample::of(motion);
        if sample.is_empty() { [None; JOINTS] } else { find_roles(&motion.skeleton, &sample).joint_of_role }
    }

    /// Binds a clip with some properties set by the user; the rest is detected. The confidence in given joints is 1.
    ///
    /// # Errors
    /// See [`BindError`].
    pub fn read(motion: &Motion, read_as: &ReadAs) -> Result<Self, BindError> {
        let mut sample = Sample::of(motion);
        if sample.is_empty() {
            return Err(BindError::NoFrames);
        }
        let (mut roles, confidence) = read_as.joints.map_or_else(
            || {
                let found = find_roles(&motion.skeleton, &sample);
                (found.joint_of_role, found.confidence)
            },
            |joints| (joints, 1.0),
        );
        if roles.iter().all(Option::is_none) {
            return Err(BindError::NotHumanoid);
        }
        check_roles(&motion.skeleton, &roles)?;
        leave_out_toes_without_length(&sample, &mut roles);
        move_hands_without_length(&motion.skeleton, &sample, &mut roles);
        let found_mirrored = is_mirrored(&roles, &sample);
        let mirrored = read_as.mirrored.unwrap_or(found_mirrored != read_as.swap_sides);
        if mirrored {
            sample = Sample::of_mirror_image(motion);
        }
        let mut binding = Self::of(&motion.skeleton, &sample, &roles, confidence, None, read_as)?;
        match four_legs(&motion.skeleton, &roles, &sample, &binding.proportions) {
            Some(four_legs) if read_as.joints.is_none() => return Err(BindError::NotHuman(four_legs)),
            Some(_) => binding.doubts.push(Note::new(
                NoteCode::NotHuman,
                "This body stands on four legs; with the chosen joints it is animated as a human.",
            )),
            None => {}
        }
        if confidence < BY_NAME {
            binding.doubts.push(Note::new(
                NoteCode::JointsByShape,
                "Some joints could not be identified by their names. They were identified by the shape of the \
                 skeleton.",
            ));
        }
        binding.is_mirrored = mirrored;
        if found_mirrored {
            binding.doubts.push(Note::new(NoteCode::Mirrored, if mirrored {
                "Left and right are swapped in this file, as its toes and knees show. It was read as a mirror image \
                 and is written back the same way."
            } else {
                "If left and right are as this file names them, the toes and knees point backwards."
            }));
        }
        binding.find_floor(motion, read_as.floor_metres);
        Ok(binding)
    }

    /// Measures the height of a clip's ground, or takes the user's value.
    fn find_floor(&mut self, motion: &Motion, said: Option<f32>) {
        if let Some(height) = said {
            self.floor_metres = height;
            return;
        }
        let floor = floor_of(motion, self);
        self.floor_metres = floor.height;
        self.doubts.extend(floor.notes());
    }
}
