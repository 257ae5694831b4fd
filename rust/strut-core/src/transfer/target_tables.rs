//! The target tables of a model: those that stylizers use, and as many others as are small.

use crate::catalogue::{Catalogue, CatalogueSize, TargetTable};
use std::sync::{Arc, Mutex, PoisonError};

/// Bytes of tables that are kept though no stylizer uses them. They are those of 11 styles for 80,000 rows.
const IDLE_BYTES: u64 = 128_000_000;

/// Tables by their last use, the latest last.
#[derive(Debug, Default)]
pub(super) struct TargetTables {
    tables: Mutex<Vec<Arc<TargetTable>>>,
}

impl TargetTables {
    /// The table of a style, which is made unless it is here. Before, of those that nobody uses the ones that have not been
    /// used longest are dropped until those left, but for one, take [`IDLE_BYTES`] at most.
    ///
    /// # Panics
    /// If there is no such style.
    pub(super) fn of(&self, catalogue: &Arc<Catalogue>, style: u16) -> Arc<TargetTable> {
        let mut tables = self.tables.lock().unwrap_or_else(PoisonError::into_inner);
        let table = if let Some(at) = tables.iter().position(|table| table.style() == style) {
            tables.remove(at)
        } else {
            let most = (IDLE_BYTES / CatalogueSize::of(catalogue).table_bytes().max(1)).max(1) as usize;
            drop_idle(&mut tables, most);
            Arc::new(TargetTable::new(Arc::clone(catalogue), style))
        };
        tables.push(Arc::clone(&table));
        table
    }
}

/// Leaves at most so many tables that nobody uses.
fn drop_idle(tables: &mut Vec<Arc<TargetTable>>, most: usize) {
    let is_idle = |table: &Arc<TargetTable>| Arc::strong_count(table) == 1;
    let mut surplus = tables.iter().filter(|table| is_idle(table)).count().saturating_sub(most);
    tables.retain(|table| {
        let drops = surplus > 0 && is_idle(table);
        surplus -= usize::from(drops);
        !drops
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixtures::database;

    #[test]
    fn the_longest_idle_tables_are_dropped_first_and_those_in_use_never() {
        let catalogue = Arc::new(Catalogue::new(database()));
        let mut tables: Vec<_> =
            [0, 1, 0, 1, 0].map(|style| Arc::new(TargetTable::new(Arc::clone(&catalogue), style))).into();
        let all: Vec<_> = tables.iter().map(Arc::as_ptr).collect();
        let used = Arc::clone(&tables[0]);
        let kept = |tables: &[Arc<TargetTable>]| {
            (0..5).filter(|&i| tables.iter().any(|table| Arc::as_ptr(table) == all[i])).collect::<Vec<_>>()
        };
        drop_idle(&mut tables, 4);
        assert_eq!(kept(&tables), [0, 1, 2, 3, 4]);
        drop_idle(&mut tables, 1);
        assert_eq!(kept(&tables), [0, 4]);
        drop(used);
        drop_idle(&mut tables, 0);
        assert!(tables.is_empty());
    }

    #[test]
    fn a_table_is_made_once() {
        let (tables, catalogue) = (TargetTables::default(), Arc::new(Catalogue::new(database())));
        let [first, other, again] = [1, 0, 1].map(|style| tables.of(&catalogue, style));
        assert!(Arc::ptr_eq(&first, &again) && !Arc::ptr_eq(&first, &other));
    }
}
