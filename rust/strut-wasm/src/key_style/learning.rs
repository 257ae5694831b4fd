//! Handle of a training run for step-by-step display.

use crate::common::{EngineError, write_floats};
use crate::key_style::model::KeyStyleModel;
use js_sys::Float32Array;
use std::sync::Arc;
use strut_core::somn::{self, Component, Learning, MAX_COMPONENTS, Options, Trainer, Update};
use wasm_bindgen::prelude::wasm_bindgen;

/// Numbers of a frame before those of the components: updates so far, the last sample or −1, its pass's error so far, σ
/// and δ.
const HEAD: usize = 5;

/// A self-organising mixture network that is trained again on a model's recordings, in steps of any number of updates.
#[wasm_bindgen]
pub struct Somn {
    trainer: Trainer,
    model: Arc<somn::KeyStyleModel>,
    last: Option<Update>,
    shown: Box<[f32]>,
}

#[wasm_bindgen]
impl Somn {
    /// Creates a run before the first update. With `components` 0 it has as many as training uses. With `as_printed` it
    /// uses the signs of the paper's Eq. 7 and 8, with which it diverges.
    ///
    /// # Errors
    /// If there are too many components, or the model has too few frames.
    #[wasm_bindgen(constructor)]
    pub fn new(model: &KeyStyleModel, components: usize, seed: u32, as_printed: bool) -> Result<Self, EngineError> {
        if components > MAX_COMPONENTS {
            let expected = format!("{components} components were requested; at most {MAX_COMPONENTS} are supported");
            return Err(EngineError::bad_input(expected));
        }
        let learning = if as_printed { Learning::AsPrinted } else { Learning::Som };
        let options = Options { components: (components > 0).then_some(components), seed: seed.into(), learning };
        let trainer = Trainer::of_model(&model.model, options).map_err(EngineError::bad_input)?;
        let axes = model.model.axis_count();
        let shown = vec![0.0; HEAD + trainer.components().len() * (2 + 2 * axes)].into();
        let mut run = Self { trainer, model: Arc::clone(&model.model), last: None, shown };
        run.show();
        Ok(run)
    }

    /// Returns the number of components in training. Regions without poses are removed only by [`Somn::so_far`].
    pub fn components(&self) -> usize {
        self.trainer.components().len()
    }

    /// Returns the total number of updates.
    pub fn updates(&self) -> usize {
        self.trainer.updates()[1]
    }

    /// Runs a number of updates, or those that remain, and returns how many it ran. After a divergence it runs none.
    pub fn step(&mut self, updates: usize) -> usize {
        let mut made = 0;
        while made < updates
            && let Some(update) = self.trainer.update()
        {
            self.last = Some(update);
            made += 1;
        }
        self.show();
        made
    }

    /// Writes the present state to an array: updates so far, the last sample or −1, the error of its pass so far and σ
    /// in radians, δ; then for the components the responsibilities for that sample, the shares, and the centres and
    /// standard deviations of the regions, both in the units of the variables, one number per axis.
    ///
    /// # Errors
    /// If the array has another length.
    pub fn read(&self, into: &Float32Array) -> Result<(), EngineError> {
        write_floats(&self.shown, into)
    }

    /// Returns the model of the present components, as if training ended here.
    #[wasm_bindgen(js_name = soFar)]
    pub fn so_far(&self) -> KeyStyleModel {
        KeyStyleModel::of(self.trainer.so_far())
    }
}

impl Somn {
    fn show(&mut self) {
        let Self { trainer, model, last, shown } = self;
        let Some((head, rest)) = shown.split_first_chunk_mut::<HEAD>() else { return };
        let [sample, error, width, rate] =
            last.map_or([-1.0, 0.0, 0.0, 0.0], |u| [u.sample as f64, u.error, u.width, u.rate]);
        *head = [trainer.updates()[0] as f64, sample, error, width, rate].map(|value| value as f32);
        let somn::KeyStyleModel { style_deviation, .. } = &**model;
        let axes = model.axis_count();
        let all = trainer.components().iter();
        let centres = all.clone().flat_map(|c: &Component| model.in_units(&c.centre).into_iter().take(axes));
        let deviations = all.clone().flat_map(|c| (0..axes).map(|j| c.spread[j][j].sqrt() * style_deviation[j]));
        let numbers = trainer.responsibilities().iter().copied().chain(all.clone().map(|c| c.weight));
        let numbers = numbers.chain(centres).chain(deviations);
        rest.iter_mut().zip(numbers).for_each(|(out, value)| *out = value as f32);
    }
}
