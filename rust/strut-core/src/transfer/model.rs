//! What all stylizers of one database share.

use super::timing::Scales;
use crate::database::{Database, TargetTable};
use crate::pose_vector::{DOFS, PoseRow, ROW};
use crate::search::{Index, WINDOW};
use std::sync::{Arc, OnceLock};

/// A database with its search index and the target tables of the styles used so far. Share it in an
/// [`Arc`] between the characters of a scene: a table is 21 MB for 80,000 frames.
#[derive(Debug)]
pub struct Model {
    db: Arc<Database>,
    index: Index,
    tables: Box<[OnceLock<TargetTable>]>,
    scales: Scales,
    #[cfg(feature = "offline")]
    baselines: crate::baselines::Baselines,
}

impl Model {
    /// Indexes a database.
    pub fn new(db: Arc<Database>) -> Self {
        Self::with_window(db, WINDOW)
    }

    /// Indexes a database by windows of `frames` frames instead of [`WINDOW`] (s in the specification); the
    /// nearest of 1 to [`crate::search::MAX_WINDOW`] is taken.
    pub fn with_window(db: Arc<Database>, frames: usize) -> Self {
        let index = Index::with_window(&db, frames);
        let scales = Scales::new(db.sigma(), &step_deviation(&db));
        let tables = db.styles.iter().map(|_| OnceLock::new()).collect();
        Self {
            db,
            index,
            tables,
            scales,
            #[cfg(feature = "offline")]
            baselines: crate::baselines::Baselines::default(),
        }
    }

    /// The database.
    pub fn database(&self) -> &Database {
        &self.db
    }

    /// The search index.
    pub fn index(&self) -> &Index {
        &self.index
    }

    /// What every row becomes in a style; built when a style is first asked for.
    ///
    /// # Panics
    /// If there is no such style.
    pub fn target_table(&self, style: usize) -> &TargetTable {
        self.tables[style].get_or_init(|| TargetTable::build(&self.db, style as u16))
    }

    /// The predictors that were trained for the methods of [`super::Method`] that need it.
    #[cfg(feature = "offline")]
    pub(crate) fn baselines(&self) -> &crate::baselines::Baselines {
        &self.baselines
    }

    pub(super) fn scales(&self) -> &Scales {
        &self.scales
    }
}

/// Standard deviation of each degree of freedom's change from one frame to the next, floored like
/// [`Database::sigma`]; padding is 1.
fn step_deviation(db: &Database) -> PoseRow {
    let mut sums = [[0.0_f64; 2]; DOFS];
    let mut count = 0.0_f64;
    for clip in &db.clips {
        for row in clip.rows().skip(1) {
            count += 1.0;
            for (d, s) in sums.iter_mut().enumerate() {
                let step = f64::from(db.pose[row][d]) - f64::from(db.pose[row - 1][d]);
                s[0] += step;
                s[1] += step * step;
            }
        }
    }
    let n = count.max(1.0);
    let mut deviation = [1.0; ROW];
    for (out, [sum, squares]) in deviation.iter_mut().zip(sums) {
        *out = ((squares / n - (sum / n) * (sum / n)).max(0.0).sqrt() as f32).max(1e-5);
    }
    deviation
}
