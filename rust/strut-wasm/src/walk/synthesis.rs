//! Handle of a walking character.

use crate::common::{EngineError, write_floats};
use crate::walk::model::WalkModel;
use js_sys::Float32Array;
use std::sync::Arc;
use strut_core::hsmm::{RATE_HZ, STATES, Walker};
use strut_core::humanoid::{POSE_FLOATS, Pose};
use strut_core::math::Vec3;
use wasm_bindgen::prelude::wasm_bindgen;

/// Number of floats of a frame: the pose, the step's number, its progress, the state, the foot contacts (left, right),
/// and the duration of each of the step's states, frames.
pub const FRAME: usize = POSE_FLOATS + 5 + STATES;

/// Greatest number of frames per call, after a pause of the page for example.
const MOST_FRAMES: f64 = 8.0;

/// A character that walks endlessly. For each displayed frame call [`Walk::advance`], then [`Walk::read`].
#[wasm_bindgen]
pub struct Walk {
    walker: Walker,
    /// The two frames before and after the present time, and the interpolation factor between them.
    poses: [Pose; 2],
    share: f64,
    step: u64,
    /// Number of frames of the present step so far.
    frames: u32,
    shown: Box<[f32; FRAME]>,
}

#[wasm_bindgen]
impl Walk {
    /// Creates a walk in the average of all styles, from the origin along +Z.
    #[wasm_bindgen(constructor)]
    pub fn new(model: &WalkModel) -> Self {
        let walker = Walker::new(Arc::clone(&model.runtime));
        let poses = [Pose::default(); 2];
        let mut walk = Self { walker, poses, share: 0.0, step: 0, frames: 0, shown: Box::new([0.0; FRAME]) };
        walk.reset();
        walk
    }

    /// Restarts at the origin with the first frame; styles and controls are kept.
    pub fn reset(&mut self) {
        self.walker.reset(Vec3::ZERO, 0.0);
        (self.share, self.step, self.frames) = (0.0, 0, 0);
        self.take_frame();
        self.poses[0] = self.poses[1];
        self.show();
    }

    /// Sets the styles of left and right steps from the next frame on, one weight per style. What the weights lack to a
    /// sum of 1 is given to the average style. Planned transitions are discarded.
    ///
    /// # Errors
    /// If a weight is not finite or out of range; the former weights are then kept.
    #[wasm_bindgen(js_name = setStyles)]
    pub fn set_styles(&mut self, left: &[f32], right: &[f32]) -> Result<(), EngineError> {
        self.walker.set_sides([left, right]).map_err(EngineError::bad_input)
    }

    /// Changes the styles from a step on, over a number of steps.
    ///
    /// # Errors
    /// If a weight is not finite or out of range; nothing changes then.
    #[wasm_bindgen(js_name = planTransition)]
    pub fn plan_transition(&mut self, step: u32, between: u32, left: &[f32], right: &[f32]) -> Result<(), EngineError> {
        self.walker.plan_transition(step.into(), between, [left, right]).map_err(EngineError::bad_input)
    }

    /// Sets the cadence, steps per minute; `None` uses the style's own.
    #[wasm_bindgen(js_name = setCadence)]
    pub fn set_cadence(&mut self, steps_per_minute: Option<f32>) {
        self.walker.set_cadence(steps_per_minute);
    }

    /// Sets the cadence, steps per minute, and adjusts steps until they end on the beat that occurs `secs` seconds
    /// after the present frame.
    #[wasm_bindgen(js_name = setBeat)]
    pub fn set_beat(&mut self, steps_per_minute: f32, secs: f32) {
        self.walker.set_beat(steps_per_minute, secs);
    }

    /// Sets the seed of sampled state durations; without it they are the means.
    #[wasm_bindgen(js_name = setVariation)]
    pub fn set_variation(&mut self, seed: Option<u32>) {
        self.walker.set_variation(seed);
    }

    /// Sets the turn per step, radians to the left.
    #[wasm_bindgen(js_name = setTurn)]
    pub fn set_turn(&mut self, turn: f32) {
        self.walker.set_turn(turn);
    }

    /// Sets the step length relative to the style's.
    #[wasm_bindgen(js_name = setStride)]
    pub fn set_stride(&mut self, share: f32) {
        self.walker.set_stride(share);
    }

    /// Sets whether to walk or to stand, from the next frame on; either change takes two steps.
    #[wasm_bindgen(js_name = setWalking)]
    pub fn set_walking(&mut self, walks: bool) {
        self.walker.set_walking(walks);
    }

    /// Advances by a number of seconds.
    pub fn advance(&mut self, secs: f64) {
        let frames = secs * f64::from(RATE_HZ);
        self.share += if frames.is_finite() { frames.clamp(0.0, MOST_FRAMES) } else { 0.0 };
        while self.share >= 1.0 {
            self.share -= 1.0;
            self.take_frame();
        }
        self.show();
    }

    /// Advances by exactly one frame of the walk.
    #[wasm_bindgen(js_name = nextFrame)]
    pub fn next_frame(&mut self) {
        self.take_frame();
        self.share = 1.0 - f64::EPSILON;
        self.show();
    }

    /// Writes the [`FRAME`] numbers of the present frame to an array.
    ///
    /// # Errors
    /// If the array has another length.
    pub fn read(&self, into: &Float32Array) -> Result<(), EngineError> {
        write_floats(&self.shown[..], into)
    }

    /// Returns the number of the first step whose style can still be changed.
    #[wasm_bindgen(js_name = nextStep)]
    pub fn next_step(&self) -> u32 {
        self.walker.next_step() as u32
    }
}

impl Walk {
    fn take_frame(&mut self) {
        self.poses = [self.poses[1], *self.walker.advance()];
        let (step, _) = self.walker.step();
        self.frames = if step == self.step { self.frames + 1 } else { 1 };
        self.step = step;
    }

    fn show(&mut self) {
        let share = self.share as f32;
        let pose = self.poses[0].lerp(&self.poses[1], share);
        let Some((floats, rest)) = self.shown.split_first_chunk_mut::<POSE_FLOATS>() else { return };
        pose.write_to(floats);
        let durations = self.walker.durations();
        let done = (self.frames as f32 - 1.0 + share) / durations.iter().sum::<f32>();
        let [left, right] = self.walker.planted().map(|p| f32::from(u8::from(p)));
        rest[..5].copy_from_slice(&[self.step as f32, done.clamp(0.0, 1.0), self.walker.state() as f32, left, right]);
        rest[5..].copy_from_slice(durations);
    }
}
