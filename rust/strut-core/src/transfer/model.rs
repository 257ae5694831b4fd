//! What all stylizers of one database share.

use super::timing::Scales;
use crate::database::{Database, QuantisedRows, TargetTable};
use crate::pose_vector::{DOFS, PoseRow, ROW};
use crate::search::Index;
use std::sync::OnceLock;

/// A database with its search index and the target tables of the styles used so far. Share it in an
/// [`Arc`](std::sync::Arc) between the characters of a scene: a table is 12 MB for 80,000 frames.
#[derive(Debug)]
pub struct Model {
    db: Database,
    rows: QuantisedRows,
    index: Index,
    tables: Box<[OnceLock<TargetTable>]>,
    scales: Scales,
    #[cfg(feature = "offline")]
    baselines: crate::baselines::Baselines,
}

impl Model {
    /// Indexes a database.
    pub fn new(db: Database) -> Self {
        let index = Index::build(&db);
        Self::with_index(db, index)
    }

    /// A database and its index, which makes the database's point clouds superfluous: they are forgotten. Its rows are
    /// kept quantised.
    pub fn with_index(mut db: Database, index: Index) -> Self {
        db.forget_point_clouds();
        let scales = Scales::new(db.sigma(), &step_deviation(&db));
        let rows = QuantisedRows::of(&db);
        db.forget_rows();
        let tables = db.styles.iter().map(|_| OnceLock::new()).collect();
        Self {
            db,
            rows,
            index,
            tables,
            scales,
            #[cfg(feature = "offline")]
            baselines: crate::baselines::Baselines::default(),
        }
    }

    /// The database, without its rows and point clouds.
    pub fn database(&self) -> &Database {
        &self.db
    }

    /// The database's rows.
    pub fn rows(&self) -> &QuantisedRows {
        &self.rows
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
        self.tables[style].get_or_init(|| TargetTable::of_rows(&self.db, &self.rows, style as u16))
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
    let (mut sums, mut squares, mut count) = ([0.0_f64; ROW], [0.0_f64; ROW], 0.0_f64);
    for clip in &db.clips {
        for pair in db.pose[clip.rows()].windows(2) {
            count += 1.0;
            add_step([&pair[0], &pair[1]], &mut sums, &mut squares);
        }
    }
    let n = count.max(1.0);
    let deviation = |d: usize| (squares[d] / n - (sums[d] / n) * (sums[d] / n)).max(0.0).sqrt() as f32;
    std::array::from_fn(|d| if d < DOFS { deviation(d).max(1e-5) } else { 1.0 })
}

#[inline(never)] // In WebAssembly a function becomes fast once it has been called often.
fn add_step([from, to]: [&PoseRow; 2], sums: &mut [f64; ROW], squares: &mut [f64; ROW]) {
    for (d, (sum, square)) in sums.iter_mut().zip(squares).enumerate() {
        let step = f64::from(to[d]) - f64::from(from[d]);
        *sum += step;
        *square += step * step;
    }
}
