//! BVH files of inputs.

use strut_core::humanoid::{HumanoidMotion, Proportions};
use strut_core::motion::Motion;
use strut_core::note::Note;
use strut_core::retarget::{Binding, to_humanoid};
use strut_core::transfer::StyledMotion;
use strut_formats::bvh::{self, Bvh, BvhError};
use strut_wasm_common::EngineError;

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
    /// Reads a BVH file.
    ///
    /// # Errors
    /// With what is wrong with the bytes, or with the skeleton.
    pub(crate) fn read(bytes: &[u8]) -> Result<Self, EngineError> {
        let (bvh, notes) = bvh::parse_noted(bytes).map_err(unreadable)?;
        Self::of(bvh, notes)
    }

    /// The file that a motion would be.
    ///
    /// # Errors
    /// If there is no pose, or a number is beyond all that files hold.
    pub(crate) fn of_motion(motion: &HumanoidMotion) -> Result<Self, EngineError> {
        Self::of(Bvh::from_humanoid(motion).map_err(unreadable)?, Vec::new())
    }

    fn of(bvh: Bvh, mut notes: Vec<Note>) -> Result<Self, EngineError> {
        let motion = bvh.to_motion().map_err(unreadable)?;
        let binding = Binding::detect(&motion).map_err(|e| EngineError::bad_file(e, ""))?;
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

    /// A styled motion of `rate_hz` on its skeleton and at its own rate.
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
