//! Handle of the clips that are driven with.

use strut_core::driving::{DrivingClips, NeutralClip};
use strut_core::humanoid::{Pose, Proportions};
use strut_wasm_common::{EngineError, poses_of, proportions_of};
use wasm_bindgen::prelude::wasm_bindgen;

/// Neutral clips, as they are collected for a driver.
#[wasm_bindgen]
pub struct Clips {
    proportions: Proportions,
    rate_hz: f32,
    own: Vec<NeutralClip>,
    spare: Vec<NeutralClip>,
    takes: Vec<NeutralClip>,
}

/// Which clips one is among.
#[wasm_bindgen]
#[derive(Clone, Copy, Debug)]
pub enum Among {
    /// Those of the database.
    Own,
    /// Those that walk where it has too little walking.
    Spare,
    /// Takes that it lacks.
    Takes,
}

#[wasm_bindgen]
impl Clips {
    /// No clips yet, on a body (21 × xyz, metres) and at a rate.
    ///
    /// # Errors
    /// If the offsets are not 63 numbers.
    #[wasm_bindgen(constructor)]
    pub fn new(proportions: &[f32], rate_hz: f32) -> Result<Self, EngineError> {
        let (own, spare, takes) = (Vec::new(), Vec::new(), Vec::new());
        Ok(Self { proportions: proportions_of(proportions)?, rate_hz, own, spare, takes })
    }

    /// Adds a clip of an action: its poses in the world, and which feet are planted in each, left and right interleaved. One of
    /// another body and rate is carried over.
    ///
    /// # Errors
    /// If an array has another length than it should, or there are too many frames at this rate.
    #[allow(clippy::too_many_arguments)] // One call instead of an object that both sides would have to spell out.
    pub fn add(
        &mut self,
        among: Among,
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
            Among::Own => self.own.push(clip),
            Among::Spare => self.spare.push(clip),
            Among::Takes => self.takes.push(clip),
        }
        Ok(())
    }
}

impl Clips {
    /// What is driven with of them.
    ///
    /// # Errors
    /// If there is too little locomotion among them.
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
