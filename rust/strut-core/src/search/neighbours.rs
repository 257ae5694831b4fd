//! The K nearest rows found so far, ordered by (D, row).

/// A stored window that is similar to the query.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Neighbour {
    /// D: mean squared distance of the weighted points, m².
    pub distance: f32,
    /// Last row of the window.
    pub row: u32,
}

impl Neighbour {
    /// Order of search results: nearer first, then the earlier row, so that the result depends on the data only, not on
    /// the order of visits.
    fn comes_before(self, other: Self) -> bool {
        self.distance < other.distance || (self.distance == other.distance && self.row < other.row)
    }
}

/// The nearest windows, at most K, ordered by (D, row). The memory is reused between queries.
#[derive(Clone, Debug, Default)]
pub struct Neighbours {
    entries: Vec<Neighbour>,
    capacity: usize,
}

impl Neighbours {
    /// An empty list with capacity for `k`.
    pub fn with_capacity(k: usize) -> Self {
        Self { entries: Vec::with_capacity(k), capacity: k }
    }

    /// Empties the list and reserves capacity for `k`.
    pub fn begin(&mut self, k: usize) {
        self.entries.clear();
        self.entries.reserve(k);
        self.capacity = k;
    }

    /// Replaces the list by these neighbours, which are sorted by distance, and sets the capacity to their number.
    pub(crate) fn assign(&mut self, nearest: &[Neighbour]) {
        self.begin(nearest.len());
        self.entries.extend_from_slice(nearest);
    }

    /// Greatest D that can still be inserted.
    #[inline]
    pub fn threshold(&self) -> f32 {
        if self.entries.len() < self.capacity {
            f32::INFINITY
        } else {
            self.entries.last().map_or(f32::NEG_INFINITY, |n| n.distance)
        }
    }

    /// Inserts a window if it is among the K nearest so far. NaN is never inserted.
    #[inline]
    pub fn offer(&mut self, candidate: Neighbour) {
        if candidate.distance <= self.threshold() {
            self.insert(candidate);
        }
    }

    fn insert(&mut self, candidate: Neighbour) {
        if self.entries.len() < self.capacity {
            self.entries.push(candidate);
        } else if self.entries.last().is_none_or(|last| last.comes_before(candidate)) {
            return;
        }
        // From the end: windows are mostly offered in about this order.
        let mut at = self.entries.len() - 1;
        while at > 0 && candidate.comes_before(self.entries[at - 1]) {
            self.entries[at] = self.entries[at - 1];
            at -= 1;
        }
        self.entries[at] = candidate;
    }

    /// The neighbours, nearest first.
    pub fn as_slice(&self) -> &[Neighbour] {
        &self.entries
    }

    /// Mean of D over the neighbours, m²; infinite if there are none.
    pub fn mean_distance(&self) -> f32 {
        if self.entries.is_empty() {
            return f32::INFINITY;
        }
        self.entries.iter().map(|n| n.distance).sum::<f32>() / self.entries.len() as f32
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_k_first_of_the_sorted_candidates_remain_in_any_order_of_offers(
            distances in prop::collection::vec(0u8..20, 0..60), k in 0usize..20, start in 0usize..60,
        ) {
            let candidates: Vec<Neighbour> =
                distances.iter().enumerate().map(|(i, &d)| Neighbour { distance: d.into(), row: i as u32 }).collect();
            let mut sorted = candidates.clone();
            sorted.sort_by(|a, b| a.distance.total_cmp(&b.distance).then(a.row.cmp(&b.row)));
            sorted.truncate(k);
            let mut list = Neighbours::default();
            list.begin(k);
            let start = start.min(candidates.len());
            for c in candidates[start..].iter().chain(&candidates[..start]) {
                list.offer(*c);
            }
            prop_assert_eq!(list.as_slice(), &sorted[..]);
        }
    }

    #[test]
    fn nan_never_enters() {
        let mut list = Neighbours::default();
        list.begin(2);
        list.offer(Neighbour { distance: f32::NAN, row: 0 });
        assert!(list.as_slice().is_empty());
    }
}
