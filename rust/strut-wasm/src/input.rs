//! Handle of an input motion.

use crate::database::{Database, unpackable};
use strut_core::contact;
use strut_core::humanoid::{HumanoidMotion, TooManyFrames};
use strut_core::motion::Motion;
use strut_core::retarget::{Binding, to_humanoid};
use strut_core::transfer::StyledMotion;
use strut_formats::bvh::{self, Bvh, BvhError};
use strut_formats::strutdb::packed;
use strut_wasm_common::EngineError;
use strut_wasm_common::floats_of;
use wasm_bindgen::prelude::wasm_bindgen;

/// A motion on a database's humanoid and at its rate, with the file that it came from.
#[wasm_bindgen]
#[derive(Clone)]
pub struct Input {
    humanoid: HumanoidMotion,
    file: Option<File>,
}

/// The parts of a file that an export needs.
#[derive(Clone)]
struct File {
    bvh: Bvh,
    motion: Motion,
    binding: Binding,
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
    /// If there is none of this name, or with what is wrong with the bytes.
    #[wasm_bindgen(js_name = fromPacked)]
    pub fn from_packed(database: &Database, bytes: &[u8], name: &str) -> Result<Self, EngineError> {
        let motion = packed_motion(bytes, name)?;
        let db = database.model().catalogue();
        let humanoid = if motion.proportions == db.proportions {
            motion.resampled(db.rate_hz).map_err(too_long)?
        } else {
            let bvh = Bvh::from_humanoid(&motion).map_err(unreadable)?;
            Self::from_file(database, bvh)?.humanoid
        };
        Ok(Self { humanoid, file: None })
    }

    /// A BVH file.
    ///
    /// # Errors
    /// With what is wrong with the bytes.
    #[wasm_bindgen(js_name = fromBvh)]
    pub fn from_bvh(database: &Database, bytes: &[u8]) -> Result<Self, EngineError> {
        let bvh = bvh::parse(bytes).map_err(unreadable)?;
        Self::from_file(database, bvh)
    }

    /// Number of frames.
    pub fn frames(&self) -> usize {
        self.humanoid.poses.len()
    }

    /// Notes on the match of the skeletons; empty if there are none.
    pub fn note(&self) -> String {
        self.file.as_ref().map(|f| f.binding.notes.join(" ")).unwrap_or_default()
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
    fn from_file(database: &Database, bvh: Bvh) -> Result<Self, EngineError> {
        let db = database.model().catalogue();
        let motion = bvh.to_motion().map_err(unreadable)?;
        let binding = Binding::detect(&motion).map_err(|e| EngineError::bad_file(e, ""))?;
        let humanoid = to_humanoid(&motion, &binding, &db.proportions).resampled(db.rate_hz).map_err(too_long)?;
        Ok(Self { humanoid, file: Some(File { bvh, motion, binding }) })
    }

    #[cfg(feature = "parity")]
    pub(crate) fn poses_mut(&mut self) -> &mut Vec<strut_core::humanoid::Pose> {
        &mut self.humanoid.poses
    }

    /// Poses that came from no file.
    #[cfg(any(feature = "bench", feature = "learn"))]
    pub(crate) fn of_poses(
        proportions: strut_core::humanoid::Proportions,
        rate_hz: f32,
        poses: Vec<strut_core::humanoid::Pose>,
    ) -> Self {
        Self { humanoid: HumanoidMotion { proportions, rate_hz, poses }, file: None }
    }

    pub(crate) fn humanoid(&self) -> &HumanoidMotion {
        &self.humanoid
    }

    /// This input in a style as a BVH file: on the input's own skeleton and at its own rate, or as a
    /// humanoid of the database's if it came from no file.
    ///
    /// # Errors
    /// If the styled motion is not finite, which the engine prevents.
    pub(crate) fn export(&self, styled: &StyledMotion) -> Result<String, EngineError> {
        let bvh = match &self.file {
            None => Bvh::from_humanoid(&styled.on_body(&self.humanoid.proportions, self.humanoid.rate_hz).motion),
            Some(File { bvh, motion, binding }) => {
                bvh.with_motion(&styled.on_skeleton(self.humanoid.rate_hz, motion, binding))
            }
        };
        bvh.map(|bvh| bvh::write(&bvh)).map_err(unreadable)
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

fn too_long(error: TooManyFrames) -> EngineError {
    EngineError::bad_file(error, "Cut the clip into shorter ones, or drop another file.")
}

pub(crate) fn unreadable(error: BvhError) -> EngineError {
    EngineError::bad_file(error, "Export the clip again as BVH, or drop another file.")
}
