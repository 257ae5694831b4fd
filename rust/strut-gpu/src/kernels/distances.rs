//! Every D between the queries of a batch and the windows of a table; CPU twin of `distances.wgsl`.

use strut_core::search::{PackedQuery, PackedWindows};

pub(crate) const SHADER: &str = concat!(include_str!("sums.wgsl"), include_str!("distances.wgsl"));

/// Returns D, m², between a query and every window of a table, padding included.
pub(crate) fn distances(table: &PackedWindows, query: &PackedQuery) -> Vec<f32> {
    table.windows.iter().map(|window| table.distance(query, window)).collect()
}
