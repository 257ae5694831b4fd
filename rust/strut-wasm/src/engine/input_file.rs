//! BVH files of inputs.

use crate::common::EngineError;
use js_sys::Function;
use strut_core::humanoid::{HumanoidMotion, Proportions};
use strut_core::motion::Motion;
use strut_core::note::Note;
use strut_core::retarget::{Binding, UpAxis, to_humanoid};
use strut_core::skeleton::Skeleton;
use strut_core::transfer::StyledMotion;
use strut_formats::bvh::{self, Bvh, BvhError};
use strut_formats::joints::Reading;
use strut_formats::reading::{ReadingError, skeleton_id};
use wasm_bindgen::JsValue;
use wasm_bindgen::prelude::wasm_bindgen;

/// How a file was read.
#[wasm_bindgen]
pub struct FileRead {
    numbers: Vec<f64>,
    joints: Vec<String>,
    skeleton: String,
}

#[wasm_bindgen]
impl FileRead {
    /// Returns the number of frames, the frame rate, the index of the up axis in `UpAxis::ALL`, 1 for a mirror image,
    /// the height of the floor, metres per unit, the height of the body, the confidence of the joint mapping, then the
    /// joint of each role, −1 for none.
    pub fn numbers(&self) -> Vec<f64> {
        self.numbers.clone()
    }

    /// Returns the names of the joints.
    pub fn joints(&self) -> Vec<String> {
        self.joints.clone()
    }

    /// Returns the identity of the skeleton.
    pub fn skeleton(&self) -> String {
        self.skeleton.clone()
    }
}

/// Returns notes as codes and sentences, alternately.
pub(crate) fn texts_of(notes: &[Note]) -> Vec<String> {
    notes.iter().flat_map(|note| [note.code.name().to_owned(), note.text.to_string()]).collect()
}

/// The parts of a file that an export needs.
#[derive(Clone)]
pub(crate) struct InputFile {
    bvh: Bvh,
    motion: Motion,
    binding: Binding,
    /// Warnings about the reading.
    notes: Vec<Note>,
}

impl InputFile {
    /// Reads a BVH file with explicit reading options.
    ///
    /// # Errors
    /// If the bytes, the options or the skeleton are invalid.
    pub(crate) fn read_as(bytes: &[u8], said: &Function) -> Result<Self, EngineError> {
        let (bvh, notes) = bvh::parse_noted(bytes).map_err(unreadable)?;
        Self::of(bvh, notes, |skeleton| {
            let said = said.call1(&JsValue::NULL, &JsValue::from_str(&skeleton_id(skeleton)));
            Reading::parse(&said.ok().and_then(|said| said.as_string()).unwrap_or_default())
        })
    }

    /// Reads a BVH file without explicit options.
    ///
    /// # Errors
    /// If the bytes or the skeleton are invalid.
    #[cfg(feature = "parity")]
    pub(crate) fn detect(bytes: &[u8]) -> Result<Self, EngineError> {
        let (bvh, notes) = bvh::parse_noted(bytes).map_err(unreadable)?;
        Self::of(bvh, notes, |_| Ok(Reading::default()))
    }

    /// Creates the file that contains a motion.
    ///
    /// # Errors
    /// If there is no pose, or a number is out of the range of BVH files.
    pub(crate) fn of_motion(motion: &HumanoidMotion) -> Result<Self, EngineError> {
        Self::of(Bvh::from_humanoid(motion).map_err(unreadable)?, Vec::new(), |_| Ok(Reading::default()))
    }

    fn of(
        bvh: Bvh,
        mut notes: Vec<Note>,
        said: impl FnOnce(&Skeleton) -> Result<Reading, ReadingError>,
    ) -> Result<Self, EngineError> {
        let motion = bvh.to_motion().map_err(unreadable)?;
        let reading = said(&motion.skeleton).map_err(EngineError::bad_input)?;
        let binding = reading.bind(&motion).map_err(|e| EngineError::bad_file(e, ""))?;
        notes.extend_from_slice(&binding.doubts);
        Ok(Self { bvh, motion, binding, notes })
    }

    /// Returns the motion on a body, at the file's rate.
    pub(crate) fn on_body(&self, proportions: &Proportions) -> HumanoidMotion {
        to_humanoid(&self.motion, &self.binding, proportions)
    }

    /// Returns the number of frames of the file.
    pub(crate) fn frames(&self) -> usize {
        self.motion.frames()
    }

    /// Returns the frame rate of the file, frames per second.
    pub(crate) fn rate_hz(&self) -> f64 {
        self.motion.frame_time_secs.recip()
    }

    /// Returns notes on the joint mapping; empty if there are none.
    pub(crate) fn note(&self) -> String {
        self.binding.notes.join(" ")
    }

    /// Returns warnings about the reading.
    pub(crate) fn doubts(&self) -> &[Note] {
        &self.notes
    }

    /// Returns how the file was read.
    pub(crate) fn read(&self) -> FileRead {
        let Self { motion, binding, .. } = self;
        let up = UpAxis::ALL.iter().position(|(axis, _)| *axis == binding.up).unwrap_or_default();
        let numbers = [
            motion.frames() as f64,
            self.rate_hz(),
            up as f64,
            f64::from(u8::from(binding.is_mirrored)),
            f64::from(binding.floor_metres),
            f64::from(binding.metres_per_unit),
            f64::from(binding.proportions.stature()),
            f64::from(binding.confidence),
        ];
        let roles = binding.joint_of_role.iter().map(|joint| joint.map_or(-1.0, |joint| joint as f64));
        FileRead {
            numbers: numbers.into_iter().chain(roles).collect(),
            joints: motion.skeleton.joints().iter().map(|joint| joint.name.clone()).collect(),
            skeleton: skeleton_id(&motion.skeleton),
        }
    }

    /// Returns a styled motion at `rate_hz` on the file's skeleton and at the file's rate.
    ///
    /// # Errors
    /// If the styled motion is not finite, which the engine prevents.
    pub(crate) fn export(&self, styled: &StyledMotion, rate_hz: f32) -> Result<String, EngineError> {
        let Self { bvh, motion, binding, .. } = self;
        let styled = bvh.with_motion(&styled.on_skeleton(rate_hz, motion, binding));
        styled.map(|bvh| bvh::write_text(&bvh)).map_err(unreadable)
    }
}

fn unreadable(error: BvhError) -> EngineError {
    EngineError::bad_file(error, "Export the clip again as BVH, or drop another file.")
}
