//! Handle of a database and of query motion outside it.

use crate::common::EngineError;
use crate::common::floats_of;
use strut_core::database::Database;
use strut_core::search::Index;
use strut_demo::benchmark::{self, Query};
use strut_formats::strutdb;
use wasm_bindgen::prelude::wasm_bindgen;

/// A database and motion for benchmarks.
#[wasm_bindgen]
pub struct Workload {
    database: Database,
    queries: Vec<Query>,
}

#[wasm_bindgen]
impl Workload {
    /// Creates the procedural database with this number of frames.
    ///
    /// # Errors
    /// None.
    pub fn procedural(frames: usize) -> Result<Self, EngineError> {
        let database = benchmark::database(frames).map_err(EngineError::bad_input)?;
        Ok(Self { database, queries: benchmark::queries() })
    }

    /// Reads a `.strutdb` file and removes some clips from it, which become the queries.
    ///
    /// # Errors
    /// If the bytes are invalid.
    #[wasm_bindgen(js_name = heldOutOf)]
    pub fn held_out_of(bytes: &[u8]) -> Result<Self, EngineError> {
        let whole = strutdb::read(bytes).map_err(|e| EngineError::bad_file(e, ""))?.database;
        let (database, queries) = benchmark::hold_out(&whole)
            .ok_or_else(|| EngineError::bad_input("no class has two clips, of which one could be held out"))?;
        Ok(Self { database, queries })
    }

    /// Returns the database as a `.strutdb` file.
    pub fn database(&self) -> Vec<u8> {
        strutdb::write(&self.database, &Index::build(&self.database).plan(), strut_formats::GENERATOR)
    }

    /// Returns the number of queries.
    pub fn queries(&self) -> usize {
        self.queries.len()
    }

    /// Returns the index of a query's action.
    pub fn action(&self, query: usize) -> u16 {
        self.queries[query].action
    }

    /// Returns the index of a query's style.
    pub fn style(&self, query: usize) -> u16 {
        self.queries[query].style
    }

    /// Returns a query's poses.
    pub fn poses(&self, query: usize) -> Vec<f32> {
        floats_of(self.queries[query].motion.poses.iter())
    }
}
