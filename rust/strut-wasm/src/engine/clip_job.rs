//! Handle of a job that styles a whole clip.

use crate::common::EngineError;
use crate::common::floats_of;
use crate::engine::input::Input;
use crate::engine::stylizer::{Stylizer, planted_of};
use std::sync::Arc;
use strut_core::humanoid::{Pose, Role};
use strut_core::pose_vector::HIP_HEIGHT;
use strut_core::transfer::{self, Examples, Model, NoClock, StyledMotion, Trace};
use wasm_bindgen::prelude::wasm_bindgen;

/// Styling of an input in portions.
#[wasm_bindgen]
pub struct ClipJob {
    poses: Vec<Pose>,
    /// Weight of every class in each frame so far.
    class_weights: Vec<f32>,
    examples: Examples,
    model: Arc<Model>,
    /// The job until all frames are styled.
    job: Option<transfer::ClipJob>,
    /// The result from then on.
    styled: Option<StyledMotion>,
}

#[wasm_bindgen]
impl ClipJob {
    /// Starts the job with a stylizer's styles and options.
    #[wasm_bindgen(constructor)]
    pub fn new(stylizer: &Stylizer, input: &Input) -> Self {
        let (frames, per_frame) = (input.humanoid().poses.len(), stylizer.core().options().k);
        let job = transfer::ClipJob::of_input(stylizer.core().clone(), input.clip());
        let (poses, model) = (input.humanoid().poses.clone(), Arc::clone(stylizer.core().model()));
        Self {
            class_weights: Vec::with_capacity(frames * model.catalogue().classes().len()),
            poses,
            examples: Examples::with_capacity(frames, per_frame),
            model,
            job: Some(job),
            styled: None,
        }
    }

    /// Changes the styles of the whole body from the next frame on. Has no effect once all frames are styled.
    ///
    /// # Errors
    /// Those of [`Stylizer::set_styles`].
    #[wasm_bindgen(js_name = setStyles)]
    pub fn set_styles(&mut self, weights: &[f32]) -> Result<(), EngineError> {
        match &mut self.job {
            Some(job) => job.set_styles(weights).map_err(EngineError::bad_input),
            None => Ok(()),
        }
    }

    /// Styles up to `frames` more frames and returns the number done. The result is available once that is the number
    /// of the input's frames.
    pub fn run(&mut self, frames: usize) -> usize {
        self.run_traced(frames, |_| ())
    }

    /// Returns the styled poses, one per input frame.
    ///
    /// # Errors
    /// If frames are still missing.
    pub fn poses(&self) -> Result<Vec<f32>, EngineError> {
        Ok(floats_of(self.styled()?.frames.iter().map(|f| &f.pose)))
    }

    /// Returns the weight of each class of the database, frame by frame.
    #[wasm_bindgen(js_name = classWeights)]
    pub fn class_weights(&self) -> Vec<f32> {
        self.class_weights.clone()
    }

    /// Returns the number of examples of the database from which each frame so far was predicted.
    #[wasm_bindgen(js_name = exampleCounts)]
    pub fn example_counts(&self) -> Vec<u16> {
        self.examples.counts().iter().map(|&count| count as u16).collect()
    }

    /// Returns the weight of each example, 0 to 1, frame by frame.
    #[wasm_bindgen(js_name = exampleWeights)]
    pub fn example_weights(&self) -> Vec<f32> {
        self.examples.weights().collect()
    }

    /// Returns the rotation x y z w of a joint in every example, in the styles of its frame; the hips' without the
    /// heading.
    ///
    /// # Errors
    /// If there is no such joint.
    #[wasm_bindgen(js_name = exampleRotations)]
    pub fn example_rotations(&self, joint: usize) -> Result<Vec<f32>, EngineError> {
        let role = Role::ALL.get(joint);
        let role = *role.ok_or_else(|| EngineError::bad_input(String::from("there is no such joint")))?;
        let chart = &self.model.catalogue().chart;
        Ok(self.examples.targets(&self.model).flat_map(|row| chart.rotation(role, &row).to_array()).collect())
    }

    /// Returns the height of the hips in every example, metres.
    #[wasm_bindgen(js_name = exampleHeights)]
    pub fn example_heights(&self) -> Vec<f32> {
        self.examples.targets(&self.model).map(|row| row[HIP_HEIGHT]).collect()
    }

    /// Returns the output time of each frame, seconds.
    ///
    /// # Errors
    /// If frames are still missing.
    #[wasm_bindgen(js_name = timeOut)]
    pub fn time_out(&self) -> Result<Vec<f32>, EngineError> {
        Ok(self.styled()?.frames.iter().map(|f| f.time_out_secs as f32).collect())
    }

    /// Returns the planted feet, left and right interleaved.
    ///
    /// # Errors
    /// If frames are still missing.
    pub fn planted(&self) -> Result<Vec<u8>, EngineError> {
        Ok(planted_of(&self.styled()?.frames))
    }

    /// Returns the length of the output, seconds.
    ///
    /// # Errors
    /// If frames are still missing.
    #[wasm_bindgen(js_name = durationSecs)]
    pub fn duration_secs(&self) -> Result<f64, EngineError> {
        Ok(self.styled()?.duration_secs())
    }

    /// Returns the styled clip as BVH text on the input's own skeleton.
    ///
    /// # Errors
    /// If frames are still missing.
    #[wasm_bindgen(js_name = toBvh)]
    pub fn to_bvh(&self, input: &Input) -> Result<String, EngineError> {
        input.export(self.styled()?)
    }
}

#[cfg(feature = "files")]
#[wasm_bindgen]
impl ClipJob {
    /// Returns warnings about the styled clip, apart from those about the input: codes and texts, alternately.
    ///
    /// # Errors
    /// If frames are still missing.
    pub fn notes(&self) -> Result<Vec<String>, EngineError> {
        Ok(crate::engine::input_file::texts_of(&self.styled()?.notes(self.model.catalogue().rate_hz)))
    }

    /// Returns the mean distance of the input's frames from the nearest ones of the database, metres.
    ///
    /// # Errors
    /// If frames are still missing.
    #[wasm_bindgen(js_name = distanceMetres)]
    pub fn distance_metres(&self) -> Result<f64, EngineError> {
        Ok(self.styled()?.familiarity.distance_metres())
    }
}

impl ClipJob {
    /// Does [`Self::run`] and passes the trace of every frame to `on_frame`.
    pub(crate) fn run_traced(&mut self, frames: usize, mut on_frame: impl FnMut(&Trace)) -> usize {
        let Some(job) = &mut self.job else { return self.poses.len() };
        for pose in self.poses.iter().skip(job.frames().len()).take(frames) {
            let trace = job.push(pose, &mut NoClock);
            self.class_weights.extend_from_slice(trace.class_weights);
            self.examples.record(&trace);
            on_frame(&trace);
        }
        let done = job.frames().len();
        if done == self.poses.len() {
            self.styled = self.job.take().map(transfer::ClipJob::finish);
        }
        done
    }

    fn styled(&self) -> Result<&StyledMotion, EngineError> {
        self.styled.as_ref().ok_or_else(|| {
            let done = self.job.as_ref().map_or(0, |job| job.frames().len());
            let all = self.poses.len();
            EngineError::bad_input(format!("{done} of {all} frames are styled; the result needs all"))
        })
    }
}
