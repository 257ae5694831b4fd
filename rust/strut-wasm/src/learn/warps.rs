//! Handle of an action's clips that are compared as registration compares them.

use crate::database::Database;
use std::ops::RangeInclusive;
use std::sync::Arc;
use strut_core::registration::{Compared, WarpMethod};
use strut_core::transfer;
use strut_wasm_common::EngineError;
use wasm_bindgen::prelude::wasm_bindgen;

/// The clips of an action.
#[wasm_bindgen]
pub struct Warps(transfer::Warps);

#[wasm_bindgen]
impl Warps {
    /// Of an action by its number; takes a second for some minutes of motion.
    ///
    /// # Errors
    /// If there is no such action.
    #[wasm_bindgen(constructor)]
    pub fn new(database: &Database, action: u16) -> Result<Self, EngineError> {
        transfer::Warps::new(Arc::clone(database.model()), action).map(Self).map_err(EngineError::bad_input)
    }

    /// Names of all clips of the database; their place is their number.
    #[wasm_bindgen(js_name = clipNames)]
    pub fn clip_names(&self) -> Vec<String> {
        self.0.model().catalogue().clips.iter().map(|clip| clip.name.clone()).collect()
    }

    /// First frames and lengths of a clip's gait cycles, interleaved.
    ///
    /// # Errors
    /// If the clip is none of the action's.
    pub fn cycles(&self, clip: usize) -> Result<Vec<u32>, EngineError> {
        let cycles = self.0.cycles(clip).map_err(EngineError::bad_input)?;
        Ok(cycles.iter().flat_map(|c| [c.start as u32, c.len() as u32]).collect())
    }

    /// The row of a clip's first frame, and how many it has.
    ///
    /// # Errors
    /// If there is no such clip.
    pub fn rows(&self, clip: usize) -> Result<Vec<u32>, EngineError> {
        let clip = self.0.model().catalogue().clips.get(clip);
        let clip = clip.ok_or_else(|| EngineError::bad_input("there is no such clip"))?;
        Ok(vec![clip.first_frame as u32, clip.frames as u32])
    }

    /// Planted feet of a clip, left and right interleaved.
    ///
    /// # Errors
    /// If there is no such clip.
    pub fn contacts(&self, clip: usize) -> Result<Vec<u8>, EngineError> {
        let catalogue = self.0.model().catalogue();
        let clip = catalogue.clips.get(clip).ok_or_else(|| EngineError::bad_input("there is no such clip"))?;
        Ok(clip.rows().flat_map(|row| catalogue.contact(row)).collect())
    }

    /// Compares the frames `first` to `last` of two clips: by dynamic time warping ("dtw"), iterative motion warping
    /// ("imw") or linear time ("linear").
    ///
    /// # Errors
    /// If a clip or a frame is not there, or there is no such method.
    #[allow(clippy::too_many_arguments)] // One call instead of an object that both sides would have to spell out.
    pub fn compare(
        &self,
        a: usize,
        a_first: usize,
        a_last: usize,
        b: usize,
        b_first: usize,
        b_last: usize,
        by: &str,
    ) -> Result<ComparedCycles, EngineError> {
        let by = match by {
            "dtw" => WarpMethod::Dtw,
            "imw" => WarpMethod::Imw,
            "linear" => WarpMethod::Linear,
            _ => return Err(EngineError::bad_input(format!("'{by}' is no way to warp; they are dtw, imw and linear"))),
        };
        let (a, b) = (stretch(a, a_first, a_last)?, stretch(b, b_first, b_last)?);
        Ok(ComparedCycles {
            compared: self.0.compare(&a, &b, by).map_err(EngineError::bad_input)?,
            recorded: self.0.recorded(&a, &b).map_err(EngineError::bad_input)?,
        })
    }
}

fn stretch(clip: usize, first: usize, last: usize) -> Result<(usize, RangeInclusive<usize>), EngineError> {
    if first > last {
        return Err(EngineError::bad_input(format!("frames {first} to {last} were asked for")));
    }
    Ok((clip, first..=last))
}

/// Two stretches of clips, a and b, compared.
#[wasm_bindgen]
pub struct ComparedCycles {
    compared: Compared,
    recorded: Vec<f32>,
}

#[wasm_bindgen]
impl ComparedCycles {
    /// c of every frame of a and every frame of b, row after row of a.
    pub fn costs(&self) -> Vec<f32> {
        self.compared.costs.clone()
    }

    /// τ of every frame of a; empty if the slope limit allows no warp.
    pub fn warp(&self) -> Vec<f32> {
        self.compared.warp.clone().unwrap_or_default()
    }

    /// The counterpart in the database of every frame of a; NaN where it is in another clip.
    pub fn recorded(&self) -> Vec<f32> {
        self.recorded.clone()
    }

    /// α of the strongest principal feature in every frame of a, then its β; empty but for iterative motion warping.
    pub fn affine(&self) -> Vec<f32> {
        let column = |side: usize| self.compared.affine.iter().map(move |of| of[side][0]);
        column(0).chain(column(1)).collect()
    }
}
