//! Handle of a walk model's training: a database goes in, a `.strutwalk` file comes out.

use crate::progress::Progress;
use js_sys::Uint8Array;
use strut_core::database::Database;
use strut_core::hsmm::{
    LabelledClip, Options, Track, Trainer, WalkModel, landmarks, walk_of, walking_action, walks_among,
};
use strut_core::incremental::IncrementalJob;
use strut_core::parallel::Sequential;
use strut_formats::GENERATOR;
use strut_formats::walk_model;
use strut_wasm_common::{EngineError, read_database, sentence};
use wasm_bindgen::prelude::wasm_bindgen;

/// Training on the walks of a database, in steps, between which messages are heard and the training may be given up.
#[wasm_bindgen]
pub struct WalkTraining {
    database: Database,
    /// Clips that are still to be read, the next one last.
    unread: Vec<usize>,
    /// Number of every clip that is a walk, the walk, and its steps.
    walks: Vec<(usize, Track, usize)>,
    trainer: Option<Trainer>,
    refused: Vec<String>,
}

#[wasm_bindgen]
impl WalkTraining {
    /// On a `.strutdb` file or packed motions.
    ///
    /// # Errors
    /// With what is wrong with the file.
    #[wasm_bindgen(constructor)]
    pub fn new(database: Uint8Array) -> Result<Self, EngineError> {
        let database = read_database(database)?;
        let unread = walks_among(&database).into_iter().rev().collect();
        Ok(Self { database, unread, walks: Vec::new(), trainer: None, refused: Vec::new() })
    }

    /// Goes on by a clip or a style; whether anything was left but to finish.
    ///
    /// # Errors
    /// If nothing can be trained on.
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

    /// The model, once nothing is left.
    ///
    /// # Errors
    /// If nothing could be trained on.
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
                "it is of another action than '{}', of which there are most steps",
                actions[usize::from(walking.unwrap_or(0))]
            );
            self.refused.extend([clips[*i].name.clone(), sentence(reason)]);
        }
        self.walks.retain(|walk| is_walking(walk.0));
        // The styles keep the database's order.
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

/// A model that was trained.
#[wasm_bindgen]
pub struct TrainedWalk {
    model: WalkModel,
    bytes: Vec<u8>,
    clips: usize,
    refused: Vec<String>,
}

#[wasm_bindgen]
impl TrainedWalk {
    /// The `.strutwalk` file.
    pub fn file(&self) -> Vec<u8> {
        self.bytes.clone()
    }

    /// Names of the styles.
    pub fn styles(&self) -> Vec<String> {
        self.model.styles.clone()
    }

    /// Number of clips that it was trained on.
    pub fn clips(&self) -> usize {
        self.clips
    }

    /// Name of and reason for every clip that was left out, in turn.
    pub fn refused(&self) -> Vec<String> {
        self.refused.clone()
    }
}
