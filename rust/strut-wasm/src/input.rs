//! Handle of an input motion.

use crate::database::{Database, unpackable};
#[cfg(feature = "files")]
use crate::input_file::InputFile;
use strut_core::contact;
use strut_core::humanoid::{HumanoidMotion, TooManyFrames};
use strut_formats::strutdb::packed;
use strut_wasm_common::EngineError;
use strut_wasm_common::floats_of;
use wasm_bindgen::prelude::wasm_bindgen;

/// A motion on a database's humanoid and at its rate, with the file that it came from.
#[wasm_bindgen]
#[derive(Clone)]
pub struct Input {
    pub(crate) humanoid: HumanoidMotion,
    /// On the match of the skeletons; empty if there is nothing to say.
    pub(crate) note: String,
    #[cfg(feature = "files")]
    pub(crate) file: Option<InputFile>,
}

/// Names of the inputs among packed motions, the default first.
///
/// # Errors
/// With what is wrong with the bytes.
#[wasm_bindgen(js_name = packedInputs)]
pub fn packed_inputs(bytes: &[u8]) -> Result<Vec<String>, EngineError> {
    packed::input_names(bytes).map_err(unpackable)
}

#[wasm_bindgen]
impl Input {
    /// An input among packed motions.
    ///
    /// # Errors
    /// If there is none of this name, or with what is wrong with the bytes; without the feature `files` also on a database of
    /// another body.
    #[wasm_bindgen(js_name = fromPacked)]
    pub fn from_packed(database: &Database, bytes: &[u8], name: &str) -> Result<Self, EngineError> {
        let motion = packed_motion(bytes, name)?;
        let db = database.model().catalogue();
        if motion.proportions == db.proportions {
            motion.resampled(db.rate_hz).map(Self::of_motion).map_err(too_long)
        } else {
            Self::on_another_body(database, &motion)
        }
    }

    /// Number of frames.
    pub fn frames(&self) -> usize {
        self.humanoid.poses.len()
    }

    /// Notes on the match of the skeletons; empty if there are none.
    pub fn note(&self) -> String {
        self.note.clone()
    }

    /// The poses.
    pub fn poses(&self) -> Vec<f32> {
        floats_of(self.humanoid.poses.iter())
    }

    /// Foot contacts of the input, left and right interleaved, 1 while planted.
    pub fn contacts(&self) -> Vec<u8> {
        contact::label(&self.humanoid).into_iter().flat_map(|c| c.map(u8::from)).collect()
    }
}

impl Input {
    /// A motion that came from no file.
    pub(crate) fn of_motion(humanoid: HumanoidMotion) -> Self {
        Self {
            humanoid,
            note: String::new(),
            #[cfg(feature = "files")]
            file: None,
        }
    }

    #[cfg(not(feature = "files"))]
    fn on_another_body(_: &Database, _: &HumanoidMotion) -> Result<Self, EngineError> {
        Err(EngineError::bad_input("this package does not carry motions over to another body"))
    }

    /// Poses that came from no file.
    #[cfg(any(feature = "bench", feature = "learn"))]
    pub(crate) fn of_poses(
        proportions: strut_core::humanoid::Proportions,
        rate_hz: f32,
        poses: Vec<strut_core::humanoid::Pose>,
    ) -> Self {
        Self::of_motion(HumanoidMotion { proportions, rate_hz, poses })
    }

    #[cfg(feature = "parity")]
    pub(crate) fn poses_mut(&mut self) -> &mut Vec<strut_core::humanoid::Pose> {
        &mut self.humanoid.poses
    }

    #[cfg(feature = "files")]
    pub(crate) fn humanoid(&self) -> &HumanoidMotion {
        &self.humanoid
    }
}

/// A motion among packed ones.
///
/// # Errors
/// If there is none of this name, or with what is wrong with the bytes.
pub(crate) fn packed_motion(bytes: &[u8], name: &str) -> Result<HumanoidMotion, EngineError> {
    let motion = packed::read_input(bytes, name).map_err(unpackable)?;
    motion.ok_or_else(|| EngineError::bad_input(format!("there is no built-in input '{name}'")))
}

pub(crate) fn too_long(error: TooManyFrames) -> EngineError {
    EngineError::bad_file(error, "Cut the clip into shorter ones, or drop another file.")
}
