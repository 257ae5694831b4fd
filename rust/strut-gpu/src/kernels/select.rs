//! Candidates of each class: the windows within the distance of the k-th nearest plus a margin; CPU twin of
//! `select.wgsl`.

use strut_core::search::{PackedClass, PackedWindows};

pub(crate) const SHADER: &str = include_str!("select.wgsl");

/// Greatest number of candidates of a class.
pub(crate) const PLACES: usize = 128;
/// Number of words of the result for a class and a query: the number of candidates, and the first [`PLACES`] in any
/// order.
pub(crate) const WORDS: usize = PLACES + 1;

/// Returns the words of the shader's `struct Class`.
pub(crate) fn words(class: &PackedClass, k: usize) -> [u32; 4] {
    [class.first as u32, class.count as u32, k.min(class.count) as u32, 0]
}

/// Returns the candidates of every class, [`WORDS`] each, for a query with these distances and margins.
pub(crate) fn select(table: &PackedWindows, distances: &[f32], margins: &[f32], k: usize) -> Vec<u32> {
    let mut found = Vec::with_capacity(WORDS * table.classes.len());
    for (class, margin) in table.classes.iter().zip(margins) {
        let of_class = &distances[class.windows()];
        let limit = kth_least(of_class, k).map_or(f32::NEG_INFINITY, |kth| kth + margin);
        let near = (class.first..).zip(of_class).filter(|&(_, &d)| d <= limit).map(|(window, _)| window as u32);
        let at = found.len();
        found.push(0);
        found.extend(near);
        found[at] = (found.len() - at - 1) as u32;
        found.resize(at + WORDS, 0);
    }
    found
}

/// Returns the k-th least, or the last if there are fewer; `None` for an empty list.
fn kth_least(distances: &[f32], k: usize) -> Option<f32> {
    let mut sorted = distances.to_vec();
    let at = k.min(sorted.len()).checked_sub(1)?;
    Some(*sorted.select_nth_unstable_by(at, f32::total_cmp).1)
}

/// Returns the candidates of a class, or `None` if there are more than [`PLACES`].
pub(crate) fn windows(found: &[u32]) -> Option<&[u32]> {
    let (count, windows) = found.split_first()?;
    windows.get(..*count as usize)
}
