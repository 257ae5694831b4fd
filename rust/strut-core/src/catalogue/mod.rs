//! Runtime form of a database: compact, indexed and read-only.

mod builder;
mod example_rows;
mod gait_phase;
mod header;
mod memory;
mod quantised;
mod runtime;
mod target_table;

pub use builder::{CatalogueBuilder, RowReader};
pub(crate) use example_rows::ExampleRows;
pub use gait_phase::GaitPhase;
pub use header::Header;
pub use memory::CatalogueSize;
pub use quantised::QuantisedRows;
pub(crate) use quantised::Rows;
pub use runtime::Catalogue;
pub use target_table::TargetTable;
