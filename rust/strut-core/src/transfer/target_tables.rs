//! Target tables of a model: those in use by stylizers, and others up to a memory limit.

use crate::catalogue::{Catalogue, CatalogueSize, TargetTable};
use std::sync::{Arc, Mutex, PoisonError};

/// Limit of the tables that are kept without being in use, bytes. It holds 11 styles for 80,000 rows.
const IDLE_BYTES: u64 = 128_000_000;

/// Tables ordered by last use, the most recent last.
#[derive(Debug, Default)]
pub(super) struct TargetTables {
    tables: Mutex<Vec<Arc<TargetTable>>>,
}

impl TargetTables {
    /// Returns the table of a style, and computes it if it is missing. Before that, the least recently used of the
    /// tables not in use are dropped until the others but one take [`IDLE_BYTES`] at most.
    ///
    /// # Panics
    /// If the style does not exist.
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

/// Keeps at most `most` of the tables that are not in use.
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
