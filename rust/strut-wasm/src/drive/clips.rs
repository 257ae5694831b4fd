//! Handle of the clips for driving.

use crate::common::{EngineError, poses_of, proportions_of};
use strut_core::driving::{DrivingClips, NeutralClip};
use strut_core::humanoid::{Pose, Proportions};
use wasm_bindgen::prelude::wasm_bindgen;

/// Neutral clips for a driver.
#[wasm_bindgen]
pub struct Clips {
    proportions: Proportions,
    rate_hz: f32,
    own: Vec<NeutralClip>,
    spare: Vec<NeutralClip>,
    takes: Vec<NeutralClip>,
}

/// Source of a clip.
#[wasm_bindgen(js_name = Among)]
#[derive(Clone, Copy, Debug)]
pub enum ClipSource {
    /// A clip of the database.
    Own,
    /// A fallback walk for a database with too little walking.
    Spare,
    /// A built-in take that the database lacks.
    Takes,
}

#[wasm_bindgen]
impl Clips {
    /// Creates an empty list with a body (21 × xyz, metres) and a frame rate.
    ///
    /// # Errors
    /// If the offsets are not 63 numbers.
    #[wasm_bindgen(constructor)]
    pub fn new(proportions: &[f32], rate_hz: f32) -> Result<Self, EngineError> {
        let (own, spare, takes) = (Vec::new(), Vec::new(), Vec::new());
        Ok(Self { proportions: proportions_of(proportions)?, rate_hz, own, spare, takes })
    }

    /// Adds a clip of an action: its world poses and foot contacts, left and right interleaved. A clip with another
    /// body or rate is retargeted and resampled.
    ///
    /// # Errors
    /// If an array has the wrong length, or there are too many frames at this rate.
    #[allow(clippy::too_many_arguments)] // One call instead of an object that both sides would have to define.
    pub fn add(
        &mut self,
        among: ClipSource,
        name: String,
        action: String,
        poses: &[f32],
        contacts: &[u8],
        proportions: &[f32],
        rate_hz: f32,
    ) -> Result<(), EngineError> {
        let body = proportions_of(proportions)?;
        let mut clip = clip_of(name, action, poses, contacts)?;
        if body != self.proportions || rate_hz != self.rate_hz {
            let carried = clip.carried(body, rate_hz, &self.proportions, self.rate_hz);
            clip = carried.map_err(EngineError::bad_input)?;
        }
        match among {
            ClipSource::Own => self.own.push(clip),
            ClipSource::Spare => self.spare.push(clip),
            ClipSource::Takes => self.takes.push(clip),
        }
        Ok(())
    }
}

impl Clips {
    /// Returns the clips, prepared for driving.
    ///
    /// # Errors
    /// If there is too little locomotion in them.
    pub(crate) fn driving(&self) -> Result<DrivingClips, EngineError> {
        let Self { proportions, rate_hz, own, spare, takes } = self;
        DrivingClips::new(*proportions, *rate_hz, own, spare, takes).map_err(EngineError::bad_input)
    }
}

fn clip_of(name: String, action: String, poses: &[f32], contacts: &[u8]) -> Result<NeutralClip, EngineError> {
    let poses: Vec<Pose> = poses_of(poses)?.collect();
    if contacts.len() != 2 * poses.len() {
        let (found, expected) = (contacts.len(), 2 * poses.len());
        return Err(EngineError::bad_input(format!("{found} contacts were given; {expected} were expected")));
    }
    let contacts = contacts.as_chunks::<2>().0.iter().map(|feet| feet.map(|planted| planted != 0)).collect();
    Ok(NeutralClip { name, action, poses, contacts })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_are_two_contacts_a_pose() {
        let poses = crate::common::floats_of([Pose::default(); 3].iter());
        let of = |contacts: usize| clip_of("a".into(), "walk".into(), &poses, &vec![1; contacts]);
        assert_eq!(of(6).unwrap().contacts, [[true; 2]; 3]);
        for contacts in [0, 4, 5, 7, 8] {
            assert!(of(contacts).is_err(), "{contacts}");
        }
    }
}
