//! Handle of an input motion.

#[cfg(feature = "files")]
use crate::common::bvh_of;
use crate::common::{EngineError, floats_of};
use crate::engine::database::Database;
#[cfg(feature = "files")]
use crate::engine::input_file::{FileRead, InputFile, texts_of};
use crate::engine::packed_motions::PackedMotions;
#[cfg(feature = "files")]
use js_sys::Function;
use strut_core::contact;
use strut_core::humanoid::{HumanoidMotion, TooManyFrames};
#[cfg(feature = "files")]
use strut_core::note::Note;
use strut_core::transfer::ClipInput;
#[cfg(feature = "files")]
use strut_core::transfer::StyledMotion;
use wasm_bindgen::prelude::wasm_bindgen;

/// A motion on a database's humanoid and at its rate, with the file that it came from.
#[wasm_bindgen]
#[derive(Clone)]
pub struct Input {
    clip: ClipInput,
    /// Warnings.
    #[cfg(feature = "files")]
    notes: Vec<Note>,
    #[cfg(feature = "files")]
    file: Option<InputFile>,
}

#[wasm_bindgen]
impl Input {
    /// Reads an input of packed motions.
    ///
    /// # Errors
    /// If there is no input with this name, or the bytes are invalid; without the feature `files` also for a database of
    /// another body.
    #[wasm_bindgen(js_name = fromPacked)]
    pub fn from_packed(database: &Database, motions: &PackedMotions, name: &str) -> Result<Self, EngineError> {
        let motion = motions.input(name)?;
        let db = database.model().catalogue();
        if motion.proportions == db.proportions {
            motion.resampled(db.rate_hz).map(Self::of_motion).map_err(too_long)
        } else {
            Self::on_another_body(database, &motion)
        }
    }

    /// Returns the number of frames.
    pub fn frames(&self) -> usize {
        self.clip.motion.poses.len()
    }

    /// Returns the poses.
    pub fn poses(&self) -> Vec<f32> {
        floats_of(self.clip.motion.poses.iter())
    }

    /// Returns the foot contacts of the input, left and right interleaved, 1 while planted.
    pub fn contacts(&self) -> Vec<u8> {
        contact::label(&self.clip.motion).into_iter().flat_map(|c| c.map(u8::from)).collect()
    }
}

#[cfg(feature = "files")]
#[wasm_bindgen]
impl Input {
    /// Reads a BVH file. `said` returns explicit reading options for a skeleton's identity: lines of
    /// `strut_formats::reading`.
    ///
    /// # Errors
    /// If the bytes or the options are invalid.
    #[wasm_bindgen(js_name = fromBvh)]
    pub fn from_bvh(database: &Database, bytes: &[u8], said: &Function) -> Result<Self, EngineError> {
        Self::from_file(database, InputFile::read_as(bytes, said)?)
    }

    /// Returns sentences on the joint mapping; empty if there are none.
    pub fn note(&self) -> String {
        self.file.as_ref().map(InputFile::note).unwrap_or_default()
    }

    /// Returns warnings: codes and sentences, alternately.
    pub fn notes(&self) -> Vec<String> {
        texts_of(&self.notes)
    }

    /// Returns how the file was read; `undefined` without a file.
    pub fn read(&self) -> Option<FileRead> {
        self.file.as_ref().map(InputFile::read)
    }
}

#[cfg(feature = "files")]
impl Input {
    pub(crate) fn from_file(database: &Database, file: InputFile) -> Result<Self, EngineError> {
        let db = database.model().catalogue();
        let clip = ClipInput::new(file.on_body(&db.proportions), db.rate_hz).map_err(too_long)?;
        let mut notes = file.doubts().to_vec();
        notes.extend(clip.notes());
        Ok(Self { clip, notes, file: Some(file) })
    }

    pub(crate) fn clip(&self) -> &ClipInput {
        &self.clip
    }

    pub(crate) fn humanoid(&self) -> &HumanoidMotion {
        &self.clip.motion
    }

    /// Returns this input in a style as a BVH file: on the input's own skeleton and at its own rate, or on the
    /// database's humanoid if there is no file.
    ///
    /// # Errors
    /// If the styled motion is not finite, which the engine prevents.
    pub(crate) fn export(&self, styled: &StyledMotion) -> Result<String, EngineError> {
        let HumanoidMotion { proportions, rate_hz, .. } = &self.clip.motion;
        match &self.file {
            None => bvh_of(&styled.on_body(proportions, *rate_hz).motion),
            Some(file) => file.export(styled, *rate_hz),
        }
    }
}

impl Input {
    /// Creates an input from a motion without a file.
    fn of_motion(humanoid: HumanoidMotion) -> Self {
        Self {
            clip: ClipInput::whole(humanoid),
            #[cfg(feature = "files")]
            notes: Vec::new(),
            #[cfg(feature = "files")]
            file: None,
        }
    }

    /// Creates an input from a motion without a file, on the body of a database.
    ///
    /// # Errors
    /// If it is too long at the database's rate.
    #[cfg(feature = "files")]
    fn on_another_body(database: &Database, motion: &HumanoidMotion) -> Result<Self, EngineError> {
        Ok(Self::of_motion(Self::from_file(database, InputFile::of_motion(motion)?)?.clip.motion))
    }

    #[cfg(not(feature = "files"))]
    fn on_another_body(_: &Database, _: &HumanoidMotion) -> Result<Self, EngineError> {
        Err(EngineError::bad_input("this package cannot retarget a motion to another body"))
    }

    /// Creates an input from poses without a file.
    #[cfg(any(feature = "bench", feature = "neutral-clips", feature = "learn"))]
    pub(crate) fn of_poses(
        proportions: strut_core::humanoid::Proportions,
        rate_hz: f32,
        poses: Vec<strut_core::humanoid::Pose>,
    ) -> Self {
        Self::of_motion(HumanoidMotion { proportions, rate_hz, poses })
    }

    #[cfg(feature = "parity")]
    pub(crate) fn poses_mut(&mut self) -> &mut Vec<strut_core::humanoid::Pose> {
        &mut self.clip.motion.poses
    }
}

fn too_long(error: TooManyFrames) -> EngineError {
    EngineError::bad_file(error, "Cut the clip into shorter ones, or drop another file.")
}
