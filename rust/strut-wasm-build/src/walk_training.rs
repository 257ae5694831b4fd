//! Handle of a walk model's training: a database goes in, a `.strutwalk` file comes out.

use crate::builder::Progress;
use crate::labels::text;
use strut_core::database::Database;
use strut_core::hsmm::{Options, Track, Trainer, Training, WalkModel, walk_of, walks_among};
use strut_core::parallel::Sequential;
use strut_formats::strutdb;
use strut_formats::walk_model;
use wasm_bindgen::prelude::wasm_bindgen;

/// Training on the walks of a database, in steps, between which messages are heard and the training may be given up.
#[wasm_bindgen]
pub struct WalkTraining {
    database: Database,
    /// Clips that are still to be read, the next one last.
    unread: Vec<usize>,
    /// Style and walk of every clip that is one.
    walks: Vec<(u16, Track)>,
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
    pub fn new(database: Vec<u8>) -> Result<Self, String> {
        let database = read_database(&database)?;
        let unread = walks_among(&database).into_iter().rev().collect();
        Ok(Self { database, unread, walks: Vec::new(), trainer: None, refused: Vec::new() })
    }

    /// Goes on by a clip or a style; whether anything was left but to finish.
    ///
    /// # Errors
    /// If nothing can be trained on.
    pub fn step(&mut self, listener: &Progress) -> Result<bool, String> {
        if let Some(clip) = self.unread.pop() {
            match walk_of(&self.database, clip) {
                Ok(track) => self.walks.push((self.database.clips[clip].style, track)),
                Err(reason) => self.refused.extend([self.database.clips[clip].name.clone(), reason]),
            }
            let done = self.walks.len() + self.refused.len() / 2;
            listener.progress("reading", done, done + self.unread.len());
            return Ok(true);
        }
        let trainer = match &mut self.trainer {
            Some(trainer) => trainer,
            None => self.trainer.insert(self.begin()?),
        };
        let come = trainer.step(1, &Sequential);
        if let Some(p) = come {
            listener.progress("training", p.done, p.total);
        }
        Ok(come.is_some())
    }

    /// The model, once nothing is left.
    ///
    /// # Errors
    /// If nothing could be trained on.
    pub fn finish(mut self) -> Result<TrainedWalk, String> {
        let trainer = self.trainer.take().map_or_else(|| self.begin(), Ok)?;
        let clips = self.walks.len();
        let model = trainer.finish();
        let bytes = walk_model::write(&model, strutdb::GENERATOR);
        Ok(TrainedWalk { model, bytes, clips, refused: self.refused })
    }
}

impl WalkTraining {
    fn begin(&self) -> Result<Trainer, String> {
        let styles = &self.database.styles;
        // The styles keep the database's order.
        let mut walks: Vec<&(u16, Track)> = self.walks.iter().collect();
        walks.sort_by_key(|(style, _)| *style);
        let clips: Vec<Training> =
            walks.iter().map(|(style, track)| Training { style: &styles[usize::from(*style)], track }).collect();
        Trainer::new(&self.database.proportions, &clips, Options::default(), &Sequential).map_err(text)
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

/// The database in a `.strutdb` file or in packed motions.
pub(crate) fn read_database(bytes: &[u8]) -> Result<Database, String> {
    let read = if bytes.starts_with(&strutdb::packed::MAGIC) {
        strutdb::packed::read_database(bytes)
    } else {
        strutdb::read(bytes).map(|contents| contents.database)
    };
    read.map_err(text)
}
