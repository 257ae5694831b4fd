//! Handles of the training of a key-style model from clips.

use crate::build::progress::Progress;
use crate::common::{EngineError, read_database};
use js_sys::Uint8Array;
use strut_core::database::Database;
use strut_core::humanoid::{HumanoidMotion, Proportions};
use strut_core::incremental::IncrementalJob;
use strut_core::parallel::Sequential;
use strut_core::retarget::to_humanoid;
use strut_core::somn::{EM_RIDGE, KeyStyleModel, Learning, Measure, Options, Recording, SEED, Trainer};
use strut_formats::corpus::Clip;
use strut_formats::key_style_model;
use wasm_bindgen::prelude::wasm_bindgen;

/// Clips for the training of models: those of a database, or BVH files.
#[wasm_bindgen]
#[derive(Default)]
pub struct KeyStyleClips {
    database: Option<Database>,
    files: Vec<(String, HumanoidMotion)>,
}

#[wasm_bindgen]
impl KeyStyleClips {
    /// Creates an empty list.
    #[wasm_bindgen(constructor)]
    pub fn new() -> Self {
        Self::default()
    }

    /// Creates the list of the clips of a `.strutdb` file or packed motions.
    ///
    /// # Errors
    /// If the file is invalid.
    #[wasm_bindgen(js_name = ofDatabase)]
    pub fn of_database(database: Uint8Array) -> Result<Self, EngineError> {
        Ok(Self { database: Some(read_database(database)?), files: Vec::new() })
    }

    /// Adds a BVH file. All clips are on the body of the first.
    ///
    /// # Errors
    /// If the file cannot be used, with the reason.
    #[wasm_bindgen(js_name = addFile)]
    pub fn add_file(&mut self, name: String, bytes: &[u8]) -> Result<(), EngineError> {
        let clip = Clip::parse(bytes).map_err(EngineError::unusable_file)?;
        let body: &Proportions = self.files.first().map_or(&clip.binding.proportions, |(_, first)| &first.proportions);
        let motion = to_humanoid(&clip.motion, &clip.binding, body);
        self.files.push((name, motion));
        Ok(())
    }

    /// Returns the names of the clips.
    pub fn names(&self) -> Vec<String> {
        let of_database = self.database.iter().flat_map(|db| db.clips.iter().map(|clip| clip.name.clone()));
        of_database.chain(self.files.iter().map(|(name, _)| name.clone())).collect()
    }

    /// Returns the actions of the clips; empty for files.
    pub fn actions(&self) -> Vec<String> {
        self.labels(|db, clip| db.actions[usize::from(db.clips[clip].action)].clone())
    }

    /// Returns the styles of the clips; empty for files.
    pub fn styles(&self) -> Vec<String> {
        self.labels(|db, clip| db.styles[usize::from(db.clips[clip].style)].clone())
    }

    /// Returns the durations of the clips, seconds.
    pub fn secs(&self) -> Vec<f32> {
        let of_database =
            self.database.iter().flat_map(|db| db.clips.iter().map(|clip| clip.frames as f32 / db.rate_hz));
        let of_files = self.files.iter().map(|(_, motion)| motion.poses.len() as f32 / motion.rate_hz);
        of_database.chain(of_files).collect()
    }

    /// Starts training on the clips with these indices. With `components` 0 their number is chosen automatically.
    ///
    /// # Errors
    /// If no model can be trained, with the reason.
    pub fn train(
        &self,
        clips: &[u32],
        axes: Vec<String>,
        components: usize,
        em: bool,
    ) -> Result<KeyStyleTraining, EngineError> {
        let axes = axes
            .iter()
            .map(|axis| Measure::parse(axis).map_err(EngineError::bad_input))
            .collect::<Result<Vec<_>, _>>()?;
        let recording = |clip: &u32| {
            let (name, motion) = self
                .motion(*clip as usize)
                .ok_or_else(|| EngineError::bad_input(format!("there is no clip {clip}")))?;
            Recording::new(name.clone(), &motion).map_err(|error| EngineError::bad_input(format!("{name}: {error}")))
        };
        let recordings = clips.iter().map(recording).collect::<Result<Vec<_>, _>>()?;
        let learning = if em { Learning::Em { ridge: EM_RIDGE } } else { Learning::Som };
        let options = Options { components: (components > 0).then_some(components), seed: SEED, learning };
        let borrowed: Vec<&Recording> = recordings.iter().collect();
        Ok(KeyStyleTraining { trainer: Trainer::new(&borrowed, &axes, options).map_err(EngineError::bad_input)? })
    }
}

impl KeyStyleClips {
    fn labels(&self, of: impl Fn(&Database, usize) -> String) -> Vec<String> {
        let of_database = self.database.iter().flat_map(|db| (0..db.clips.len()).map(|clip| of(db, clip)));
        of_database.chain(self.files.iter().map(|_| String::new())).collect()
    }

    fn motion(&self, clip: usize) -> Option<(String, HumanoidMotion)> {
        match &self.database {
            Some(db) => db.clips.get(clip).map(|c| (c.name.clone(), db.motion_of_clip(clip))),
            None => self.files.get(clip).cloned(),
        }
    }
}

/// Training in passes, which may be cancelled between passes.
#[wasm_bindgen]
pub struct KeyStyleTraining {
    trainer: Trainer,
}

#[wasm_bindgen]
impl KeyStyleTraining {
    /// Runs one pass. Returns whether passes remain before [`KeyStyleTraining::finish`].
    pub fn step(&mut self, listener: &Progress) -> bool {
        let Ok(come) = self.trainer.step(&Sequential);
        if let Some(p) = come {
            listener.progress("learning", p.done, p.total);
        }
        come.is_some()
    }

    /// Returns the model, after the last pass.
    pub fn finish(self) -> TrainedKeyStyle {
        let Ok(model) = self.trainer.finish(&Sequential);
        TrainedKeyStyle { model }
    }
}

/// A trained model.
#[wasm_bindgen]
pub struct TrainedKeyStyle {
    model: KeyStyleModel,
}

#[wasm_bindgen]
impl TrainedKeyStyle {
    /// Returns the `.strutkeys` file.
    pub fn file(&self) -> Vec<u8> {
        key_style_model::write(&self.model, strut_formats::GENERATOR)
    }

    /// Returns the share of the poses' variance that the style variables do not explain, if it is too large; otherwise
    /// 0.
    #[wasm_bindgen(js_name = unexplainedShare)]
    pub fn unexplained_share(&self) -> f64 {
        let share = self.model.unexplained_share();
        if share > KeyStyleModel::MAX_UNEXPLAINED_SHARE { share } else { 0.0 }
    }
}
