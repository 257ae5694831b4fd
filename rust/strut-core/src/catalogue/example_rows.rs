//! Rows of the examples in a catalogue.

use super::quantised::{QuantisedRows, Quantiser, Rows, Steps};
use super::target_table::TargetTable;
use crate::math::lanes::Lane;

/// Rows of the examples: their inputs x, or their targets y in a style. A single type for both, so that the code that
/// reads them is compiled once.
#[derive(Clone, Copy, Debug)]
pub(crate) enum ExampleRows<'a> {
    Inputs(&'a QuantisedRows),
    Targets(&'a TargetTable),
}

impl ExampleRows<'_> {
    #[inline]
    fn quantiser(&self) -> &Quantiser {
        match self {
            Self::Inputs(rows) => rows.quantiser(),
            Self::Targets(table) => table.quantiser(),
        }
    }

    #[inline]
    fn steps(&self, row: usize) -> &Steps {
        match self {
            Self::Inputs(rows) => rows.steps(row),
            Self::Targets(table) => table.steps(row),
        }
    }
}

impl Rows for ExampleRows<'_> {
    #[inline]
    fn lane(&self, row: usize, l: usize) -> Lane {
        self.quantiser().lane(self.steps(row), l)
    }

    #[inline]
    fn pair(&self, row: usize) -> impl Fn(usize) -> [Lane; 2] {
        // Each row is looked up once for all lanes.
        let [before, at] = [row - 1, row].map(|row| self.steps(row));
        let quantiser = self.quantiser();
        move |l| [before, at].map(|steps| quantiser.lane(steps, l))
    }
}
