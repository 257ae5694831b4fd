//! Handle of a clip before a build: its joints, its roles and its preview.

use crate::common::{EngineError, floats_of, offsets_of};
use strut_core::humanoid::JOINTS;
use strut_core::motion::Motion;
use strut_core::retarget::{BindError, Binding, ReadAs, to_humanoid};
use strut_formats::bvh;
use wasm_bindgen::prelude::wasm_bindgen;

/// A BVH file with the joint mapping of its skeleton, as far as it could be found.
#[wasm_bindgen]
pub struct Clip {
    motion: Motion,
    binding: Result<Binding, BindError>,
}

#[wasm_bindgen]
impl Clip {
    /// Reads the clip in these bytes. `roles` has the joint of each of the 21 roles, −1 for none. Without it the roles
    /// are detected.
    ///
    /// # Errors
    /// If the file is invalid. A skeleton that is not a humanoid is reported by [`Clip::fault`].
    #[wasm_bindgen(constructor)]
    pub fn new(bytes: &[u8], roles: Option<Vec<i32>>) -> Result<Self, EngineError> {
        let motion = bvh::parse(bytes).and_then(|file| file.to_motion()).map_err(EngineError::unusable_file)?;
        let binding = bind(&motion, roles.as_deref());
        Ok(Self { motion, binding })
    }

    /// Returns the number of frames.
    pub fn frames(&self) -> usize {
        self.motion.frames()
    }

    /// Returns the frame rate, frames per second.
    #[wasm_bindgen(js_name = rateHz)]
    pub fn rate_hz(&self) -> f64 {
        1.0 / self.motion.frame_time_secs
    }

    /// Returns the names of the joints, parents first.
    pub fn joints(&self) -> Vec<String> {
        self.motion.skeleton.joints().iter().map(|j| j.name.clone()).collect()
    }

    /// Returns the index of each joint's parent; −1 for the root.
    pub fn parents(&self) -> Vec<i32> {
        self.motion.skeleton.joints().iter().map(|j| index(j.parent)).collect()
    }

    /// Returns the joint of each role, −1 for none.
    pub fn roles(&self) -> Vec<i32> {
        let likely = || Binding::likely_roles(&self.motion);
        let roles = self.binding.as_ref().map_or_else(|_| likely(), |binding| binding.joint_of_role);
        roles.map(index).to_vec()
    }

    /// Returns the confidence of the joint mapping, 0 to 1.
    pub fn confidence(&self) -> f32 {
        self.binding.as_ref().map_or(0.0, |binding| binding.confidence)
    }

    /// Returns why the skeleton is not a humanoid; empty if it is one.
    pub fn fault(&self) -> String {
        self.binding.as_ref().err().map(ToString::to_string).unwrap_or_default()
    }

    /// Returns notes on the joint mapping; empty if there are none.
    pub fn note(&self) -> String {
        self.binding.as_ref().map(|binding| binding.notes.join(" ")).unwrap_or_default()
    }

    /// Returns the bone offsets of the clip's own body, 21 × xyz, metres.
    ///
    /// # Errors
    /// If the skeleton is not a humanoid.
    pub fn proportions(&self) -> Result<Vec<f32>, EngineError> {
        let binding = self.binding.as_ref().map_err(EngineError::unusable_file)?;
        Ok(offsets_of(&binding.proportions))
    }

    /// Returns the poses on the clip's own body, `POSE_FLOATS` numbers each.
    ///
    /// # Errors
    /// If the skeleton is not a humanoid.
    pub fn poses(&self) -> Result<Vec<f32>, EngineError> {
        let binding = self.binding.as_ref().map_err(EngineError::unusable_file)?;
        let motion = to_humanoid(&self.motion, binding, &binding.proportions);
        Ok(floats_of(motion.poses.iter()))
    }
}

/// Binds the skeleton with the given roles, or with detected ones.
pub(crate) fn bind(motion: &Motion, roles: Option<&[i32]>) -> Result<Binding, BindError> {
    let Some(roles) = roles else { return Binding::detect(motion) };
    let mut joint_of_role = [None; JOINTS];
    for (joint, role) in joint_of_role.iter_mut().zip(roles) {
        *joint = usize::try_from(*role).ok();
    }
    Binding::read(motion, &ReadAs { joints: Some(joint_of_role), ..ReadAs::default() })
}

fn index(joint: Option<usize>) -> i32 {
    joint.map_or(-1, |j| j as i32)
}
