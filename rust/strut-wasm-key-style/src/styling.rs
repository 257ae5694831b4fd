//! Handle of keys that are performed.

use crate::frame::{Frame, style};
use crate::model::KeyStyleModel;
use crate::text;
use std::sync::Arc;
use strut_core::humanoid::{HumanoidMotion, POSE_FLOATS, Pose};
use strut_core::somn::{Interpolation, Key, KeyStyling, Method, Mode, Puppet, RATE_HZ, Synthesis};
use strut_formats::bvh::{self, Bvh};
use wasm_bindgen::prelude::wasm_bindgen;

/// Longest animation, seconds.
const MOST_SECS: f64 = 600.0;

/// Methods by their numbers.
const METHODS: [Method; 3] = [Method::KeyStyle, Method::Hybrid, Method::KeyFrame];

/// Keys of styles over time. The pose of a key, which hybrid and key-framing go through, is the recorded one whose style is
/// nearest.
#[wasm_bindgen]
pub struct Styling {
    synthesis: Synthesis,
    mode: Mode,
    keyed: Option<KeyStyling>,
    /// Who stands where its feet carry it, for each method; and who does so in what is exported.
    bodies: [Puppet; 3],
    frame: Frame,
}

#[wasm_bindgen]
impl Styling {
    /// Without keys.
    #[wasm_bindgen(constructor)]
    pub fn new(model: &KeyStyleModel) -> Self {
        Self {
            synthesis: Synthesis::new(Arc::clone(&model.model)),
            mode: Mode::KEYED,
            keyed: None,
            bodies: std::array::from_fn(|_| Puppet::new(Arc::clone(&model.model))),
            frame: Frame::new(model.model.components.len(), model.model.axis_count()),
        }
    }

    /// Whether the likeliest component alone is the pose; acts with the next keys.
    #[wasm_bindgen(js_name = setHard)]
    pub fn set_hard(&mut self, hard: bool) {
        self.mode = if hard { Mode::Hard } else { Mode::KEYED };
    }

    /// Takes keys in the order of their times, one number an axis for each.
    ///
    /// # Errors
    /// With what is wrong with them; the former keys then stay.
    #[wasm_bindgen(js_name = setKeys)]
    pub fn set_keys(&mut self, secs: &[f64], values: &[f64], monotone: bool) -> Result<(), String> {
        let axes = self.synthesis.model().axis_count();
        if values.len() != secs.len() * axes {
            return Err(format!("{} values were given for {} keys of {axes}", values.len(), secs.len()));
        }
        let key = |(secs, values): (&f64, &[f64])| {
            let style = style(values);
            let row = self.synthesis.nearest(&style).map(|frame| self.synthesis.model().recorded_row(frame));
            Key { secs: *secs, style, row }
        };
        let keys: Vec<Key> = secs.iter().zip(values.chunks_exact(axes)).map(key).collect();
        let interpolation = if monotone { Interpolation::Monotone } else { Interpolation::CatmullRom };
        self.keyed = Some(KeyStyling::new(&keys, interpolation, &mut self.synthesis, self.mode).map_err(text)?);
        Ok(())
    }

    /// Writes the pose at a time where [`Styling::frame_address`] points: by key-styling (0), hybrid (1) or key-framing (2).
    pub fn at(&mut self, secs: f64, method: u8) {
        let Self { synthesis, keyed: Some(keyed), bodies, frame, .. } = self else { return };
        let row = keyed.row(synthesis, secs, METHODS[usize::from(method) % METHODS.len()]);
        let body = &mut bodies[usize::from(method) % METHODS.len()];
        body.take(&row);
        frame.show(body.pose(), synthesis.weights(), &body.measured(), &keyed.style(secs));
    }

    /// Puts all bodies back above the origin, where they began.
    #[wasm_bindgen(js_name = goBack)]
    pub fn go_back(&mut self) {
        self.bodies.iter_mut().for_each(Puppet::go_back);
    }

    /// Where the numbers of the present frame lie in this memory.
    #[wasm_bindgen(js_name = frameAddress)]
    pub fn frame_address(&self) -> *const f32 {
        self.frame.address()
    }

    /// The style at so many moments from 0 to a time, one number an axis.
    pub fn way(&self, secs: f64, moments: usize) -> Vec<f32> {
        let Some(keyed) = &self.keyed else { return Vec::new() };
        let axes = self.synthesis.model().axis_count();
        let at = |i: usize| secs * i as f64 / moments.saturating_sub(1).max(1) as f64;
        (0..moments).flat_map(|i| keyed.style(at(i)).into_iter().take(axes).map(|v| v as f32)).collect()
    }

    /// The poses from 0 to a time, where the feet carry the body.
    ///
    /// # Errors
    /// If that is longer than anybody needs, or there is no key.
    pub fn perform(&mut self, secs: f64, method: u8) -> Result<Vec<f32>, String> {
        let poses = self.poses(secs, method)?;
        let mut floats = vec![0.0; poses.len() * POSE_FLOATS];
        floats.as_chunks_mut::<POSE_FLOATS>().0.iter_mut().zip(&poses).for_each(|(out, pose)| pose.write_to(out));
        Ok(floats)
    }

    /// The text of a BVH file of the same.
    ///
    /// # Errors
    /// As for [`Styling::perform`].
    #[wasm_bindgen(js_name = toBvh)]
    pub fn to_bvh(&mut self, secs: f64, method: u8) -> Result<String, String> {
        let poses = self.poses(secs, method)?;
        let motion = HumanoidMotion { proportions: self.synthesis.model().space.proportions, rate_hz: RATE_HZ, poses };
        Bvh::from_humanoid(&motion).map(|file| bvh::write(&file)).map_err(text)
    }
}

impl Styling {
    fn poses(&mut self, secs: f64, method: u8) -> Result<Vec<Pose>, String> {
        if !(0.0..=MOST_SECS).contains(&secs) {
            return Err(format!("{secs} s were asked for; up to {MOST_SECS} s are made"));
        }
        let Self { synthesis, keyed: Some(keyed), .. } = self else { return Err("there is no key".to_owned()) };
        let mut body = Puppet::new(Arc::clone(synthesis.model()));
        // A last frame at the very end belongs to the motion, whatever rounding does.
        let frames = (secs * f64::from(RATE_HZ) + 1e-6).floor() as usize + 1;
        let mut pose = |frame: usize| {
            let secs = frame as f64 / f64::from(RATE_HZ);
            body.take(&keyed.row(synthesis, secs, METHODS[usize::from(method) % METHODS.len()]));
            if frame == 0 {
                body.go_back();
            }
            *body.pose()
        };
        Ok((0..frames).map(&mut pose).collect())
    }
}
