//! The data that all stylizers of one database share.

use super::timing::Scales;
use crate::catalogue::{Catalogue, QuantisedRows, TargetTable};
use crate::database::Database;
use crate::search::Index;
use std::sync::OnceLock;

/// A catalogue with the target tables of the styles used so far. Share it in an [`Arc`](std::sync::Arc) between the
/// characters of a scene: a table is 12 MB for 80,000 frames.
#[derive(Debug)]
pub struct Model {
    catalogue: Catalogue,
    tables: Box<[OnceLock<TargetTable>]>,
    scales: Scales,
    #[cfg(feature = "baselines")]
    baselines: crate::baselines::Baselines,
}

impl Model {
    /// The model of a database; builds the search index.
    pub fn new(db: Database) -> Self {
        Self::of(Catalogue::new(db))
    }

    /// The model of a catalogue.
    pub fn of(catalogue: Catalogue) -> Self {
        Self {
            scales: Scales::new(catalogue.sigma(), catalogue.step_sigma()),
            tables: catalogue.styles.iter().map(|_| OnceLock::new()).collect(),
            #[cfg(feature = "baselines")]
            baselines: crate::baselines::Baselines::default(),
            catalogue,
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

    /// The target of every row in a style; built when the style is first used.
    ///
    /// # Panics
    /// If there is no such style.
    pub fn target_table(&self, style: usize) -> &TargetTable {
        self.tables[style].get_or_init(|| TargetTable::build(&self.catalogue, style as u16))
    }

    /// The trained predictors of those [`super::Method`]s that need training.
    #[cfg(feature = "baselines")]
    pub(crate) fn baselines(&self) -> &crate::baselines::Baselines {
        &self.baselines
    }

    pub(super) fn scales(&self) -> &Scales {
        &self.scales
    }
}
