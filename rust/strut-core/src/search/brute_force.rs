//! Every window of a class, one after the other: the definition that the search must equal.

use super::Index;
use super::metric::{ANY, Metric, QueryWindow};
use super::neighbours::{Neighbour, Neighbours};

/// Adds the windows of a class to `out`, which keeps the nearest.
pub(super) fn offer_class(index: &Index, query: &QueryWindow, metric: Metric, class: usize, out: &mut Neighbours) {
    for clip in &index.clips[index.classes[class].clone()] {
        for last in index.windows_of_clip(clip) {
            let distance = index.distance::<{ ANY }>(query, metric, last);
            out.offer(Neighbour { distance, row: last as u32 });
        }
    }
}
