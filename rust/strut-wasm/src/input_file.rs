//! BVH files of inputs.

use js_sys::Function;
use strut_core::humanoid::{HumanoidMotion, Proportions};
use strut_core::motion::Motion;
use strut_core::note::Note;
use strut_core::retarget::{Binding, to_humanoid};
use strut_core::skeleton::Skeleton;
use strut_core::transfer::StyledMotion;
use strut_formats::bvh::{self, Bvh, BvhError};
use strut_formats::joints::Reading;
use strut_formats::reading::{ReadingError, reading_json, skeleton_id};
use strut_wasm_common::EngineError;
use wasm_bindgen::JsValue;

/// The parts of a file that an export needs.
#[derive(Clone)]
pub(crate) struct InputFile {
    bvh: Bvh,
    motion: Motion,
    binding: Binding,
    /// What may be wrong with how it was read.
    notes: Vec<Note>,
}

impl InputFile {
    /// Reads a BVH file as a person says.
    ///
    /// # Errors
    /// With what is wrong with the bytes, with what was said, or with the skeleton.
    pub(crate) fn read_as(bytes: &[u8], said: &Function) -> Result<Self, EngineError> {
        let (bvh, notes) = bvh::parse_noted(bytes).map_err(unreadable)?;
        Self::of(bvh, notes, |skeleton| {
            let said = said.call1(&JsValue::NULL, &JsValue::from_str(&skeleton_id(skeleton)));
            Reading::parse(&said.ok().and_then(|said| said.as_string()).unwrap_or_default())
        })
    }

    /// Reads a BVH file of which nothing is said.
    ///
    /// # Errors
    /// With what is wrong with the bytes, or with the skeleton.
    #[cfg(feature = "parity")]
    pub(crate) fn read(bytes: &[u8]) -> Result<Self, EngineError> {
        let (bvh, notes) = bvh::parse_noted(bytes).map_err(unreadable)?;
        Self::of(bvh, notes, |_| Ok(Reading::default()))
    }

    /// The file that a motion would be.
    ///
    /// # Errors
    /// If there is no pose, or a number is beyond all that files hold.
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

    /// Its motion on a body, at its own rate.
    pub(crate) fn on_body(&self, proportions: &Proportions) -> HumanoidMotion {
        to_humanoid(&self.motion, &self.binding, proportions)
    }

    /// Frames of the file.
    pub(crate) fn frames(&self) -> usize {
        self.motion.frames()
    }

    /// Frames per second of the file.
    pub(crate) fn rate_hz(&self) -> f64 {
        self.motion.frame_time_secs.recip()
    }

    /// Notes on the match of the skeletons; empty if there are none.
    pub(crate) fn note(&self) -> String {
        self.binding.notes.join(" ")
    }

    /// What may be wrong with how it was read.
    pub(crate) fn doubts(&self) -> &[Note] {
        &self.notes
    }

    /// How it was read, as JSON.
    pub(crate) fn reading(&self) -> String {
        reading_json(&self.binding, &self.motion)
    }

    /// A styled motion of `rate_hz` on its skeleton and at its own rate.
    ///
    /// # Errors
    /// If the styled motion is not finite, which the engine prevents.
    pub(crate) fn export(&self, styled: &StyledMotion, rate_hz: f32) -> Result<String, EngineError> {
        let Self { bvh, motion, binding, .. } = self;
        let styled = bvh.with_motion(&styled.on_skeleton(rate_hz, motion, binding));
        styled.map(|bvh| bvh::write(&bvh)).map_err(unreadable)
    }
}

fn unreadable(error: BvhError) -> EngineError {
    EngineError::bad_file(error, "Export the clip again as BVH, or drop another file.")
}
