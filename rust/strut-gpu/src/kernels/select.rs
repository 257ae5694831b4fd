//! Of each class: the windows that are no farther than the k-th nearest and a margin; twin of `select.wgsl`.

use strut_core::search::{PackedClass, PackedWindows};

pub(crate) const SHADER: &str = include_str!("select.wgsl");

/// Most windows that are kept of a class.
pub(crate) const PLACES: usize = 128;
/// Words of what is found in a class for a query: how many, and the first [`PLACES`] in any order.
pub(crate) const WORDS: usize = PLACES + 1;

/// The shader's `struct Class`.
pub(crate) fn words(class: &PackedClass, k: usize) -> [u32; 4] {
    [class.first as u32, class.count as u32, k.min(class.count) as u32, 0]
}

/// What is found in every class, [`WORDS`] each, for a query with these distances and margins.
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

/// The k-th least, or the last if there are fewer; none of none.
fn kth_least(distances: &[f32], k: usize) -> Option<f32> {
    let mut sorted = distances.to_vec();
    let at = k.min(sorted.len()).checked_sub(1)?;
    Some(*sorted.select_nth_unstable_by(at, f32::total_cmp).1)
}

/// The windows of what is found in a class; none if they are more than there is room for.
pub(crate) fn windows(found: &[u32]) -> Option<&[u32]> {
    let (count, windows) = found.split_first()?;
    windows.get(..*count as usize)
}
