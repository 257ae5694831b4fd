//! Handle of the comparison of an action's clips, as registration does it.

use crate::common::EngineError;
use crate::engine::database::Database;
use std::ops::RangeInclusive;
use std::sync::Arc;
use strut_core::registration::{Compared, WarpMethod};
use strut_core::transfer;
use wasm_bindgen::prelude::wasm_bindgen;

/// The clips of an action.
#[wasm_bindgen]
pub struct Warps(transfer::Warps);

#[wasm_bindgen]
impl Warps {
    /// Loads the clips of an action by its index. Takes about a second for a few minutes of motion.
    ///
    /// # Errors
    /// If there is no such action.
    #[wasm_bindgen(constructor)]
    pub fn new(database: &Database, action: u16) -> Result<Self, EngineError> {
        transfer::Warps::new(Arc::clone(database.model()), action).map(Self).map_err(EngineError::bad_input)
    }

    /// Returns the names of all clips of the database, by index.
    #[wasm_bindgen(js_name = clipNames)]
    pub fn clip_names(&self) -> Vec<String> {
        self.0.model().catalogue().clips.iter().map(|clip| clip.name.clone()).collect()
    }

    /// Returns first frame and length of each gait cycle of a clip, interleaved.
    ///
    /// # Errors
    /// If the clip is not one of the action's.
    pub fn cycles(&self, clip: usize) -> Result<Vec<u32>, EngineError> {
        let cycles = self.0.cycles(clip).map_err(EngineError::bad_input)?;
        Ok(cycles.iter().flat_map(|c| [c.start as u32, c.len() as u32]).collect())
    }

    /// Returns the row of a clip's first frame, and its number of frames.
    ///
    /// # Errors
    /// If there is no such clip.
    pub fn rows(&self, clip: usize) -> Result<Vec<u32>, EngineError> {
        let clip = self.0.model().catalogue().clips.get(clip);
        let clip = clip.ok_or_else(|| EngineError::bad_input("there is no such clip"))?;
        Ok(vec![clip.first_frame as u32, clip.frames as u32])
    }

    /// Returns the planted feet of a clip, left and right interleaved.
    ///
    /// # Errors
    /// If there is no such clip.
    pub fn contacts(&self, clip: usize) -> Result<Vec<u8>, EngineError> {
        let catalogue = self.0.model().catalogue();
        let clip = catalogue.clips.get(clip).ok_or_else(|| EngineError::bad_input("there is no such clip"))?;
        Ok(clip.rows().flat_map(|row| catalogue.contact(row)).collect())
    }

    /// Compares the frames `first` to `last` of two clips by dynamic time warping ("dtw"), iterative motion warping
    /// ("imw") or linear time ("linear").
    ///
    /// # Errors
    /// If a clip or a frame does not exist, or there is no such method.
    #[allow(clippy::too_many_arguments)] // One call instead of an object that both sides would have to define.
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
            _ => {
                return Err(EngineError::bad_input(format!(
                    "'{by:.40}' is not a warping method; dtw, imw or linear was expected"
                )));
            }
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
        return Err(EngineError::bad_input(format!("frames {first} to {last} were requested")));
    }
    Ok((clip, first..=last))
}

/// A comparison of two clip segments, a and b.
#[wasm_bindgen]
pub struct ComparedCycles {
    compared: Compared,
    recorded: Vec<f32>,
}

#[wasm_bindgen]
impl ComparedCycles {
    /// Returns c of every frame of a and every frame of b, row by row of a.
    pub fn costs(&self) -> Vec<f32> {
        self.compared.costs.clone()
    }

    /// Returns τ of every frame of a; empty if the slope limit allows no warp.
    pub fn warp(&self) -> Vec<f32> {
        self.compared.warp.clone().unwrap_or_default()
    }

    /// Returns the counterpart in the database of every frame of a; NaN if it is in another clip.
    pub fn recorded(&self) -> Vec<f32> {
        self.recorded.clone()
    }

    /// Returns α of the strongest principal feature in every frame of a, then its β; empty except for iterative motion
    /// warping.
    pub fn affine(&self) -> Vec<f32> {
        let column = |side: usize| self.compared.affine.iter().map(move |of| of[side][0]);
        column(0).chain(column(1)).collect()
    }
}
