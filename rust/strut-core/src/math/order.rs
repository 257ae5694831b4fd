//! Sorting by a number, and comparison with zero.

/// Sorts items by a number in ascending order; the sort is stable.
///
/// One instantiation serves every type: each further one of the standard library's sort adds 2 kB to the download of the
/// page, and these lists are short.
pub fn sort_by_number<T>(items: &mut Vec<T>, number: impl Fn(&T) -> f32) {
    let mut order: Vec<(f32, usize)> = items.iter().enumerate().map(|(i, item)| (number(item), i)).collect();
    sort_pairs(&mut order);
    let mut unsorted: Vec<Option<T>> = items.drain(..).map(Some).collect();
    items.extend(order.into_iter().filter_map(|(_, i)| unsorted[i].take()));
}

/// The number, or 0 if it is negative or NaN. In WebAssembly `f32::max` is a function call, too slow for a loop.
#[inline]
pub(crate) fn positive(number: f32) -> f32 {
    if number > 0.0 { number } else { 0.0 }
}

/// Sorts by the number, then by the index.
#[inline(never)]
pub(crate) fn sort_pairs(pairs: &mut [(f32, usize)]) {
    pairs.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn it_is_a_stable_sort(numbers in prop::collection::vec(-3i8..3, 0..40)) {
            let mut items: Vec<(i8, usize)> = numbers.into_iter().enumerate().map(|(i, n)| (n, i)).collect();
            let mut expected = items.clone();
            expected.sort_by_key(|(n, _)| *n);
            sort_by_number(&mut items, |(n, _)| f32::from(*n));
            prop_assert_eq!(items, expected);
        }
    }
}
