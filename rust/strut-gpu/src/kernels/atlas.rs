//! The least D of every pixel of a picture; CPU twin of `atlas.wgsl`.

#[cfg(test)]
use strut_core::search::{PackedQuery, PackedWindows};

pub(crate) const SHADER: &str = concat!(include_str!("sums.wgsl"), include_str!("atlas.wgsl"));

/// Value of a pixel without windows: the bits of infinity.
pub(crate) const EMPTY: u32 = f32::INFINITY.to_bits();

/// Returns the bits of the least D of each line of each query's column. `lines` has the line of each window, padding
/// included.
#[cfg(test)]
pub(crate) fn picture(table: &PackedWindows, queries: &[PackedQuery], lines: &[u32], height: usize) -> Vec<u32> {
    let mut picture = vec![EMPTY; queries.len() * height];
    for (query, column) in queries.iter().zip(picture.chunks_exact_mut(height)) {
        for (window, line) in table.windows.iter().zip(lines) {
            if let Some(pixel) = column.get_mut(*line as usize) {
                *pixel = (*pixel).min(table.distance(query, window).to_bits());
            }
        }
    }
    picture
}
