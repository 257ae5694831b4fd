//! Handle of a key-styled animation.

use crate::common::{EngineError, bvh_of, floats_of};
use crate::key_style::frame::{Frame, style};
use crate::key_style::mode::{mode, numbers};
use crate::key_style::model::KeyStyleModel;
use js_sys::Float32Array;
use std::sync::Arc;
use strut_core::humanoid::{HumanoidMotion, Pose};
use strut_core::somn::{DragCharacter, Interpolation, Key, KeyStyling, Method, Mode, RATE_HZ, Synthesis};
use strut_formats::shown_number;
use wasm_bindgen::prelude::wasm_bindgen;

/// Longest animation, seconds.
const MOST_SECS: f64 = 600.0;

/// Methods by index.
const METHODS: [Method; 3] = [Method::KeyStyle, Method::Hybrid, Method::KeyFrame];

/// Keys of styles over time. Hybrid and key-framing pass through the pose of a key, which is the recorded pose with the
/// nearest style.
#[wasm_bindgen]
pub struct Styling {
    synthesis: Synthesis,
    mode: Mode,
    keyed: Option<KeyStyling>,
    /// The character of each method, moved by its supporting feet.
    bodies: [DragCharacter; 3],
    /// Time of each method's last pose, seconds.
    shown_secs: [f64; 3],
    frame: Frame,
}

#[wasm_bindgen]
impl Styling {
    /// Creates an animation without keys.
    #[wasm_bindgen(constructor)]
    pub fn new(model: &KeyStyleModel) -> Self {
        Self {
            synthesis: Synthesis::new(Arc::clone(&model.model)),
            mode: Mode::KEYED,
            keyed: None,
            bodies: std::array::from_fn(|_| DragCharacter::new(Arc::clone(&model.model))),
            shown_secs: [0.0; 3],
            frame: Frame::new(model.model.components.len(), model.model.axis_count()),
        }
    }

    /// Sets the mode as [`crate::key_style::DragCharacter::set_mode`] does. It applies to the keys that are set next.
    ///
    /// # Errors
    /// If a number is out of range; nothing changes then.
    #[wasm_bindgen(js_name = setMode)]
    pub fn set_mode(&mut self, temperature: Option<f64>, blur: f64) -> Result<(), EngineError> {
        self.mode = mode(temperature, blur)?;
        Ok(())
    }

    /// Returns temperature and blur of the default mode.
    #[wasm_bindgen(js_name = smoothMode)]
    pub fn smooth_mode() -> Vec<f64> {
        numbers(Mode::KEYED)
    }

    /// Sets the keys, in the order of their times, with one number per axis each.
    ///
    /// # Errors
    /// If keys are invalid; the former keys are then kept.
    #[wasm_bindgen(js_name = setKeys)]
    pub fn set_keys(&mut self, secs: &[f64], values: &[f64], monotone: bool) -> Result<(), EngineError> {
        let axes = self.synthesis.model().axis_count();
        if values.len() != secs.len() * axes {
            let (values, keys) = (values.len(), secs.len());
            return Err(EngineError::bad_input(format!("{values} values were given for {keys} keys of {axes}")));
        }
        let key = |(secs, values): (&f64, &[f64])| {
            let style = style(values);
            let row = self.synthesis.nearest(&style).map(|frame| self.synthesis.model().recorded_row(frame));
            Key { secs: *secs, style, row }
        };
        let keys: Vec<Key> = secs.iter().zip(values.chunks_exact(axes)).map(key).collect();
        let interpolation = if monotone { Interpolation::Monotone } else { Interpolation::CatmullRom };
        self.keyed = Some(
            KeyStyling::new(&keys, interpolation, &mut self.synthesis, self.mode).map_err(EngineError::bad_input)?,
        );
        Ok(())
    }

    /// Sets the present pose, which [`Styling::read`] returns: at a time, by key-styling (0), hybrid (1) or key-framing
    /// (2).
    pub fn at(&mut self, secs: f64, method: u8) {
        let Self { synthesis, keyed: Some(keyed), bodies, shown_secs, frame, .. } = self else { return };
        let row = keyed.row(synthesis, secs, METHODS[usize::from(method) % METHODS.len()]);
        let method = usize::from(method) % METHODS.len();
        let (body, shown_secs) = (&mut bodies[method], &mut shown_secs[method]);
        body.take(&row, (secs - *shown_secs).max(0.0));
        *shown_secs = secs;
        frame.show(body.pose(), synthesis.weights(), &body.measured(), &keyed.style(secs));
    }

    /// Moves all characters back to their start above the origin.
    #[wasm_bindgen(js_name = goBack)]
    pub fn go_back(&mut self) {
        self.bodies.iter_mut().for_each(DragCharacter::go_back);
    }

    /// Writes the numbers of the present frame to an array.
    ///
    /// # Errors
    /// If the array has another length.
    pub fn read(&self, into: &Float32Array) -> Result<(), EngineError> {
        self.frame.write(into)
    }

    /// Returns the style at `moments` times from 0 to `secs`, one number per axis.
    pub fn way(&self, secs: f64, moments: usize) -> Vec<f32> {
        let Some(keyed) = &self.keyed else { return Vec::new() };
        let axes = self.synthesis.model().axis_count();
        let at = |i: usize| secs * i as f64 / moments.saturating_sub(1).max(1) as f64;
        (0..moments).flat_map(|i| keyed.style(at(i)).into_iter().take(axes).map(|v| v as f32)).collect()
    }

    /// Returns the poses from 0 to a time, moved by the supporting feet.
    ///
    /// # Errors
    /// If the time is longer than ten minutes, or there is no key.
    pub fn perform(&mut self, secs: f64, method: u8) -> Result<Vec<f32>, EngineError> {
        let poses = self.poses(secs, method)?;
        Ok(floats_of(poses.iter()))
    }

    /// Returns the same motion as the text of a BVH file.
    ///
    /// # Errors
    /// Those of [`Styling::perform`].
    #[wasm_bindgen(js_name = toBvh)]
    pub fn to_bvh(&mut self, secs: f64, method: u8) -> Result<String, EngineError> {
        let poses = self.poses(secs, method)?;
        let motion = HumanoidMotion { proportions: self.synthesis.model().space.proportions, rate_hz: RATE_HZ, poses };
        bvh_of(&motion)
    }
}

impl Styling {
    fn poses(&mut self, secs: f64, method: u8) -> Result<Vec<Pose>, EngineError> {
        if !(0.0..=MOST_SECS).contains(&secs) {
            return Err(EngineError::bad_input(format!(
                "{} s were requested; at most {MOST_SECS} s are supported",
                shown_number(secs)
            )));
        }
        let Self { synthesis, keyed: Some(keyed), .. } = self else {
            return Err(EngineError::bad_input("there is no key"));
        };
        let mut body = DragCharacter::new(Arc::clone(synthesis.model()));
        // A frame exactly at the end is part of the motion, regardless of rounding.
        let frames = (secs * f64::from(RATE_HZ) + 1e-6).floor() as usize + 1;
        let mut pose = |frame: usize| {
            let secs = frame as f64 / f64::from(RATE_HZ);
            body.take(
                &keyed.row(synthesis, secs, METHODS[usize::from(method) % METHODS.len()]),
                1.0 / f64::from(RATE_HZ),
            );
            if frame == 0 {
                body.go_back();
            }
            *body.pose()
        };
        Ok((0..frames).map(&mut pose).collect())
    }
}
