//! Handle of the training of a walk model from a database.

use crate::build::progress::Progress;
use crate::common::{EngineError, read_database, sentence};
use js_sys::Uint8Array;
use strut_core::database::Database;
use strut_core::hsmm::{
    LabelledClip, Options, Track, Trainer, WalkModel, landmarks, walk_of, walking_action, walks_among,
};
use strut_core::incremental::IncrementalJob;
use strut_core::parallel::Sequential;
use strut_formats::GENERATOR;
use strut_formats::walk_model;
use wasm_bindgen::prelude::wasm_bindgen;

/// Training on the walks of a database, in steps. Between two steps messages are handled, and the training may be
/// cancelled.
#[wasm_bindgen]
pub struct WalkTraining {
    database: Database,
    /// Indices of the clips that are not read yet, the next one last.
    unread: Vec<usize>,
    /// Index of every clip that is a walk, the walk, and its number of steps.
    walks: Vec<(usize, Track, usize)>,
    trainer: Option<Trainer>,
    refused: Vec<String>,
}

#[wasm_bindgen]
impl WalkTraining {
    /// Creates a training on a `.strutdb` file or packed motions.
    ///
    /// # Errors
    /// If the file is invalid.
    #[wasm_bindgen(constructor)]
    pub fn new(database: Uint8Array) -> Result<Self, EngineError> {
        let database = read_database(database)?;
        let unread = walks_among(&database).into_iter().rev().collect();
        Ok(Self { database, unread, walks: Vec::new(), trainer: None, refused: Vec::new() })
    }

    /// Processes one clip or one style. Returns whether steps remain before [`WalkTraining::finish`].
    ///
    /// # Errors
    /// If there is no usable walk.
    pub fn step(&mut self, listener: &Progress) -> Result<bool, EngineError> {
        if let Some(clip) = self.unread.pop() {
            match walk_of(&self.database.motion_of_clip(clip)) {
                Ok((track, steps)) => self.walks.push((clip, track, steps)),
                Err(reason) => self.refused.extend([self.database.clips[clip].name.clone(), sentence(reason)]),
            }
            let done = self.walks.len() + self.refused.len() / 2;
            listener.progress("reading", done, done + self.unread.len());
            return Ok(true);
        }
        if self.trainer.is_none() {
            self.trainer = Some(self.begin()?);
        }
        let Some(trainer) = &mut self.trainer else { return Ok(false) };
        let Ok(come) = trainer.step(&Sequential);
        if let Some(p) = come {
            listener.progress("training", p.done, p.total);
        }
        Ok(come.is_some())
    }

    /// Returns the model, after the last step.
    ///
    /// # Errors
    /// If there is no usable walk.
    pub fn finish(mut self) -> Result<TrainedWalk, EngineError> {
        let trainer = match self.trainer.take() {
            Some(trainer) => trainer,
            None => self.begin()?,
        };
        let clips = self.walks.len();
        let Ok(model) = trainer.finish(&Sequential);
        let bytes = walk_model::write(&model, GENERATOR);
        Ok(TrainedWalk { model, bytes, clips, refused: self.refused })
    }
}

impl WalkTraining {
    fn begin(&mut self) -> Result<Trainer, EngineError> {
        let db = &self.database;
        let (styles, actions, clips) = (&db.styles, &db.actions, &db.clips);
        let steps: Vec<(u16, usize)> = self.walks.iter().map(|(i, _, steps)| (clips[*i].action, *steps)).collect();
        let walking = walking_action(&steps);
        let is_walking = |i: usize| Some(clips[i].action) == walking;
        for (i, ..) in self.walks.iter().filter(|walk| !is_walking(walk.0)) {
            let reason = format!(
                "its action is not '{}', the action with the most steps",
                actions[usize::from(walking.unwrap_or(0))]
            );
            self.refused.extend([clips[*i].name.clone(), sentence(reason)]);
        }
        self.walks.retain(|walk| is_walking(walk.0));
        // The styles keep the order of the database.
        self.walks.sort_by_key(|walk| clips[walk.0].style);
        let clips: Vec<LabelledClip> = self
            .walks
            .iter()
            .map(|(i, track, _)| LabelledClip { style: &styles[usize::from(clips[*i].style)], track })
            .collect();
        let landmarks = landmarks(&clips);
        let clips: Vec<LabelledClip> =
            clips.iter().zip(&landmarks).map(|(clip, style)| LabelledClip { style, track: clip.track }).collect();
        Trainer::new(&self.database.proportions, &clips, Options::default(), &Sequential)
            .map_err(EngineError::bad_input)
    }
}

/// A trained model.
#[wasm_bindgen]
pub struct TrainedWalk {
    model: WalkModel,
    bytes: Vec<u8>,
    clips: usize,
    refused: Vec<String>,
}

#[wasm_bindgen]
impl TrainedWalk {
    /// Returns the `.strutwalk` file.
    pub fn file(&self) -> Vec<u8> {
        self.bytes.clone()
    }

    /// Returns the names of the styles.
    pub fn styles(&self) -> Vec<String> {
        self.model.styles.clone()
    }

    /// Returns the number of clips that the model was trained on.
    pub fn clips(&self) -> usize {
        self.clips
    }

    /// Returns name and reason of every refused clip, alternately.
    pub fn refused(&self) -> Vec<String> {
        self.refused.clone()
    }
}
