//! Data shared by all stylizers of one database.

use super::target_tables::TargetTables;
use super::timing::Scales;
use crate::catalogue::{Catalogue, QuantisedRows, TargetTable};
use crate::database::Database;
use crate::search::Index;
use std::any::Any;
use std::sync::{Arc, Mutex, PoisonError};

/// A catalogue with the target tables of the styles in use. Share it in an [`Arc`] between the characters of a scene: a
/// table takes up to 12 MB for 80,000 frames.
#[derive(Debug)]
pub struct Model {
    catalogue: Arc<Catalogue>,
    tables: TargetTables,
    scales: Scales,
    /// See [`Model::extension`].
    extensions: Mutex<Vec<Arc<dyn Any + Send + Sync>>>,
}

impl Model {
    /// Creates the model of a database; builds the search index.
    pub fn new(db: Database) -> Self {
        Self::of(Catalogue::new(db))
    }

    /// Creates the model of a catalogue.
    pub fn of(catalogue: Catalogue) -> Self {
        Self {
            scales: Scales::new(catalogue.sigma(), catalogue.step_sigma()),
            tables: TargetTables::default(),
            extensions: Mutex::default(),
            catalogue: Arc::new(catalogue),
        }
    }

    /// The catalogue.
    pub fn catalogue(&self) -> &Catalogue {
        &self.catalogue
    }

    /// The catalogue's rows.
    pub fn rows(&self) -> &QuantisedRows {
        self.catalogue.rows()
    }

    /// The catalogue's search index.
    pub fn index(&self) -> &Index {
        self.catalogue.index()
    }

    /// Target of every row in a style. The table is computed at the style's first use, and kept while it is in use.
    /// Small tables are kept longer.
    ///
    /// # Panics
    /// If the style does not exist.
    pub fn target_table(&self, style: usize) -> Arc<TargetTable> {
        self.tables.of(&self.catalogue, style as u16)
    }

    /// The value of a type that is kept as long as the model, created at the first use: what a
    /// [`TrainedMethod`](super::TrainedMethod) shares among styles and characters.
    pub fn extension<T: Any + Default + Send + Sync>(&self) -> Arc<T> {
        let mut extensions = self.extensions.lock().unwrap_or_else(PoisonError::into_inner);
        let existing = extensions.iter().find_map(|kept| Arc::clone(kept).downcast().ok());
        existing.unwrap_or_else(|| {
            let new = Arc::<T>::default();
            extensions.push(Arc::clone(&new) as Arc<dyn Any + Send + Sync>);
            new
        })
    }

    pub(super) fn scales(&self) -> &Scales {
        &self.scales
    }
}
